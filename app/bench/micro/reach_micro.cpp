// Reach of scope and instrument, against closed forms of a sphere with a ball in it.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/bench/micro/micro_bench.h"
#include "simulation/core/units.h"
#include "simulation/practice/reach/portal_reach.h"
#include "tests/support/shapes.h"

namespace arthro::app {
namespace {

constexpr double kSpacing = 0.03, kBall = 6e-3;  // m
constexpr glm::dvec3 kMiddle{0.012, 0.002, 0.028};

// A bare sphere of 50 mm, a straight scope, and a ball as tissue.
LoadedScene JointWithBall(bool has_ball) {
  LoadedScene loaded;
  loaded.panorama = Share(ColourImage(200, 160));
  loaded.scene.backdrop.radius = 0.05;
  loaded.scene.backdrop.projection = {ProjectionType::kEquirectangular, {99.5, 79.5}, 1000, 2};
  loaded.scene.scope.view_angle = 0;
  if (!has_ball) return loaded;
  loaded.scene.tissues.emplace_back();
  loaded.surfaces.push_back(Share(test::Sphere(kMiddle, kBall, 5)));
  return loaded;
}

// Whether the segment passes through the ball.
bool MeetsBall(const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 way = to - from;
  const double share = std::clamp(glm::dot(kMiddle - from, way) / glm::dot(way, way), 0.0, 1.0);
  return glm::distance(from + share * way, kMiddle) < kBall;
}

}  // namespace

MicroGroup ReachMicro(bool quick) {
  using simulation::PortalReach;
  using simulation::ReachLimits;
  using simulation::ScopeReach;
  MicroGroup group{
      "reach", "worst angle error, deg", "angles of lines to a sphere, lines through a ball", {}};
  ReachLimits limits;
  limits.places = quick ? 200 : 4000;
  const glm::dvec3 portal(kSpacing, 0, 0);
  const LoadedScene bare = JointWithBall(false), ball = JointWithBall(true);
  group.functions.push_back(
      {"reach of a bare sphere",
       [=] { KeepAlive(ReachWith(ScopeReachOf(bare, limits), bare, kSpacing, limits)); },
       [=] {
         const ScopeReach scope = ScopeReachOf(bare, limits);
         const PortalReach reach = ReachWith(scope, bare, kSpacing, limits);
         double worst = 0;
         for (std::size_t i = 0; i < scope.places.size(); ++i) {
           const glm::dvec3 x = scope.places[i].x;
           const double angle = std::acos(glm::dot(glm::normalize(x), glm::normalize(x - portal)));
           worst = std::max(worst, std::abs(angle - reach.places[i].angle));
         }
         return MicroError{
             DegreesFromRadians(worst),
             fmt::format("{:.1e} deg, {} places", DegreesFromRadians(worst), scope.places.size())};
       }});
  group.functions.push_back(
      {"reach beside a ball of tissue",
       [=] { KeepAlive(ReachWith(ScopeReachOf(ball, limits), ball, kSpacing, limits)); },
       [=] {
         const ScopeReach scope = ScopeReachOf(ball, limits);
         const PortalReach reach = ReachWith(scope, ball, kSpacing, limits);
         int places = 0, wrong = 0;
         for (std::size_t i = 0; i < scope.places.size(); ++i) {
           if (scope.places[i].tissue >= 0) continue;
           ++places;
           wrong += reach.places[i].is_touched == MeetsBall(portal, scope.places[i].x) ? 1 : 0;
         }
         return MicroError{.text = fmt::format("{} of {} places are touched otherwise than the "
                                               "line through the ball says",
                                               wrong, places)};
       }});
  return group;
}

}  // namespace arthro::app
