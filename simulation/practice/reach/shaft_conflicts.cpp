#include "simulation/practice/reach/shaft_conflicts.h"

#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include "simulation/core/geometry/segment3.h"
#include "simulation/haptics/surface/surface_bvh.h"
#include "simulation/scene/backdrop/relief_range.h"

namespace arthro::simulation {
namespace {

constexpr double kShaftPace = 2.5e-4;  // m between the points of an axis that are compared

}  // namespace

struct ShaftObstacles::Parts {
  std::vector<SurfaceBvh> tissues;
  std::shared_ptr<const DepthMap> depth;
  Backdrop backdrop;
  bool has_relief = false;

  bool IsInRelief(const glm::dvec3& x) const {
    const double range = glm::length(x);
    if (!(range > 0)) return false;
    const double relief = ReliefRange(x / range, OrEmpty(depth), backdrop);
    return std::isfinite(relief) && range - relief > kReliefSlack;
  }

  // Distance from the portal to where the axis enters the relief; nothing where it is free. An axis
  // that comes nowhere out of the wall of the joint is in the relief from its portal on.
  std::optional<double> EntryOf(const glm::dvec3& portal, const glm::dvec3& way,
                                double length) const {
    if (!has_relief) return std::nullopt;
    bool was_free = false;
    for (double at = 0; at <= length; at += kShaftPace) {
      const bool is_in = IsInRelief(portal + at * way);
      if (is_in && was_free) return at;
      was_free = was_free || !is_in;
    }
    return was_free ? std::nullopt : std::optional(0.0);
  }
};

ShaftObstacles::ShaftObstacles(const LoadedScene& loaded) : parts_(std::make_unique<Parts>()) {
  parts_->depth = loaded.depth;
  parts_->backdrop = loaded.scene.backdrop;
  parts_->has_relief = loaded.depth != nullptr || loaded.panorama != nullptr;
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
  using Kind = ShaftConflict::Kind;
  std::vector<ShaftConflict> conflicts;
  const auto add = [&](bool is_scope, const glm::dvec3& portal, const glm::dvec3& end) {
    const double whole = glm::distance(portal, end), length = whole - kFreeEnd;
    if (!(whole > 0)) return;
    const glm::dvec3 way = (end - portal) / whole;
    for (std::size_t i = 0; i < parts_->tissues.size() && length > 0; ++i) {
      SweepHit hit;
      if (parts_->tissues[i].empty() ||
          !parts_->tissues[i].Sweep(portal, portal + length * way, kShaftRadius, -1, hit))
        continue;
      const double depth = hit.fraction * length;
      conflicts.push_back({is_scope ? Kind::kScopeInTissue : Kind::kInstrumentInTissue,
                           static_cast<int>(i), depth, portal + depth * way});
    }
    // A tip is pressed against the relief, a lens is not.
    if (const auto depth = parts_->EntryOf(portal, way, is_scope ? whole : length))
      conflicts.push_back({is_scope ? Kind::kScopeInRelief : Kind::kInstrumentInRelief, -1, *depth,
                           portal + *depth * way});
  };
  add(true, {0, 0, 0}, lens);
  add(false, instrument_portal, tip);
  const NearestShares nearest = NearestOf({{0, 0, 0}, lens}, {instrument_portal, tip});
  const glm::dvec3 on_scope = nearest.first * lens,
                   on_instrument = instrument_portal + nearest.second * (tip - instrument_portal);
  if (glm::distance(on_scope, on_instrument) < 2 * kShaftRadius)
    conflicts.push_back({Kind::kShaftsTouch, -1, glm::length(on_scope), on_scope});
  return conflicts;
}

}  // namespace arthro::simulation
