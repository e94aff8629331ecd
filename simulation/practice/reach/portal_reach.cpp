#include "simulation/practice/reach/portal_reach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "simulation/haptics/surface/surface_bvh.h"
#include "simulation/scene/backdrop/relief_range.h"
#include "simulation/scene/projection.h"

namespace arthro::simulation {
namespace {

constexpr int kTurns = 16;        // rod directions on a cone
constexpr double kPace = 5e-4;    // m between the points of a line that are compared
constexpr double kGraze = 3e-4;   // m that a line may enter the relief; pixels are as large
constexpr double kBefore = 1e-3;  // m before a place that a line to it ends
constexpr double kThin = 1e-4;  // m, radius of a line; without one it could pass between triangles
constexpr double kBest = std::numbers::pi / 3;
constexpr double kOddsAndEnds = 1e-12;

// All that a rod or a look can meet.
struct Obstacles {
  const DepthMap& depth;
  const Backdrop& backdrop;
  std::vector<SurfaceBvh> tissues;

  explicit Obstacles(const LoadedScene& loaded)
      : depth(OrEmpty(loaded.depth)), backdrop(loaded.scene.backdrop) {
    for (std::size_t i = 0; i < loaded.surfaces.size(); ++i)
      if (loaded.surfaces[i] && i < loaded.scene.tissues.size())
        tissues.emplace_back(*loaded.surfaces[i], loaded.scene.tissues[i].pose);
  }

  // Depth below the relief; negative in the joint and where nothing was imaged.
  double DepthBelow(const glm::dvec3& x) const {
    const double range = glm::length(x);
    if (!(range > 0)) return -backdrop.radius;
    const double relief = ReliefRange(x / range, depth, backdrop);
    return std::isnan(relief) ? -1.0 : range - relief;
  }

  bool MeetsTissue(const glm::dvec3& from, const glm::dvec3& to, double radius) const {
    return std::any_of(tissues.begin(), tissues.end(), [&](const SurfaceBvh& tissue) {
      SweepHit hit;
      return tissue.Sweep(from, to, radius, -1, hit);
    });
  }

  // The part from a start within the relief to the first free point passes through the wall of the
  // joint and is free.
  bool IsFree(const glm::dvec3& from, const glm::dvec3& to) const {
    const double length = glm::distance(from, to);
    if (!(length > kBefore)) return true;
    const glm::dvec3 along = (to - from) / length;
    bool is_in_wall = true;
    for (double at = 0; at < length - kBefore; at += kPace) {
      const bool is_deep = DepthBelow(from + at * along) > kGraze;
      is_in_wall = is_in_wall && is_deep;
      if (is_deep && !is_in_wall) return false;
    }
    return !is_in_wall && !MeetsTissue(from, to - kBefore * along, kThin);
  }

