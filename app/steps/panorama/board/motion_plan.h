// Camera positions and tissue points of a clip, seen from above and from the side, as a drawing in
// a square. Both drawings have one scale.
#pragma once

#include <optional>
#include <vector>

#include <glm/vec2.hpp>

#include "authoring/relief/make/make_relief.h"

namespace arthro::app {

enum class PlanSide { kAbove, kSide };

// Coordinates from -1 to 1, x right, y down; points beyond are left out.
struct MotionPlan {
  struct Camera {
    glm::dvec2 tip{0.0}, ahead{0.0};  // ahead: unit vector of the view, shortened by the projection
  };
  std::vector<glm::dvec2> points;
  std::vector<Camera> cameras;
  std::optional<glm::dvec2> portal;  // once it is known
};
MotionPlan PlanOf(const authoring::ReliefSoFar& so_far, PlanSide side);

}  // namespace arthro::app
