// Place that an exercise speaks of. Portal frame, m, rad; a point on a tissue is in the tissue's
// own frame at rest and moves with it. Exactly one place is given: a bearing, a point on a tissue,
// a ball in space, or regions of a tissue.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "simulation/core/options.h"
#include "simulation/scene/limits/scene_limits.h"

namespace arthro {

enum class TargetKind { kBearing, kPoint, kBall, kRegions };

struct ExerciseTarget {
  std::string id;
  std::optional<glm::dvec2> bearing;  // latitude, longitude
  std::string on;                     // tissue
  std::optional<glm::dvec3> point;
  std::optional<glm::dvec3> ball;    // centre
  std::vector<std::string> regions;  // names in the tissue `on`
  double radius = 0.002;
  bool is_loose = false;
  friend bool operator==(const ExerciseTarget&, const ExerciseTarget&) = default;
  template <class V>
  void Visit(V&& v) {
    v("id", id, Name{}, "", "Short name of the target.");
    v("bearing", bearing, Range{-kHalfTurn, kHalfTurn}, "rad",
      "Latitude and longitude: the first surface on that ray from the scope's portal.");
    v("on", on, Any{}, "", "Tissue that carries the point or the regions.");
    v("point", point, kCoordinate, "m",
      "Point on the tissue's surface, in its own frame at rest; it moves with the tissue.");
    v("ball", ball, kCoordinate, "m", "Centre of a ball in the portal frame.");
    v("regions", regions, TextList{}, "", "Regions of the tissue.");
    v("radius", radius, kLength, "m", "Radius within which the target counts as touched.");
    v("loose", is_loose, LeftOutAt{false, Any{}}, "",
      "A loose body of this radius lies here at the start. A grasper carries it, and the target "
      "moves with it.");
  }
  static constexpr double kHalfTurn = 180 * kRadianPerDegree;
};

// Number of the places that are given; one in a sound target.
inline int PlacesOf(const ExerciseTarget& target) {
  return (target.bearing ? 1 : 0) + (target.point ? 1 : 0) + (target.ball ? 1 : 0) +
         (target.regions.empty() ? 0 : 1);
}

inline TargetKind KindOf(const ExerciseTarget& target) {
  if (target.bearing) return TargetKind::kBearing;
  if (target.point) return TargetKind::kPoint;
  return target.ball ? TargetKind::kBall : TargetKind::kRegions;
}

}  // namespace arthro
