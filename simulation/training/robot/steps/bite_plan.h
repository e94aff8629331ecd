// Plan of the next bite of basket forceps: points that stand for the tissue, and the place whose
// bite takes most points of the regions and least of the rest. Portal frame, m, rad, except where
// it says body. Internal to the robot.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/core/frames.h"
#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scene/tissue_parts.h"
#include "simulation/tissue/contact/tool_shape.h"

namespace arthro::simulation {

struct TissuePoint {
  glm::dvec3 x{0.0};
  bool is_wanted = false;  // in a region
  bool is_held = false;    // at the edge of what the points stand for: the tissue goes on beyond
  std::array<int, 6> beside{-1, -1, -1, -1, -1, -1};  // neighbours along the axes; −1: none
};

struct Bite {
  glm::dvec3 tip{0.0}, middle{0.0};
  double roll = 0, gain = 0;
};

// Points in the tissue about the regions; skin and regions are of the body.
std::vector<TissuePoint> PointsOf(const SurfaceMesh& skin, std::span<const Ball> regions,
                                  const Rigid3& portal_from_body);
// Moves points of a body at rest with its skin, whose vertices are at `now` instead of at rest.
void MoveWithSkin(std::vector<TissuePoint>& points, std::span<const glm::dvec3> rest,
                  std::span<const glm::dvec3> now, const Rigid3& portal_from_body);
// Places about the regions, in which bites are tried.
std::vector<glm::dvec3> MiddlesOf(std::span<const Ball> regions, const Rigid3& portal_from_body);

// Points of the regions that a bite with the tip there takes, less `rest` per other point. A bite
// takes what lies in it, and what nothing holds after it.
double GainAt(std::span<const TissuePoint> points, const glm::dvec3& portal, const glm::dvec3& tip,
              const ToolShape& shape, double rest);
// The best bite among those places; its gain is 0 where none is good.
Bite BestBite(std::span<const TissuePoint> points, std::span<const glm::dvec3> middles,
              const glm::dvec3& portal, const ToolShape& shape, double rest);

}  // namespace arthro::simulation
