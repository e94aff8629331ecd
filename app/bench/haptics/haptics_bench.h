// Speed against error of touch [benchmarks.md, Haptics]:
// - time of a servo tick, by stage;
// - error of its force against closed forms, beside the paper's kernel;
// - error of the force between two steps of a tissue;
// - largest stable stiffness of a sampled wall, beside the rule K = (b + B)/(T/2 + t_d);
// - simulated hands on a wall, and the energy that they gain.
// Only the times differ between runs.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "app/bench/haptics/servo_times.h"
#include "simulation/core/options.h"
#include "simulation/core/progress.h"
#include "tests/support/haptics/energy_cycles.h"
#include "tests/support/haptics/force_cases.h"
#include "tests/support/haptics/tissue_bridge.h"

namespace arthro::app {

struct HapticsBenchOptions {
  int ticks = 20000;
  int rounds = 5;
  int hands = 10000;
  int cycles = 10000;
  template <class V>
  void Visit(V&& v) {
    v("ticks", ticks, Range{10, 60000}, "", "Servo ticks of 1 ms that are timed per round.");
    v("rounds", rounds, Range{1, 1000}, "", "Repetitions of the same ticks.");
    v("hands", hands, Range{0, 10000000}, "", "Simulated hands that press against a wall.");
    v("cycles", cycles, Range{0, 10000000}, "",
      "Slow closed cycles over rigid backdrops whose energy is summed.");
  }
};

struct ForceRow {
  std::string surface, source, method;  // "waves", "8 bit", "proxy" or "paper 3x3"
  test::ForceErrors errors;
  double seconds = 0;  // per force, mean over a stroke; the least of all rounds
};

// A released device on a wall: 45 g, 0.2 N s/m.
struct StabilityRow {
  double period = 0;              // s
  double damping = 0;             // N s/m
  int delay = 0;                  // ticks
  double measured = 0, rule = 0;  // N/m
};

// Simulated hands under the program's own gains.
struct HandsRow {
  int tried = 0, escaped = 0;
  double most_energy = 0;  // J, most net energy from the wall to a hand
  // J, energy of a stroke into the wall and out again, over four hands and 0 to 2 ticks of delay.
  double cycle_energy = 0, cycle_energy_unguarded = 0;
};

struct HapticsBench {
  HapticsBenchOptions options;
  ServoTimes times;
  std::vector<ForceRow> forces;
  std::vector<test::BridgeRow> bridges;
  std::vector<StabilityRow> stability;
  HandsRow hands;
  std::vector<test::EnergyRow> energy;  // one row per ground
};

// Parts of the benchmark, beside MeasureServo and MeasureBridges.
std::vector<ForceRow> MeasureForces(int rounds, const Progress& progress);
std::vector<StabilityRow> MeasureStability(const Progress& progress);
HandsRow MeasureHands(int hands, const Progress& progress);
HapticsBench RunHapticsBench(const HapticsBenchOptions& options, const Progress& progress);

std::string TableOf(const HapticsBench& bench);
nlohmann::json JsonOf(const HapticsBench& bench);
std::string PlotOf(const HapticsBench& bench);  // SVG, error of the force over its time

}  // namespace arthro::app
