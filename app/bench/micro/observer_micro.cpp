// Observation of an attempt: what a frame costs the thread of the window, and a tick the servo.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/bench/micro/micro_bench.h"
#include "app/platform/resource_folder.h"
#include "simulation/core/units.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/training/observe/live_attempt.h"
#include "tests/support/view/reference_tracer.h"

namespace arthro::app {
namespace {

using namespace simulation;

// Bearings of the demo scene in degrees, latitude and longitude.
constexpr std::array<glm::dvec2, kMostTargets> kBearings{{{33.2, 13.8},
                                                          {35.6, 41.7},
                                                          {28.1, -14},
                                                          {12, -24.4},
                                                          {-0.5, -21},
                                                          {-8.5, -52.7},
                                                          {-15.8, 5.9},
                                                          {-35.4, 6.5},
                                                          {-30, 24.6},
                                                          {-12.9, 27},
                                                          {-8.8, 10.9},
                                                          {-2.7, -3.8},
                                                          {-2.2, 40.7},
                                                          {-16.36, -6.69},
                                                          {-16.85, 17.24},
                                                          {0, 0}}};

// The demo scene with 16 targets, seen from many poses.
struct DemoSight {
  LoadedScene loaded = LoadScene(ResourceFolder() / "demo");
  DepthField relief{loaded.scene.backdrop, OrEmpty(loaded.depth), {}, OrEmpty(loaded.depth_sigma)};
  ScopeEye eye{loaded};
  std::vector<TargetPlace> targets;
  std::unique_ptr<Observer> observer;
  std::vector<AttemptFrame> frames;
  std::size_t next = 0;

  explicit DemoSight(int poses) {
    for (const glm::dvec2& bearing : kBearings)
      if (const auto target = TargetOnBearing(loaded, RadiansFromDegrees(bearing.x),
                                              RadiansFromDegrees(bearing.y), 2e-3))
        targets.push_back(*target);
    observer = std::make_unique<Observer>(loaded, targets, relief, eye);
    for (int i = 0; i < poses; ++i) frames.push_back(FrameOf(0.1 * i));
  }

  // Both hands wander through the joint.
  AttemptFrame FrameOf(double t) const {
    AttemptFrame frame;
    const RodPose pose{0.3 * std::sin(t), 0.4 * std::sin(1.7 * t), 3 * std::sin(0.3 * t),
                       0.012 + 0.006 * std::sin(2.3 * t)};
    const glm::dvec3 portal(loaded.scene.portals.incision_spacing, 0, 0);
    const glm::dvec3 tip(0.008 * std::sin(3 * t), 0.006 * std::cos(t), 0.025);
    frame.view_angle = static_cast<float>(loaded.scene.scope.view_angle);
    frame.incision_spacing = static_cast<float>(portal.x);
    frame.tool[0].drawn_tip = glm::vec3(TipInOwnPortal(pose));
    frame.tool[0].axis = glm::vec3(BasisOf(pose).axis);
    frame.tool[0].roll = frame.head_roll = static_cast<float>(pose.roll);
    frame.tool[0].depth = static_cast<float>(pose.depth);
    frame.tool[1].drawn_tip = glm::vec3(tip);
    frame.tool[1].axis = glm::vec3(glm::normalize(tip - portal));
    frame.tool[1].depth = 0.03F;
    for (ToolFrame& tool : frame.tool) tool.is_valid = true;
    return frame;
  }

  const AttemptFrame& Observe() {
    AttemptFrame& frame = frames[next++ % frames.size()];
    observer->Observe(frame);
    return frame;
  }

  // Share of the targets whose line of sight the tracer of the view finds clear or not as well,
  // without those within 2 mm of an edge.
  MicroError Disagreement() {
    std::vector<SurfaceMesh> surfaces;
    std::vector<test::ReferenceMesh> meshes;
    for (std::size_t i = 0; i < loaded.surfaces.size(); ++i) {
      surfaces.push_back(OrEmpty(loaded.surfaces[i]));
      for (glm::dvec3& x : surfaces.back().vertices) x = loaded.scene.tissues[i].pose * x;
    }
    meshes.reserve(surfaces.size());
    for (const SurfaceMesh& surface : surfaces) meshes.push_back({&surface});
    int compared = 0, different = 0;
    for (int i = 0; i < 40; ++i) {
      AttemptFrame frame = FrameOf(0.37 * i);
      frame.tool[1].is_valid = false;  // the tracer knows no instrument
      observer->Observe(frame);
      for (int j = 0; j < frame.sight.targets; ++j) {
        const PointSight& sight = frame.sight.target[static_cast<std::size_t>(j)];
        if (!(sight.centre < 1)) continue;
        const glm::dvec3 lens(frame.lens), way = glm::dvec3(sight.place) - lens;
        const glm::dvec3 ray = glm::normalize(way);
        const auto hit = test::TraceRays(loaded.scene.backdrop, *loaded.panorama, lens, {&ray, 1},
                                         meshes, loaded.depth.get())[0];
        const double before = glm::length(way) - hit.distance;
        const bool is_clear = hit.what == test::TracedRay::kNothing || before < kSurfaceMargin;
        if (before > 0.2e-3 && before < 2e-3) continue;
        ++compared;
        different += is_clear != sight.is_clear;
      }
    }
    return {1e2 * different / std::max(1, compared),
            fmt::format("{} of {} lines of sight differ", different, compared)};
  }
};

}  // namespace

MicroGroup ObserverMicro(bool quick) {
  MicroGroup group{"observer", "share of lines of sight that differ, %", "tracer of the view", {}};
  const auto sight = MadeOnce([quick] { return std::make_shared<DemoSight>(quick ? 10 : 400); });
  group.functions.push_back({"frame with 16 targets", [sight] { KeepAlive(sight()->Observe()); },
                             [sight] { return sight()->Disagreement(); }});
  const auto frames = MadeOnce([] { return std::make_shared<LiveFrames>(); });
  group.functions.push_back({"tick of the servo",
                             [frames, snapshot = Snapshot()]() mutable {
                               snapshot.t += 0.001;
                               frames()->AfterTick(snapshot, 0.001);
                               AttemptFrame frame;
                               if (frames()->Take(frame)) KeepAlive(frame);
                             },
                             {}});
  return group;
}

}  // namespace arthro::app
