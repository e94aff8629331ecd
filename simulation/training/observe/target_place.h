// Place of a target of an exercise: a point on a tissue, which moves with its skin, a point on the
// relief, or a ball. Portal frame; for a tissue the frame of its body at rest, with the scale
// applied. m.
#pragma once

#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/core/units.h"
#include "simulation/haptics/relief/depth_field.h"
#include "simulation/scene/files/loaded_scene.h"

namespace arthro::simulation {

struct TargetPlace {
  int tissue = -1;         // in the scene; −1: it moves with none
  glm::dvec3 point{0.0};   // on the skin at rest, on the relief, or the middle of a ball
  glm::dvec3 normal{0.0};  // unit, out of the surface; 0 for a ball, which has none
  double radius = 0;
  bool is_loose = false;      // a loose body of this radius lies here at the begin (loose_bodies.h)
  bool keeps_bodies = false;  // loose bodies that are let go in this ball stay where they are
  // Regions to remove: the tissue in the scene that has them, and their numbers in it.
  int region_tissue = -1;
  std::vector<int> regions = {};
  friend bool operator==(const TargetPlace&, const TargetPlace&) = default;
};

// Largest distance of a given point from the skin at rest, and of a tied point from a cut skin.
inline constexpr double kTiedWithin = 2e-3, kTiedAnewWithin = 1e-3;  // m

// Return nullopt where there is no surface: first one on the ray from the scope's portal, latitude
// up and longitude right in rad; or the nearest point of a tissue's skin at rest, `point` in the
// frame of the tissue. The author's cuts are made. Throw Error for cuts that cannot be made.
std::optional<TargetPlace> TargetOnBearing(const LoadedScene& loaded, double latitude,
                                           double longitude, double radius);
// The same with the relief of the scene, which takes a tenth of a second to make.
std::optional<TargetPlace> TargetOnBearing(const LoadedScene& loaded, const DepthField& relief,
                                           double latitude, double longitude, double radius);
DepthField ReliefOf(const LoadedScene& loaded);
std::optional<TargetPlace> TargetOnTissue(const LoadedScene& loaded, int tissue,
                                          const glm::dvec3& point, double radius);
TargetPlace TargetInBall(const glm::dvec3& middle_in_portal, double radius);

}  // namespace arthro::simulation
