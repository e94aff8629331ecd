#include "app/bench/haptics/servo_times.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/bench/quantile.h"
#include "simulation/device/driver/drivers.h"
#include "simulation/device/plant_device.h"
#include "simulation/practice/scripted_device.h"
#include "simulation/practice/servo_loop.h"
#include "tests/support/haptics/analytic_relief.h"
#include "tests/support/haptics/force_cases.h"
#include "tests/support/haptics/paper_kernel.h"

namespace arthro::app {
namespace {

using namespace test;

using namespace simulation;
using Clock = std::chrono::steady_clock;

double Since(Clock::time_point start) noexcept {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Times of repeated calls of the same work, over rounds.
class CallTimes {
 public:
  CallTimes(std::string what, int calls) : what_(std::move(what)) {
    least_.assign(static_cast<std::size_t>(calls), 1e9);
  }
  void Add(int call, double seconds) {
    all_.push_back(seconds);
    double& least = least_[static_cast<std::size_t>(call)];
    least = std::min(least, seconds);
  }
  template <class F>
  void Time(int call, F&& f) {
    const Clock::time_point start = Clock::now();
    f();
    Add(call, Since(start));
  }
  ServoTime Row(std::string about = {}) const {
    return {what_,
            std::move(about),
            Quantile(all_, 0.5),
            Quantile(all_, 0.99),
            Quantile(all_, 0.999),
            Quantile(least_, 0.5),
            Quantile(least_, 0.99),
            Quantile(least_, 0.999)};
  }

 private:
  std::string what_;
  std::vector<double> all_, least_;
};

// A simulated device that says how long its own simulation took.
class TimedPlant final : public Device {
 public:
  TimedPlant(const DeviceRig& rig, const RodPose& at, std::string serial)
      : rig_(rig), plant_({}, kHand, HipFromRodPose(at, rig), std::move(serial)) {}
  const DeviceCaps& caps() const noexcept override { return plant_.caps(); }
  const std::string& name() const noexcept override { return plant_.name(); }
  const std::string& serial() const noexcept override { return plant_.serial(); }
  DeviceSample Read(double now) noexcept override {
    const Clock::time_point start = Clock::now();
    const DeviceSample sample = plant_.Read(now);
    seconds_ = Since(start);
    return sample;
  }
  void HoldDeadMan(bool is_held) noexcept override { plant_.HoldDeadMan(is_held); }
  void Command(const glm::dvec3& force) noexcept override { plant_.Command(force); }
  DeviceStatus status() const noexcept override { return plant_.status(); }

  void Lead(const RodPose& pose) { plant_.plant().SetIntent(HipFromRodPose(pose, rig_)); }
  double seconds() const noexcept { return seconds_; }  // duration of the last Read
  const glm::dvec3& force() const noexcept { return plant_.force(); }

 private:
  DeviceRig rig_;
  PlantDevice plant_;
  double seconds_ = 0;
};

// Paths of both tips in and out of the surfaces, up to 30 mm/s.
RodPose ScopeAt(double t) {
  return {0.25 * std::sin(1.3 * t), 0.25 * std::cos(1.1 * t), t, 0.0455 + 0.001 * std::sin(2 * t)};
}
RodPose InstrumentAt(double t) {
  return {0.15 * std::sin(0.9 * t), -0.6 + 0.25 * std::sin(t), 0, 0.052 + 0.002 * std::sin(2 * t)};
}

// 20 000 triangles, 1 mm before the right half of the backdrop.
SurfaceMesh HalfTheWaves(const AnalyticRelief& relief) {
  return relief.Mesh({511.5, 100}, {923, 923}, 100, 1e-3);
}

LoadedScene TouchScene(const AnalyticRelief& relief, bool has_mesh) {
  LoadedScene loaded;
  loaded.scene.backdrop = relief.backdrop;
  loaded.scene.portals.incision_spacing = 0.03;
  loaded.depth = Share(relief.Float());
  if (has_mesh) {
    loaded.scene.tissues.emplace_back();
    loaded.surfaces.push_back(Share(HalfTheWaves(relief)));
  }
  return loaded;
}

// Samples of both hands in a tick, and the resulting snapshot.
struct TickRecord {
  DeviceSample scope, instrument;
  Snapshot snapshot;
};

// The whole tick.
struct LoopTimes {
  LoopTimes(const std::string& scene, int ticks_a_round)
      : tick("tick, two devices, " + scene, ticks_a_round),
        plants("  both hands simulated, " + scene, ticks_a_round) {}
  CallTimes tick, plants;
  long ticks = 0, heap_calls = 0, contacts = 0, mesh_contacts = 0;
  std::string About() const {
    const double share = 50.0 / static_cast<double>(std::max(1L, ticks));
    return fmt::format("in contact {:.0f} %, with triangles {:.0f} %",
                       share * static_cast<double>(contacts),
                       share * static_cast<double>(mesh_contacts));
  }
};

void RunLoop(const LoadedScene& scene, int ticks, long (*heap_calls)() noexcept, LoopTimes& times,
             std::vector<TickRecord>* record) {
  Session session(scene);
  TimedPlant scope(session.scope_rig(), ScopeAt(0), "a"),
      instrument(session.instrument_rig(), InstrumentAt(0), "b");
  ServoOptions options;
  options.wants_priority = false;
  ServoLoop loop(session, &scope, &instrument, options);
  ServoRequest request;
  request.options = session.options();
  request.incision_spacing = session.incision_spacing();
  request.view_angle = session.view_angle();
  double now = 0;
  // The devices open and home, then arm and ramp up.
  for (int i = 0; i < 1010; ++i) {
    if (i == 10) {
      request.is_dead_man_held = {true, true};
      loop.SetRequest(request);
    }
    loop.TickOnce(now += kTouchTick);
  }
  for (int i = 0; i < ticks; ++i) {
    scope.Lead(ScopeAt(i * kTouchTick));
    instrument.Lead(InstrumentAt(i * kTouchTick));
    now += kTouchTick;
    const long before = heap_calls ? heap_calls() : 0;
    const Clock::time_point start = Clock::now();
    loop.TickOnce(now);
    const double whole = Since(start);
    times.heap_calls += heap_calls ? heap_calls() - before : 0;
    const double plants = scope.seconds() + instrument.seconds();
    times.tick.Add(i, whole - plants);
    times.plants.Add(i, plants);
    ++times.ticks;
    const Snapshot& snapshot = session.snapshot();
    for (const ToolState* tool : {&snapshot.scope, &snapshot.instrument}) {
      times.contacts += tool->contact >= 0;
      times.mesh_contacts += tool->contact > 0;
    }
    if (record != nullptr) {
      DeviceSample at_scope, at_instrument;
      at_scope.hip_in_device = HipFromRodPose(snapshot.scope.pose, session.scope_rig());
      at_instrument.hip_in_device =
          HipFromRodPose(snapshot.instrument.pose, session.instrument_rig());
      record->push_back({at_scope, at_instrument, snapshot});
    }
  }
}

// Times each stage of the tick alone, on the samples of the whole one.
void TimeStages(const LoadedScene& scene, const std::vector<TickRecord>& record, int rounds,
                std::vector<ServoTime>& rows) {
  const SessionOptions options;
  const DepthField field(scene.scene.backdrop, *scene.depth, options.depth);
  const DeviceRig rig;
  const glm::dvec3 portal[2] = {{0, 0, 0}, {scene.scene.portals.incision_spacing, 0, 0}};
  const int ticks = static_cast<int>(record.size());
  CallTimes clock("  the clock itself", ticks), pose("  rod pose and lever", ticks),
      contact("  contact: queries, proxy, friction", ticks),
      output("  output: guard, clamp, thermal, rise, ramp", ticks),
      codec("  codec: a report taken, a force encoded", ticks);
  const WoodenModel& model = *FindWoodenModel("woodenhaptics_2015");
  for (int round = 0; round < rounds; ++round) {
    RodPose last[2];
    ContactState contact_state[2];
    OutputState output_state[2];
    const std::unique_ptr<DeviceDriver> driver[2] = {MakeWoodenDriver(model, false),
                                                     MakeWoodenDriver(model, false)};
    for (int i = 0; i < ticks; ++i) {
      const TickRecord& at = record[static_cast<std::size_t>(i)];
      const DeviceSample* sample[2] = {&at.scope, &at.instrument};
      const ToolState* tool[2] = {&at.snapshot.scope, &at.snapshot.instrument};
      Lever lever[2];
      TipForce tip[2];
      clock.Time(i, [] {});
      pose.Time(i, [&] {
        for (int k : {0, 1}) {
          last[k] =
              RodPoseFromHip(sample[k]->hip_in_device, sample[k]->handle_in_device, rig, last[k]);
          lever[k] = LeverAt(sample[k]->hip_in_device, rig.rod_length, options.lever);
        }
      });
      contact.Time(i, [&] {
        for (int k : {0, 1})
          TickContact({field, {}}, options.contact, options.contact.stiffness, portal[k],
                      tool[k]->tip_in_portal, kTouchTick, contact_state[k]);
      });
      for (int k : {0, 1}) {
        tip[k].force = tool[k]->tip_force;
        tip[k].stiffness = options.contact.stiffness;
        tip[k].lever = lever[k];
        tip[k].hand = sample[k]->hip_in_device;
        tip[k].hand_speed = 0.03;
      }
      output.Time(i, [&] {
        for (int k : {0, 1})
          ForceToHand({options.passivity, options.thermal, options.limiter}, tip[k], kTouchTick,
                      output_state[k]);
      });
      std::array<std::uint8_t, 14> report{};
      for (std::size_t j = 0; j < 3; ++j)
        PutSigned(report, 2 * j,
                  static_cast<std::int16_t>(
                      model.home[j] +
                      std::lround(300 * std::sin(1e-3 * i * (1.0 + static_cast<double>(j))))));
      codec.Time(i, [&] {
        for (int k : {0, 1}) {
          driver[k]->Take(report);
          driver[k]->ForceReport(tool[k]->hand_force, driver[k]->Hand(0).joints);
        }
      });
    }
  }
  rows.push_back(pose.Row("both"));
  rows.push_back(contact.Row("both, depth map alone"));
  rows.push_back(output.Row("both"));
  rows.push_back(codec.Row("both; on the devices' own threads"));
  rows.push_back(clock.Row("is in each row above"));
}

// A hundred queries make a call, or the clock is what is measured.
void TimeQueries(const AnalyticRelief& relief, int rounds, std::vector<ServoTime>& rows) {
  constexpr int kBatch = 100;
  const TouchStroke stroke = StrokeUnder(relief);
  const int batches = static_cast<int>(stroke.tip.size()) / kBatch;
  for (const bool is_coarse : {false, true}) {
    const DepthMap map = is_coarse ? relief.EightBit() : relief.Float();
    const DepthField field(relief.backdrop, map);
    const char* source = is_coarse ? "8 bit" : "float";
    CallTimes ours(fmt::format("depth query, {}", source), batches),
        paper(fmt::format("the paper's 3x3 kernel, {}", source), batches);
    const auto time = [&](CallTimes& times, int batch, auto&& query) {
      const auto first = static_cast<std::size_t>(batch) * kBatch;
      const Clock::time_point start = Clock::now();
      for (std::size_t i = first; i < first + kBatch; ++i) query(stroke.tip[i]);
      times.Add(batch, Since(start) / kBatch);
    };
    for (int round = 0; round < 10 * rounds; ++round)
      for (int batch = 0; batch < batches; ++batch) {
        time(ours, batch, [&](const glm::dvec3& x) { field.Query(x); });
        time(paper, batch, [&](const glm::dvec3& x) { PaperQuery(relief.backdrop, map, x); });
      }
    rows.push_back(ours.Row("one, mean of 100"));
    rows.push_back(paper.Row("one, mean of 100"));
  }
}

// Both hands come from nowhere, with nothing of the scene in any cache.
ServoTime TimeCold(const LoadedScene& scene, int trials, int rounds) {
  Session session(scene);
  ScriptedDevice scope(session.scope_rig()), instrument(session.instrument_rig());
  CallTimes times("  cold: first contact, caches empty", trials);
  std::vector<std::uint8_t> eviction(std::size_t{64} << 20);
  for (int round = 0; round < rounds; ++round)
    for (int i = 0; i < trials; ++i) {
      const double t = 20.0 * i / trials;
      scope.Set(ScopeAt(t));
      instrument.Set(InstrumentAt(t));
      const DeviceSample a = scope.Sample(t + 1), b = instrument.Sample(t + 1);
      session.Tick({}, {}, kTouchTick);
      for (std::size_t byte = 0; byte < eviction.size(); byte += 64) ++eviction[byte];
      times.Time(i, [&] { session.Tick(a, b, kTouchTick); });
    }
  return times.Row("two devices enter through their portals");
}

void TimeBuilding(const AnalyticRelief& relief, int rounds, std::vector<ServoTime>& rows) {
  CallTimes field("build the field, 1024 x 1024, float", 1),
      coarse("build the field, 1024 x 1024, 8 bit", 1), tree("build the tree, 20 000 triangles", 1);
  const DepthMap map = relief.Float(), eight_bit = relief.EightBit();
  const SurfaceMesh mesh = HalfTheWaves(relief);
  for (int round = 0; round < rounds; ++round) {
    field.Time(0, [&] { const DepthField built(relief.backdrop, map); });
    coarse.Time(0, [&] { const DepthField built(relief.backdrop, eight_bit); });
    tree.Time(0, [&] { const SurfaceBvh built(mesh, {}); });
  }
  for (const CallTimes* times : {&field, &coarse, &tree})
    rows.push_back(times->Row("once a scene"));
}

}  // namespace

ServoTimes MeasureServo(const ServoTimesOptions& options, const Progress& progress) {
  ServoTimes result;
  const AnalyticRelief relief = AnalyticRelief::Waves();
  progress.Step("depth queries", 0.0);
  TimeQueries(relief, options.rounds, result.rows);
  for (const bool has_mesh : {false, true}) {
    const LoadedScene scene = TouchScene(relief, has_mesh);
    LoopTimes times(has_mesh ? "20 000 triangles" : "depth map", options.ticks);
    std::vector<TickRecord> record;
    record.reserve(static_cast<std::size_t>(options.ticks));
    for (int round = 0; round < options.rounds; ++round) {
      progress.Step(has_mesh ? "ticks with triangles" : "ticks",
                    static_cast<double>(round) / options.rounds);
      RunLoop(scene, options.ticks, options.heap_calls, times,
              round == 0 && !has_mesh ? &record : nullptr);
    }
    result.ticks += times.ticks;
    result.heap_calls += times.heap_calls;
    result.rows.push_back(times.tick.Row(times.About()));
    if (has_mesh)
      result.rows.push_back(TimeCold(scene, std::max(5, options.ticks / 100), options.rounds));
    else
      TimeStages(scene, record, options.rounds, result.rows);
    result.rows.push_back(times.plants.Row("apart: not in the tick"));
  }
  TimeBuilding(relief, options.rounds, result.rows);
  return result;
}

}  // namespace arthro::app
