#include <algorithm>
#include <chrono>

#include "app/bench/haptics/haptics_bench.h"
#include "simulation/core/process_cost.h"
#include "tests/support/haptics/touch_cases.h"

namespace arthro::app {
namespace {

using namespace test;

using namespace simulation;

// `felt` gives a stroke's forces.
template <class Felt>
ForceRow RowOf(const char* surface, const char* source, const char* method,
               const TouchStroke& stroke, int rounds, Felt&& felt) {
  ForceRow row{surface, source, method, {}, 1e9};
  for (int round = 0; round < rounds; ++round) {
    const double start = ThreadCpuMs();
    const std::vector<glm::dvec3> forces = felt();
    row.seconds =
        std::min(row.seconds, 1e-3 * (ThreadCpuMs() - start) / static_cast<double>(forces.size()));
    row.errors = ErrorsOf(forces, stroke.reference);
  }
  return row;
}

}  // namespace

std::vector<ForceRow> MeasureForces(int rounds, const Progress& progress) {
  std::vector<ForceRow> rows;
  struct Surface {
    const char* name;
    AnalyticRelief relief;
  };
  const Surface surfaces[] = {{"plane", AnalyticRelief::Plane()},
                              {"sphere", AnalyticRelief::Ball()},
                              {"waves", AnalyticRelief::Waves()}};
  for (const Surface& surface : surfaces) {
    const char* name = surface.name;
    const AnalyticRelief& relief = surface.relief;
    progress.Step("forces", static_cast<double>(rows.size()) / 15);
    const TouchStroke stroke = StrokeUnder(relief);
    for (const bool is_coarse : {false, true}) {
      const DepthMap map = is_coarse ? relief.EightBit() : relief.Float();
      const DepthField field(relief.backdrop, map);
      const char* source = is_coarse ? "8 bit" : "float";
      rows.push_back(RowOf(name, source, "proxy", stroke, rounds, [&] {
        return ProxyForces({field, {}}, stroke);
      }));
      rows.push_back(RowOf(name, source, "paper 3x3", stroke, rounds,
                           [&] { return PaperForces(relief.backdrop, map, stroke); }));
    }
    // Triangles alone, over the middle of the picture.
    const glm::dvec2 middle = relief.backdrop.projection.centre_px, half = 0.6 * middle;
    const SurfaceBvh mesh(relief.Mesh(middle - half, middle + half, 100), {});
    const DepthField nothing;
    rows.push_back(RowOf(name, "20 000 triangles", "proxy", stroke, rounds, [&] {
      return ProxyForces({nothing, {&mesh, 1}}, stroke);
    }));
  }
  return rows;
}

std::vector<StabilityRow> MeasureStability(const Progress& progress) {
  std::vector<StabilityRow> rows;
  for (const double period : {0.5e-3, 1e-3, 2e-3, 1.0 / 60})
    for (const double damping : {0.0, 1.0, 3.0})
      for (const int delay : {0, 1, 2}) {
        progress.Step("stability", static_cast<double>(rows.size()) / 36);
        rows.push_back({period, damping, delay, LargestStableStiffness(period, damping, delay),
                        RuleStiffness(period, damping, delay)});
      }
  return rows;
}

HandsRow MeasureHands(int hands, const Progress& progress) {
  HandsRow row;
  row.tried = hands;
  for (int i = 0; i < hands; ++i) {
    if (i % 100 == 0) progress.Step("hands", static_cast<double>(i) / hands);
    const HandTrial trial = TryRandomHand(static_cast<std::uint64_t>(i), {});
    row.escaped += trial.has_escaped;
    row.most_energy = std::max(row.most_energy, trial.energy_out);
  }
  for (const int delay : {0, 1, 2})
    for (const HandModel& hand : {kSoftHand, kHand, kStiffHand, kWholeArm}) {
      WallServo servo;
      servo.delay = delay;
      row.cycle_energy = std::max(row.cycle_energy, MostEnergyOut(hand, servo));
      servo.is_guarded = false;
      row.cycle_energy_unguarded = std::max(row.cycle_energy_unguarded, MostEnergyOut(hand, servo));
    }
  return row;
}

HapticsBench RunHapticsBench(const HapticsBenchOptions& options, const Progress& progress) {
  HapticsBench bench;
  bench.options = options;
  bench.times = MeasureServo({options.ticks, options.rounds}, progress);
  bench.forces = MeasureForces(options.rounds, progress);
  progress.Step("between a tissue's steps", 0.0);
  bench.bridges = MeasureBridges(options.rounds);
  bench.stability = MeasureStability(progress);
  bench.hands = MeasureHands(options.hands, progress);
  bench.energy = MeasureEnergy(options.cycles, progress);
  return bench;
}

}  // namespace arthro::app
