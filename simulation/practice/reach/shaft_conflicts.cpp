#include "simulation/practice/reach/shaft_conflicts.h"

#include <glm/geometric.hpp>

#include "simulation/core/geometry/segment3.h"
#include "simulation/haptics/surface/surface_bvh.h"

namespace arthro::simulation {
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
  const NearestShares nearest = NearestOf({{0, 0, 0}, lens}, {instrument_portal, tip});
  const glm::dvec3 on_scope = nearest.first * lens,
                   on_instrument = instrument_portal + nearest.second * (tip - instrument_portal);
  if (glm::distance(on_scope, on_instrument) < 2 * kShaftRadius)
    conflicts.push_back({ShaftConflict::Kind::kShaftsTouch, -1, glm::length(on_scope)});
  return conflicts;
}

}  // namespace arthro::simulation