  // A lens of that radius: the point and its neighbours along the axes are free.
  bool HasRoom(const glm::dvec3& x, double radius) const {
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {-radius, radius}) {
        glm::dvec3 beside = x;
        beside[axis] += side;
        if (DepthBelow(beside) > 0 || MeetsTissue(x, beside, kThin)) return false;
      }
    return true;
  }
};

// Two unit vectors across a unit direction.
std::array<glm::dvec3, 2> Across(const glm::dvec3& direction) {
  const glm::dvec3 other = std::abs(direction.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 first = glm::normalize(glm::cross(direction, other));
  return {first, glm::cross(direction, first)};
}

std::vector<glm::dvec3> RodsThatShow(const glm::dvec3& x, double view_angle, double scope_length,
                                     const Obstacles& obstacles, const ReachLimits& limits) {
  std::vector<glm::dvec3> rods;
  const double range = glm::length(x);
  const glm::dvec3 direction = x / range;
  const auto [first, second] = Across(direction);
  constexpr int kDistances = 4;
  for (int i = 0; i < kDistances; ++i) {
    const double distance =
        limits.nearest + (limits.farthest - limits.nearest) * i / (kDistances - 1);
    const double aside = distance * std::sin(view_angle);
    if (aside > range) continue;
    const double insertion =
        std::sqrt(range * range - aside * aside) - distance * std::cos(view_angle);
    if (!(insertion > limits.clearance && insertion <= scope_length)) continue;
    const double cone = std::asin(aside / range);
    const int turns = cone < kOddsAndEnds ? 1 : kTurns;
    for (int turn = 0; turn < turns; ++turn) {
      const double azimuth = 2 * std::numbers::pi * turn / kTurns;
      const glm::dvec3 rod =
          std::cos(cone) * direction +
          std::sin(cone) * (std::cos(azimuth) * first + std::sin(azimuth) * second);
      const glm::dvec3 lens = insertion * rod;
      if (obstacles.HasRoom(lens, limits.clearance) &&
          !obstacles.MeetsTissue({0, 0, 0}, lens, limits.clearance) && obstacles.IsFree(lens, x))
        rods.push_back(rod);
    }
  }
  return rods;
}

// Places of the relief on a grid of pixels, each with its solid angle.
void AddRelief(const LoadedScene& loaded, int wanted, ScopeReach& reach) {
  const Backdrop& backdrop = loaded.scene.backdrop;
  const DepthMap& depth = OrEmpty(loaded.depth);
  const ColourImage& panorama = OrEmpty(loaded.panorama);
  const int width = depth.empty() ? panorama.width : depth.width;
  const int height = depth.empty() ? panorama.height : depth.height;
  const double pixels = static_cast<double>(width) * height;
  reach.pixel_step = std::max(1, static_cast<int>(std::sqrt(pixels / std::max(1, wanted))));
  for (int y = reach.pixel_step / 2; y < height; y += reach.pixel_step)
    for (int x = reach.pixel_step / 2; x < width; x += reach.pixel_step) {
      const glm::dvec3 direction = DirectionFromPixel(backdrop.projection, {x, y});
      const double range = ReliefRange(direction, depth, backdrop);
      if (!(range > 0)) continue;
      const glm::dmat2x3 gradients = PixelGradients(backdrop.projection, direction);
      ReachPlace place;
      place.x = range * direction;
      place.pixel = {x, y};
      place.weight = 1 / glm::length(glm::cross(gradients[0], gradients[1]));
      reach.places.push_back(std::move(place));
    }
}

void AddTissues(const LoadedScene& loaded, int most, ScopeReach& reach) {
  for (std::size_t i = 0; i < loaded.surfaces.size() && i < loaded.scene.tissues.size(); ++i) {
    const SurfaceMesh& surface = OrEmpty(loaded.surfaces[i]);
    const std::size_t every = std::max<std::size_t>(
        1, surface.vertices.size() / static_cast<std::size_t>(std::max(1, most)));
    for (std::size_t k = 0; k < surface.vertices.size(); k += every) {
      ReachPlace place;
      place.x = loaded.scene.tissues[i].pose * surface.vertices[k];
      if (!(glm::length(place.x) > 0)) continue;
      place.weight = 1;
      place.tissue = static_cast<int>(i);
      reach.places.push_back(std::move(place));
    }
  }
}

// Counts the places of a tissue or of a point; -1 and -1: of the relief.
ReachShares SharesOf(const ScopeReach& scope, const std::vector<PlaceReach>& reached, int tissue,
                     int point = -1) {
  ReachShares shares;
  double whole = 0;
  std::vector<double> angles;
  for (std::size_t i = 0; i < reached.size(); ++i) {
    if (scope.places[i].tissue != tissue || scope.places[i].point != point) continue;
    const double weight = scope.places[i].weight;
    const PlaceReach& place = reached[i];
    whole += weight;
    if (place.is_seen) shares.seen += weight;
    if (place.is_touched) shares.touched += weight;
    if (place.is_good) shares.good += weight;
    if (!place.is_seen || !place.is_touched) continue;
    shares.both += weight;
    angles.push_back(place.angle);
  }
  if (!(whole > 0)) return {};
  for (double* share : {&shares.seen, &shares.touched, &shares.both, &shares.good}) *share /= whole;
  if (angles.empty()) return shares;
  const auto middle = angles.begin() + static_cast<std::ptrdiff_t>(angles.size() / 2);
  std::nth_element(angles.begin(), middle, angles.end());
  shares.median_angle = *middle;
  return shares;
}

}  // namespace

ScopeReach ScopeReachOf(const LoadedScene& loaded, const ReachLimits& limits,
                        const std::vector<glm::dvec3>& points) {
  ScopeReach reach;
  AddRelief(loaded, limits.places, reach);
  AddTissues(loaded, limits.tissue_places, reach);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(glm::length(points[i]) > 0)) continue;
    ReachPlace place;
    place.x = points[i];
    place.weight = 1;
    place.point = static_cast<int>(i);
    reach.places.push_back(std::move(place));
  }
  const Obstacles obstacles(loaded);
  for (ReachPlace& place : reach.places)
    place.rods = RodsThatShow(place.x, loaded.scene.scope.view_angle,
                              loaded.scene.rig.scope.rod_length, obstacles, limits);
  return reach;
}

