// Marks that an attempt lays over its picture: targets whose cue is due, the path of a step, the
// part of a tissue that is to be removed, zones to spare, and the way of an expert. Portal frame,
// m.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "app/steps/lessons/lessons_step.h"
#include "simulation/core/frames.h"
#include "simulation/scene/mesh/surface_mesh.h"

namespace arthro::app {

struct CueMark {
  CueKind kind = CueKind::kOutline;
  Ball ball;
  std::string name;
  bool has_outline = false;  // ShownCues::remove shows where it lies
};

// Piece of an outline on a skin, with the normal of the skin there (unit).
struct OutlinePiece {
  glm::dvec3 a{0.0}, b{0.0}, normal{0.0};
};

struct ShownCues {
  std::vector<CueMark> cues;
  std::vector<CueMark> spare;        // zones to keep off
  std::vector<OutlinePiece> remove;  // border of the regions to remove
  std::vector<std::vector<glm::dvec3>> paths;
  std::optional<glm::dvec3> goal;  // moving goal of the step
  // Way of the expert's tip in the step, or of the centre of the expert's picture, and its place
  // now.
  std::vector<glm::dvec3> ghost;
  std::optional<glm::dvec3> ghost_now;
};

// Empty where no attempt runs. A step that removes tissue shows its regions and the zones to spare
// from its begin; other steps show zones with their cue.
ShownCues CuesOf(const EditorState& state);

// Border of the balls on a skin: where `rest`, the skin at rest, crosses them, moved with the skin
// as it is `now`. Both have the frame of the body.
std::vector<OutlinePiece> BorderOnSkin(const SurfaceMesh& rest, std::span<const glm::dvec3> now,
                                       std::span<const Ball> balls, const Rigid3& portal_from_body);

}  // namespace arthro::app
