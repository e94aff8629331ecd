#include "app/bench/haptics/haptics_bench.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/bench/machine_words.h"
#include "app/bench/speed_error_plot.h"
#include "app/bench/table_number.h"
#include "simulation/core/options_json.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

using namespace test;

constexpr double kMicro = 1e6;

std::string Microseconds(double seconds) {
  const double us = kMicro * seconds;
  return fmt::format("{:>9.{}f}", us, us < 1000 ? 3 : 0);
}

}  // namespace

std::string TableOf(const HapticsBench& bench) {
  std::string table = fmt::format(
      "# haptics: speed against error | {} | steady clock, {} ticks of 1 ms, {} times\n"
      "{:<46}{:>9}{:>9}{:>9} |{:>9}{:>9}{:>9}\n",
      MachineWords(), bench.options.ticks, bench.options.rounds, "us a tick or call", "p50", "p99",
      "p99.9", "p50", "p99", "p99.9");
  for (const ServoTime& row : bench.times.rows)
    table += fmt::format("{:<46}{}{}{} |{}{}{}  {}\n", row.what, Microseconds(row.p50),
                         Microseconds(row.p99), Microseconds(row.p999), Microseconds(row.calm_p50),
                         Microseconds(row.calm_p99), Microseconds(row.calm_p999), row.about);
  table += fmt::format(
      "behind the bar: of each tick the least of its {} times, so without what other programs "
      "took\n",
      bench.options.rounds);

  table += fmt::format(
      "\n# force on a stroke 1 mm ± 0.3 mm under a closed form, 500 N/m\n"
      "{:<9}{:<18}{:<11}{:>8}{:>11}{:>11}{:>13}{:>9}\n",
      "surface", "source", "method", "rms %", "p99 deg", "max deg", "excess N", "us");
  for (const ForceRow& row : bench.forces)
    table += fmt::format(
        "{:<9}{:<18}{:<11}{:>8.3f}{:>11.3f}{:>11.3f}{:>13.5f}{:>9.3f}\n", row.surface, row.source,
        row.method, 100 * row.errors.rms, DegreesFromRadians(row.errors.angle_p99),
        DegreesFromRadians(row.errors.angle_max), row.errors.excess_step, kMicro * row.seconds);
  table += "excess: largest change of force in a tick of 1 ms beyond the exact one's\n";

  table += fmt::format(
      "\n# force of a tissue, 500 x + 60 000 x² N under a spring of 500 N/m, between its steps\n"
      "{:<22}{:>9}{:>11}{:>8}{:>13}{:>9}\n",
      "method", "steps/s", "strokes/s", "rms %", "excess N", "us");
  for (const BridgeRow& row : bench.bridges)
    table += fmt::format("{:<22}{:>9.0f}{:>11.0f}{:>8.2f}{:>13.5f}{:>9.3f}\n", ToString(row.bridge),
                         row.step_rate, row.stroke_rate, 100 * row.rms, row.excess_step,
                         kMicro * row.seconds);
  table +=
      "a stroke goes 0.5 to 3.5 mm deep; the servo is told of a step when the next one begins\n";

  table += fmt::format(
      "\n# largest K of the wall -K x - B v on a released device (45 g, b 0.2 N s/m), N/m\n"
      "{:>7}{:>10}{:>7}{:>11}{:>24}{:>9}\n",
      "T ms", "B N s/m", "ticks", "measured", "(b + B)/(T/2 + t_d)", "ratio");
  for (const StabilityRow& row : bench.stability)
    table += fmt::format("{:>7.1f}{:>10.1f}{:>7}{:>11.1f}{:>24.1f}{:>9.3f}\n", kMilli * row.period,
                         row.damping, row.delay, row.measured, row.rule, row.measured / row.rule);

  const HandsRow& hands = bench.hands;
  table += fmt::format(
      "\n# hands on the program's own wall\n"
      "{} of {} random hands escaped; the wall gave one {:.3f} mJ at most\n"
      "in and out again: {:.3f} mJ given at most, {:.3f} mJ without the guard\n",
      hands.escaped, hands.tried, kMilli * hands.most_energy, kMilli * hands.cycle_energy,
      kMilli * hands.cycle_energy_unguarded);

  table += fmt::format(
      "\n# slow closed cycles of the hand, 20 to 150 mm/s: energy gained between two moments "
      "without a force\n{:<40}{:>8}{:>10}{:>12}{:>9}{:>11}\n",
      "ground", "cycles", "most mJ", "in cycle", "mm/s", "N in 1 ms");
  for (const EnergyRow& row : bench.energy)
    table +=
        fmt::format("{:<40}{:>8}{:>10.3f}{:>12}{:>9.0f}{:>11.3f}\n", row.ground, row.cycles,
                    kMilli * row.cycle.gain, row.worst, kMilli * row.cycle.speed, row.largest_rise);
  return table;
}