PortalReach ReachWith(const ScopeReach& scope, const LoadedScene& loaded, double incision_spacing,
                      const ReachLimits& limits) {
  PortalReach reach;
  const Obstacles obstacles(loaded);
  const glm::dvec3 portal(incision_spacing, 0, 0);
  for (const ReachPlace& place : scope.places) {
    PlaceReach& reached = reach.places.emplace_back();
    reached.is_seen = !place.rods.empty();
    const double length = glm::distance(portal, place.x);
    reached.is_touched =
        length <= loaded.scene.rig.instrument.rod_length && obstacles.IsFree(portal, place.x);
    if (!reached.is_seen || !reached.is_touched || !(length > 0)) continue;
    const glm::dvec3 rod = (place.x - portal) / length;
    double best = 0;
    for (const glm::dvec3& scope_rod : place.rods) {
      const double angle = std::acos(std::clamp(glm::dot(rod, scope_rod), -1.0, 1.0));
      if (std::abs(angle - kBest) < std::abs(best - kBest)) best = angle;
    }
    reached.angle = best;
    reached.is_good = best >= limits.least_angle && best <= limits.most_angle;
  }
  reach.relief = SharesOf(scope, reach.places, -1);
  for (std::size_t i = 0; i < loaded.scene.tissues.size(); ++i)
    reach.tissues.push_back(SharesOf(scope, reach.places, static_cast<int>(i)));
  return reach;
}

double SuggestedSpacing(const ScopeReach& scope, const LoadedScene& loaded,
                        const ReachTargets& targets, const ReachLimits& limits) {
  // The tissue and the point of each target, as places bear them.
  std::vector<std::pair<int, int>> wanted;
  if (targets.has_relief) wanted.emplace_back(-1, -1);
  for (const int tissue : targets.tissues) wanted.emplace_back(tissue, -1);
  for (const int point : targets.points) wanted.emplace_back(-1, point);
  ScopeReach chosen_places;
  for (const ReachPlace& place : scope.places)
    if (std::find(wanted.begin(), wanted.end(), std::pair(place.tissue, place.point)) !=
        wanted.end())
      chosen_places.places.push_back(place);
  if (chosen_places.places.empty()) return loaded.scene.portals.incision_spacing;
  const double side = loaded.scene.portals.incision_spacing < 0 ? -1 : 1;
  double best_good = 0, best_both = 0, chosen = loaded.scene.portals.incision_spacing;
  bool is_first = true;
  for (const double sign : {side, -side})
    for (int mm = 10; mm <= 60; mm += 2) {
      const double spacing = sign * 1e-3 * mm;
      const PortalReach reach = ReachWith(chosen_places, loaded, spacing, limits);
      double good = 0, both = 0;
      for (const auto& [tissue, point] : wanted) {
        const ReachShares shares = SharesOf(chosen_places, reach.places, tissue, point);
        good += shares.good;
        both += shares.both;
      }
      if (!is_first && (good < best_good || (good == best_good && both <= best_both))) continue;
      best_good = good;
      best_both = both;
      chosen = spacing;
      is_first = false;
    }
  return chosen;
}

}  // namespace arthro::simulation
