#include "simulation/practice/reach/shaft_conflicts.h"

#include <algorithm>

#include <glm/geometric.hpp>

#include "simulation/haptics/surface/surface_bvh.h"

namespace arthro::simulation {
namespace {

// Nearest points of two segments, as shares of them, by clamping those of the two lines.
struct NearestShares {
  double first = 0, second = 0;
};
NearestShares NearestOf(const glm::dvec3& p, const glm::dvec3& along, const glm::dvec3& q,
                        const glm::dvec3& other) {
  const glm::dvec3 between = p - q;
  const double a = glm::dot(along, along), e = glm::dot(other, other), f = glm::dot(other, between),
               c = glm::dot(along, between), b = glm::dot(along, other),
               denominator = a * e - b * b;
  NearestShares shares;
  if (denominator > 1e-18) shares.first = std::clamp((b * f - c * e) / denominator, 0.0, 1.0);
  shares.second = e > 0 ? (b * shares.first + f) / e : 0;
  if (shares.second < 0 || shares.second > 1) {
    shares.second = std::clamp(shares.second, 0.0, 1.0);
    shares.first = a > 0 ? std::clamp((b * shares.second - c) / a, 0.0, 1.0) : 0;
  }
  return shares;
}

}  // namespace

struct ShaftObstacles::Parts {
  std::vector<SurfaceBvh> tissues;
};

ShaftObstacles::ShaftObstacles(const LoadedScene& loaded) : parts_(std::make_unique<Parts>()) {
  for (std::size_t i = 0; i < loaded.scene.tissues.size(); ++i) {
    const bool is_there = i < loaded.surfaces.size() && loaded.surfaces[i] != nullptr;
    parts_->tissues.push_back(
        is_there ? SurfaceBvh(*loaded.surfaces[i], loaded.scene.tissues[i].pose) : SurfaceBvh());
  }
}
ShaftObstacles::~ShaftObstacles() = default;
ShaftObstacles::ShaftObstacles(ShaftObstacles&&) noexcept = default;
ShaftObstacles& ShaftObstacles::operator=(ShaftObstacles&&) noexcept = default;

std::vector<ShaftConflict> ShaftObstacles::Find(const glm::dvec3& lens,
                                                const glm::dvec3& instrument_portal,
                                                const glm::dvec3& tip) const {
  std::vector<ShaftConflict> conflicts;
  const auto add = [&](ShaftConflict::Kind kind, const glm::dvec3& from, const glm::dvec3& to) {
    const double length = glm::distance(from, to) - kFreeEnd;
    if (!(length > 0)) return;
    const glm::dvec3 end = from + length * glm::normalize(to - from);
    for (std::size_t i = 0; i < parts_->tissues.size(); ++i) {
      SweepHit hit;
      if (!parts_->tissues[i].empty() && parts_->tissues[i].Sweep(from, end, kShaftRadius, -1, hit))
        conflicts.push_back({kind, static_cast<int>(i), hit.fraction * length});
    }
  };
  add(ShaftConflict::Kind::kScopeInTissue, {0, 0, 0}, lens);
  add(ShaftConflict::Kind::kInstrumentInTissue, instrument_portal, tip);
  const NearestShares nearest =
      NearestOf({0, 0, 0}, lens, instrument_portal, tip - instrument_portal);
  const glm::dvec3 on_scope = nearest.first * lens,
                   on_instrument = instrument_portal + nearest.second * (tip - instrument_portal);
  if (glm::distance(on_scope, on_instrument) < 2 * kShaftRadius)
    conflicts.push_back({ShaftConflict::Kind::kShaftsTouch, -1, glm::length(on_scope)});
  return conflicts;
}

}  // namespace arthro::simulation