nlohmann::json JsonOf(const HapticsBench& bench) {
  nlohmann::json times = nlohmann::json::array(), forces = times, bridges = times,
                 stability = times;
  for (const ServoTime& row : bench.times.rows)
    times.push_back({{"what", row.what.substr(row.what.find_first_not_of(' '))},
                     {"about", row.about},
                     {"us_p50", kMicro * row.p50},
                     {"us_p99", kMicro * row.p99},
                     {"us_p999", kMicro * row.p999},
                     {"us_calm_p50", kMicro * row.calm_p50},
                     {"us_calm_p99", kMicro * row.calm_p99},
                     {"us_calm_p999", kMicro * row.calm_p999}});
  for (const ForceRow& row : bench.forces)
    forces.push_back({{"surface", row.surface},
                      {"source", row.source},
                      {"method", row.method},
                      {"rms", row.errors.rms},
                      {"angle_p99_deg", DegreesFromRadians(row.errors.angle_p99)},
                      {"angle_max_deg", DegreesFromRadians(row.errors.angle_max)},
                      {"excess_step", row.errors.excess_step},
                      {"us", kMicro * row.seconds}});
  for (const BridgeRow& row : bench.bridges)
    bridges.push_back({{"method", ToString(row.bridge)},
                       {"step_rate", row.step_rate},
                       {"stroke_rate", row.stroke_rate},
                       {"rms", row.rms},
                       {"excess_step", row.excess_step},
                       {"us", kMicro * row.seconds}});
  for (const StabilityRow& row : bench.stability)
    stability.push_back({{"period", row.period},
                         {"damping", row.damping},
                         {"delay_ticks", row.delay},
                         {"measured", row.measured},
                         {"rule", row.rule}});
  nlohmann::json energy = nlohmann::json::array();
  for (const EnergyRow& row : bench.energy)
    energy.push_back({{"ground", row.ground},
                      {"cycles", row.cycles},
                      {"gain", row.cycle.gain},
                      {"worst_cycle", row.worst},
                      {"speed", row.cycle.speed},
                      {"largest_rise", row.largest_rise}});
  return {{"schema", "arthroscene.bench.haptics/1"},
          {"machine", MachineWords()},
          {"options", JsonFromOptions(bench.options)},
          {"times", times},
          {"forces", forces},
          {"bridges", bridges},
          {"stability", stability},
          {"energy", energy},
          {"hands",
           {{"tried", bench.hands.tried},
            {"escaped", bench.hands.escaped},
            {"most_energy", bench.hands.most_energy},
            {"cycle_energy", bench.hands.cycle_energy},
            {"cycle_energy_unguarded", bench.hands.cycle_energy_unguarded}}}};
}

std::string PlotOf(const HapticsBench& bench) {
  std::vector<PlotMark> marks;
  for (const ForceRow& row : bench.forces)
    marks.push_back({row.surface, row.source + ", " + row.method, kMilli * row.seconds,
                     100 * row.errors.rms, row.method == "proxy" ? 1.0 : 0.0});
  return SpeedErrorSvg(
      {"Touch: speed against error", "processor time per force, ms", "error of the force, % rms",
       "filled: proxy; hollow: the paper's 3x3 kernel",
       "exact force under a plane, a sphere and waves in closed form"},
      marks);
}

}  // namespace arthro::app
