// How the author cuts and names next: what a click on tissue in the overview does on its Cut page.
// Sizes in m of the joint.
#pragma once

#include <optional>

#include <glm/vec3.hpp>

namespace arthro::app {

struct CutBrush {
  // A tear begins this far outside of the clicked points, so that it is open between them where the
  // surface is round.
  static constexpr double kLead = 1.5e-3;

  enum class Kind { kNone, kTear, kBite, kRegion } kind = Kind::kNone;
  double depth = 8e-3;  // deeper than a meniscus is thick: through
  double width = 6e-4, radius = 1.7e-3, region_radius = 5e-3;
  // The first point of a tear that has no second one yet.
  std::optional<glm::dvec3> start;
  int start_tissue = -1;
  bool goes_on = false;  // the next point lengthens the chosen tear
};

}  // namespace arthro::app
