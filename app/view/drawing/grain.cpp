#include "app/view/drawing/grain.h"

#include <bit>
#include <cstdint>

namespace arthro::app {

int GrainSeed(const Picture& picture) noexcept {
  std::uint64_t hash = static_cast<std::uint64_t>(picture.disturbances.seed) + 1;
  const auto add = [&](double value) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 29;
  };
  for (const glm::dvec3& v : {picture.view.tip, picture.view.view, picture.view.up})
    for (int c = 0; c < 3; ++c) add(v[c]);
  if (picture.disturbances.is_moving()) add(picture.disturbances.time);
  return static_cast<int>(hash >> 33);
}

}  // namespace arthro::app
