#include "app/view/settling.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace arthro::app {

double SettlingShare(double distance) {
  if (!(distance > kStill)) return 0.0;
  const double square = distance * distance;
  return square / (square + kFollowed * kFollowed);
}

void Settle(const glm::dvec3& now, glm::dvec3& drawn) {
  drawn = glm::mix(drawn, now, SettlingShare(glm::distance(now, drawn)));
}

bool Settle(std::span<const glm::dvec3> now, std::span<const glm::dvec3> normals_now,
            std::span<glm::dvec3> drawn, std::span<glm::dvec3> normals_drawn) {
  const std::size_t count = std::min({now.size(), normals_now.size(), drawn.size()});
  bool has_stayed = true;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = SettlingShare(glm::distance(now[i], drawn[i]));
    if (share == 0.0) continue;
    has_stayed = false;
    drawn[i] = glm::mix(drawn[i], now[i], share);
    const glm::dvec3 normal = glm::mix(normals_drawn[i], normals_now[i], share);
    const double length = glm::length(normal);
    normals_drawn[i] = length > 0.0 ? normal / length : normals_now[i];
  }
  return has_stayed;
}

}  // namespace arthro::app
