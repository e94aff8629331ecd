// Axis-aligned box, m.
#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace arthro {

struct Box3 {
  glm::dvec3 low{0.0}, high{0.0};
  bool empty() const { return !(low.x <= high.x && low.y <= high.y && low.z <= high.z); }
};
inline constexpr Box3 kEmptyBox{glm::dvec3(1.0), glm::dvec3(-1.0)};
inline Box3 Union(const Box3& a, const Box3& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {glm::min(a.low, b.low), glm::max(a.high, b.high)};
}

inline double Distance2(const Box3& box, const glm::dvec3& x) noexcept {
  const glm::dvec3 d = glm::max(glm::max(box.low - x, x - box.high), glm::dvec3(0.0));
  return d.x * d.x + d.y * d.y + d.z * d.z;
}
inline double Distance2(const Box3& a, const Box3& b) noexcept {
  const glm::dvec3 d = glm::max(glm::max(a.low - b.high, b.low - a.high), glm::dvec3(0.0));
  return d.x * d.x + d.y * d.y + d.z * d.z;
}

}  // namespace arthro
