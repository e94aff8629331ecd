// Session with two scripted hands, ticked one by one with the tissue inline. Portal frame, m, s.
#pragma once

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "simulation/practice/scripted_device.h"
#include "simulation/practice/session.h"

namespace arthro::simulation {

inline constexpr double kTick = 0.001, kSpring = 500.0;
// The proxy keeps 1 µm from a surface and is in contact within 2 µm.
inline constexpr double kSkin = 2e-6;

// Scene with a bare, distant sphere of 80 mm, the portal of the instrument at its centre, and one
// tissue.
inline LoadedScene SceneOf(const SurfaceMesh& surface, const Tissue& tissue) {
  LoadedScene loaded;
  loaded.scene.backdrop.radius = 0.08;
  loaded.scene.backdrop.projection.centre_px = {511.5, 511.5};
  loaded.scene.backdrop.projection.focal_px = 500;
  loaded.scene.portals.incision_spacing = 0.0;
  loaded.panorama = Share(ColourImage(1024, 1024));
  loaded.scene.tissues.push_back(tissue);
  loaded.surfaces.push_back(Share(surface));
  return loaded;
}

struct Hand {
  explicit Hand(const LoadedScene& loaded, const SessionOptions& options = {})
      : session(loaded, options),
        scope(session.scope_rig()),
        instrument(session.instrument_rig()) {}
  const ToolState& Tick(int ticks = 1) {
    for (int i = 0; i < ticks; ++i) {
      t += kTick;
      session.Tick(scope.Sample(t), instrument.Sample(t), kTick);
      session.TickTissues(kTick);
    }
    return session.snapshot().instrument;
  }
  // Leads the tip of the instrument to a point at constant speed, and holds it there.
  const ToolState& Lead(const glm::dvec3& tip, int ticks = 500, int hold = 300) {
    const RodPose from = instrument.pose();
    const glm::dvec3 own = tip - glm::dvec3(session.incision_spacing(), 0, 0);
    const glm::dvec3 u = glm::normalize(own);
    for (int i = 1; i <= ticks; ++i) {
      const double s = static_cast<double>(i) / ticks;
      instrument.Set({from.latitude + s * (-std::asin(u.y) - from.latitude),
                      from.longitude + s * (std::atan2(u.x, u.z) - from.longitude), 0,
                      from.depth + s * (glm::length(own) - from.depth)});
      Tick();
    }
    return Tick(hold);
  }
  Session session;
  ScriptedDevice scope, instrument;
  double t = 0;
};

}  // namespace arthro::simulation
