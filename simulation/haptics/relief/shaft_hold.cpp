#include "simulation/haptics/relief/shaft_hold.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace arthro::simulation {
namespace {

// Distance of the points that are compared: ridges are wider. A ridge that is four times as high as
// wide does not occur, so points far from the relief may be further apart.
constexpr double kPace = 1e-3;       // m
constexpr double kPaceShare = 0.25;  // share of the clearance
constexpr int kRefinements = 8;      // refinements of the deepest point, to a fiftieth of the pace
constexpr int kMostTurns = 24;
constexpr double kOver = 1e-5;        // m beyond the graze, so that few turns suffice
constexpr double kLeastAcross = 0.1;  // squared cosine between normal and the plane across the rod

struct DeepPoint {
  double depth = 0;  // m, negative outside the backdrop
  double along = 0;  // m from the portal
  glm::dvec3 normal{0.0};
  double weight = 0;
};

DeepPoint PointAt(const DepthField& field, const glm::dvec3& portal, const glm::dvec3& rod,
                  double along) noexcept {
  const glm::dvec3 x = portal + along * rod;
  const double clear = field.free_radius() - glm::length(x);
  if (clear > 0.0) return {-clear, along};
  const FieldQuery query = field.Query(x);
  if (!(query.weight > 0.0)) return {0.0, along};
  return {-query.clearance, along, query.normal, query.weight};
}

DeepPoint DeepestPoint(const DepthField& field, const glm::dvec3& portal, const glm::dvec3& rod,
                       double end) noexcept {
  DeepPoint deepest;
  bool is_in_wall = true;
  double along = 0.0;
  while (true) {
    const DeepPoint point = PointAt(field, portal, rod, along);
    is_in_wall = is_in_wall && point.depth > 0.0;
    if (!is_in_wall && point.depth > deepest.depth) deepest = point;
    if (!(along < end)) break;
    along = std::min(end, along + std::max(kPace, -kPaceShare * point.depth));
  }
  if (!(deepest.depth > 0.0)) return deepest;
  double reach = 0.5 * kPace;
  for (int i = 0; i < kRefinements; ++i, reach *= 0.6)
    for (const double beside : {deepest.along - reach, deepest.along + reach})
      if (beside > 0.0 && beside <= end)
        if (const DeepPoint point = PointAt(field, portal, rod, beside);
            point.depth > deepest.depth)
          deepest = point;
  return deepest;
}

}  // namespace

ShaftHold HoldShaft(const DepthField& field, const glm::dvec3& portal,
                    const glm::dvec3& tip) noexcept {
  ShaftHold hold;
  hold.tip = tip;
  const double length = glm::distance(portal, tip);
  if (field.empty() || !(length > 2.0 * kShaftFree)) return hold;
  const glm::dvec3 asked = (tip - portal) / length;
  const DeepPoint first = DeepestPoint(field, portal, asked, length - kShaftFree);
  if (!(first.depth > kShaftGraze)) return hold;
  hold.weight = first.weight;
  hold.through = first.depth;
  glm::dvec3 rod = asked;
  DeepPoint deepest = first;
  for (int turn = 0; turn < kMostTurns; ++turn) {
    // Turns the rod in the plane of the normal, so that the deepest point leaves the backdrop.
    const glm::dvec3 across = deepest.normal - glm::dot(deepest.normal, rod) * rod;
    const double share = std::max(glm::dot(across, across), kLeastAcross);
    const double out = deepest.depth - kShaftGraze + kOver;
    rod = glm::normalize(rod + out / (share * deepest.along) * across);
    const double way = glm::distance(portal + length * rod, tip);
    if (!(way < kMostShaftWay)) return hold;
    // A tip that has left its place must be free too.
    deepest = DeepestPoint(field, portal, rod, length);
    if (deepest.depth > kShaftGraze) continue;
    hold.tip = portal + length * rod;
    hold.held = way;
    hold.through = 0.0;
    return hold;
  }
  return hold;
}

}  // namespace arthro::simulation
