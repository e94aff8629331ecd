// A practice session: two hands in, poses, contacts and forces out, one servo tick at a time
// [paper 3.2, 3.4; design §1, §2]. It draws nothing and has no threads: a servo thread calls Tick
// at 1 kHz where there is a force device, the window calls it in 1 ms steps where there is none.
// Portal frame, m, N, s.
#pragma once

#include <span>

#include "simulation/device/device_sample.h"
#include "simulation/scene/image.h"
#include "simulation/scene/scene.h"
#include "simulation/scene/surface_mesh.h"
#include "simulation/session/session_options.h"
#include "simulation/session/snapshot.h"

namespace arthro::simulation {

class Session {
 public:
  // `depth` may be empty: the bare sphere is felt where the panorama lies. `surfaces` has one mesh
  // a tissue, in the tissue's own frame; an empty mesh is not felt. Copies what it needs.
  Session(const Scene& scene, const DepthMap& depth, std::span<const SurfaceMesh> surfaces,
          const SessionOptions& options = {});

  // Advances the session by dt. A sample that repeats its t ages by dt each tick; after
  // max_sample_age its device gets no force.
  void Tick(const DeviceSample& scope, const DeviceSample& instrument, double dt) noexcept;
  const Snapshot& snapshot() const noexcept { return snapshot_; }

  // Live, between ticks, from the thread that ticks.
  void SetIncisionSpacing(double spacing) noexcept;
  double incision_spacing() const noexcept { return spacing_; }
  void SetViewAngle(double view_angle) noexcept { view_angle_ = view_angle; }
  double view_angle() const noexcept { return view_angle_; }
  const DeviceRig& scope_rig() const noexcept { return scope_.rig; }
  const DeviceRig& instrument_rig() const noexcept { return instrument_.rig; }

 private:
  struct Tool {
    DeviceRig rig;
  };
  void TickTool(Tool& tool, const DeviceSample& sample, const glm::dvec3& portal, double dt,
                ToolState& state) noexcept;

  Projection projection_;
  double radius_, spacing_, view_angle_;
  Tool scope_, instrument_;
  Snapshot snapshot_;
};

}  // namespace arthro::simulation
