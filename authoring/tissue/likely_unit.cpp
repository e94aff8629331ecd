#include "authoring/tissue/likely_unit.h"

#include <algorithm>

#include "simulation/core/geometry/box3.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

// m; a loose body, and the plateau with a margin.
constexpr double kShortest = 4e-3, kLongest = 0.15;

}  // namespace

double LongestSide(const SurfaceMesh& surface) {
  Box3 box = kEmptyBox;
  for (const glm::dvec3& x : surface.vertices) box = Union(box, {x, x});
  if (box.empty()) return 0;
  const glm::dvec3 size = box.high - box.low;
  return std::max({size.x, size.y, size.z});
}

std::string LikelyUnit(double longest_side) {
  for (const char* unit : {"mm", "m", "cm", "in", "um"}) {
    const double length = longest_side * *MetresPerUnit(unit);
    if (length >= kShortest && length <= kLongest) return unit;
  }
  return "mm";
}

}  // namespace arthro::authoring
