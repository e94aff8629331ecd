#include "app/commands/practice.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "simulation/core/error.h"
#include "simulation/scope/arthroscope.h"
#include "simulation/session/living_tissues.h"

namespace arthro::app {
namespace {

constexpr double kTick = 1e-3;  // s

// As slow as an eye follows; a real blade turns fifty times a second, which a picture at 60 Hz
// would show standing still.
constexpr double kBladeSpeed = 30.0;  // rad/s

simulation::Session SessionOf(const authoring::Document& document,
                              const std::vector<simulation::TissuePreset>& presets,
                              simulation::TissuePace pace) {
  if (!document.panorama || document.panorama->empty())
    throw Error(Code::kBadScene,
                "a scene without a panorama cannot be practised; import one first");
  std::vector<SurfaceMesh> surfaces;
  for (const auto& surface : document.surfaces)
    surfaces.push_back(surface ? *surface : SurfaceMesh{});
  const Backdrop& backdrop = document.scene.backdrop;
  auto field = document.depth ? simulation::DepthField(backdrop, *document.depth)
                              : simulation::DepthField(backdrop, document.panorama->width,
                                                       document.panorama->height);
  simulation::Session session(document.scene, std::move(field), surfaces);
  const auto file_of = [&document](const std::filesystem::path& name) {
    const auto found = document.files.find(name.generic_string());
    return found != document.files.end() ? found->second.file : document.folder / name;
  };
  session.Enliven(simulation::LivingTissues(document.scene, surfaces, file_of, presets), pace,
                  simulation::LayersOf(document.scene, surfaces, presets));
  return session;
}

}  // namespace

simulation::RodLimits ScopeLimits(const Scene& scene) {
  simulation::RodLimits limits;
  // The lens stays inside the sphere that the panorama is on, and the hand outside the portal.
  limits.max_depth = std::min(0.97 * scene.backdrop.radius, 0.9 * scene.scope.rod_length);
  limits.min_depth = -0.2 * scene.backdrop.radius;
  return limits;
}

simulation::RodLimits InstrumentLimits(const Scene& scene) {
  simulation::RodLimits limits;
  // Far enough to press on the furthest wall; the wall holds the tip.
  limits.max_depth = std::min(scene.backdrop.radius + std::abs(scene.portals.incision_spacing),
                              0.9 * scene.rig.instrument.rod_length);
  limits.min_depth = -0.2 * scene.backdrop.radius;
  return limits;
}

simulation::RodPose StartOfScope(const Scene& scene) {
  // Looking at the middle of the picture, as far as the view angle lets the rod: the axis is bent
  // up by the centre angle, so the rod points down by as much.
  constexpr double kLowest = 0.8;  // rad
  simulation::RodPose pose;
  pose.depth = 0.3 * scene.backdrop.radius;
  pose.latitude = -std::min(
      kLowest, simulation::CentreAngle(scene.scope.view_angle, pose.depth, scene.backdrop.radius));
  return pose;
}

simulation::RodPose StartOfInstrument(const Scene& scene) {
  // Its tip in the middle of the scope's first picture, a third of the way to the backdrop.
  constexpr double kShare = 0.33;
  const simulation::ScopeView view =
      simulation::ViewFromPose(StartOfScope(scene), scene.scope.view_angle);
  const glm::dvec3 wall = simulation::SphereHit(view.tip, view.view, scene.backdrop.radius);
  const glm::dvec3 portal(scene.portals.incision_spacing, 0.0, 0.0);
  const glm::dvec3 rod = view.tip + kShare * (wall - view.tip) - portal;
  simulation::RodPose pose;
  pose.depth = glm::length(rod);
  pose.latitude = std::atan2(-rod.y, std::hypot(rod.x, rod.z));
  pose.longitude = std::atan2(rod.x, rod.z);
  return pose;
}

Practice::Practice(const authoring::Document& document,
                   const std::vector<simulation::TissuePreset>& presets,
                   simulation::TissuePace pace)
    : session_(SessionOf(document, presets, pace)),
      scope_(session_.scope_rig(), StartOfScope(document.scene), ScopeLimits(document.scene)),
      instrument_(session_.instrument_rig(), StartOfInstrument(document.scene),
                  InstrumentLimits(document.scene)) {
  // One tick, so that there is something to show before time has passed.
  session_.Tick(scope_.Sample(t_), instrument_.Sample(t_), kTick);
  tissues_ = session_.tissues();
}

void Practice::Advance(double seconds) {
  pending_ += std::clamp(seconds, 0.0, kLongestPause);
  const int ticks = static_cast<int>(std::floor(pending_ / kTick + 1e-9));
  pending_ -= ticks * kTick;
  for (int tick = 1; tick <= ticks; ++tick) {
    t_ += kTick;
    const double remaining = (ticks - tick) * kTick;
    session_.Tick(scope_.Sample(t_, remaining), instrument_.Sample(t_, remaining), kTick);
    session_.TickTissues(kTick);
    if (session_.snapshot().instrument.is_running) blade_turn_ += kBladeSpeed * kTick;
    peak_force_ = std::max(peak_force_, glm::length(session_.snapshot().instrument.tip_force));
  }
  tissues_ = session_.tissues();
}

}  // namespace arthro::app
