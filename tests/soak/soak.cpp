// A long practice: probe, punch and shaver in the demo scene by recorded hands that wander, at 1
// kHz on the servo's thread, with the tissue on its own, and a window that practises beside it.
//   soak [--seconds 3600] [--seed 1] [--json FILE] [--without-window]
// Fails (exit 1) where memory grows, a force is not a number or above the limit, a state is not a
// number, the servo counts fewer missed ticks than the hand's own clock, or tissue at rest gains
// energy. Times are printed only: they are a matter of the machine.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <malloc.h>
#include <optional>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/core/finite.h"
#include "simulation/practice/living_tissues.h"
#include "simulation/practice/servo_loop.h"
#include "simulation/scene/files/loaded_scene.h"
#include "simulation/scene/files/scene_io.h"
#include "tests/soak/soak_hand.h"
#include "tests/soak/window_process.h"
#include "tests/support/build_paths.h"
#include "tests/support/temp_folder.h"
#include "tests/support/ticks.h"

namespace arthro::test {
namespace {

using namespace simulation;
using Clock = std::chrono::steady_clock;

constexpr double kToolTime = 8, kRestEvery = 48, kRestTime = 6;  // s
constexpr double kSettles = 3;         // s of a rest before the energy counts
constexpr int kCutsToReset = 60;       // bites and shavings in one session of a trainee
constexpr double kWarmUp = 0.25;       // share of the time before memory counts
constexpr double kGrowth = 0.01;       // share of the resident memory after that
constexpr double kEnergyNoise = 1e-6;  // share of the largest energy, which rounding may add
constexpr double kShortest = 300;      // s of a run whose memory is judged

struct Plan {
  double seconds = 3600;
  std::uint64_t seed = 1;
  std::string json;
  bool has_window = true;
};

// Forces and poses of every tick, on the servo's thread.
class TickWatch final : public ServoWatch {
 public:
  void AfterTick(const Snapshot& snapshot, double) noexcept override {
    for (const ToolState* tool : {&snapshot.scope, &snapshot.instrument}) {
      not_finite += !IsFinite(tool->tip_force) || !IsFinite(tool->hand_force) ||
                    !IsFinite(tool->tip_in_portal) || !IsFinite(tool->proxy_in_portal);
      contacts += tool->contact >= 0;
    }
  }
  long not_finite = 0, contacts = 0;
};

struct Memory {
  double t = 0, resident = 0, heap = 0, window = 0;  // s, MB
};

struct Soak {
  std::vector<Memory> memory;
  std::vector<double> step_ms;
  long steps = 0, not_finite = 0, cuts = 0, resets = 0, solver_resets = 0, rests = 0;
  double energy_gain = 0, largest_energy = 0;  // J, at rest; any
  ServoReport servo;
  bool window_ended = false;
};

double ResidentMb() {
  std::ifstream file("/proc/self/statm");
  double pages = 0, resident = 0;
  file >> pages >> resident;
  return 1e-6 * resident * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

double HeapMb() {
  const struct mallinfo2 info = ::mallinfo2();
  return 1e-6 * static_cast<double>(info.uordblks + info.hblkhd);
}

std::vector<TraceRow> RowsOf(const std::vector<TraceRow>& all, DeviceRole role) {
  std::vector<TraceRow> rows;
  for (const TraceRow& row : all)
    if (row.device == role) rows.push_back(row);
  return rows;
}

// Energy of the bodies of a picture while nothing touches them; nullopt where something does.
std::optional<double> RestEnergy(const WorldPicture& picture) {
  double energy = 0;
  for (const BodyPicture& body : picture.bodies) {
    if (body.report.contacts > 0) return std::nullopt;
    energy += body.report.step.energy;
  }
  return energy;
}

Soak Run(const Plan& plan, SoakHand& scope, SoakHand& instrument, Session& session,
         TickWatch& watch, WindowProcess* window) {
  Soak soak;
  ServoOptions options;
  options.watches = {&watch};
  ServoLoop servo(session, &scope, &instrument, options);
  ServoRequest request;
  request.options = session.options();
  request.incision_spacing = session.incision_spacing();
  request.view_angle = session.view_angle();
  const auto begin = Clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  soak.step_ms.reserve(static_cast<std::size_t>(plan.seconds / kFrame) + 100);
  soak.memory.reserve(static_cast<std::size_t>(plan.seconds) + 10);
  servo.Start();
  std::uint64_t seen = 0;
  long cuts_before = 0;
  double rest_energy = -1, next_memory = 0;
  constexpr std::array kTools = {ToolKind::kProbe, ToolKind::kPunch, ToolKind::kShaver};
  for (double t = 0; (t = seconds()) < plan.seconds;) {
    std::this_thread::sleep_for(std::chrono::duration<double>(kFrame));
    const double in_rest = std::fmod(t, kRestEvery) - (kRestEvery - kRestTime);
    const bool is_rest = in_rest > 0;
    scope.DrawOut(is_rest);
    instrument.DrawOut(is_rest);
    request.instrument = kTools[static_cast<std::size_t>(t / kToolTime) % kTools.size()];
    // A punch bites twice a second; a shaver runs three quarters of the time.
    const bool is_pressed =
        request.instrument == ToolKind::kPunch ? std::fmod(t, 0.5) < 0.25 : std::fmod(t, 4.0) < 3.0;
    instrument.Press(is_pressed && !is_rest);
    request.is_dead_man_held = {t > 1, t > 1};
    servo.SetRequest(request);
    servo.ReadSnapshot();

    const WorldPicture& picture = *session.tissues();
    long cuts = 0;
    if (picture.step != seen) {
      seen = picture.step;
      double step_ms = 0;
      for (const BodyPicture& body : picture.bodies) {
        soak.not_finite += !AllFinite(body.positions) || !AllFinite(body.normals) ||
                           !std::isfinite(body.report.step.energy);
        soak.solver_resets += body.report.was_reset;
        soak.largest_energy = std::max(soak.largest_energy, body.report.step.energy);
        step_ms += body.step_ms;
        cuts += body.cut.cuts;
      }
      soak.step_ms.push_back(step_ms);
      soak.cuts += std::max(0L, cuts - std::exchange(cuts_before, cuts));
    }
    // Tissue at rest takes no steps; its energy is looked at all the same.
    const auto energy = RestEnergy(picture);
    if (!is_rest || in_rest < kSettles || !energy) {
      rest_energy = -1;
    } else {
      if (rest_energy >= 0) soak.energy_gain = std::max(soak.energy_gain, *energy - rest_energy);
      soak.rests += rest_energy < 0;
      rest_energy = rest_energy < 0 ? *energy : std::min(rest_energy, *energy);
    }
    if (is_rest && cuts_before >= kCutsToReset) {
      servo.Stop();
      session.ResetTissues();
      for (SoakHand* hand : {&scope, &instrument}) hand->EndStretch();
      servo.Start();
      cuts_before = 0;
      rest_energy = -1;
      ++soak.resets;
    }
    if (t < next_memory) continue;
    next_memory = t + std::max(1.0, plan.seconds / 600);
    soak.memory.push_back({t, ResidentMb(), HeapMb(), window ? window->ResidentMb() : 0});
    if (window != nullptr) soak.window_ended = soak.window_ended || window->HasEnded();
  }
  servo.Stop();
  for (SoakHand* hand : {&scope, &instrument}) hand->EndStretch();
  soak.servo = servo.ReadReport();
  soak.steps = static_cast<long>(session.tissues()->step);
  return soak;
}

double Quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  return values[std::min(values.size() - 1,
                         static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

// Growth of the median from the first to the last quarter after the warm-up, as a share.
double GrowthOf(const Soak& soak, double Memory::*what, double seconds) {
  std::vector<double> early, late;
  const double first = kWarmUp * seconds, quarter = (seconds - first) / 4;
  for (const Memory& memory : soak.memory) {
    if (memory.*what <= 0) continue;
    if (memory.t >= first && memory.t < first + quarter) early.push_back(memory.*what);
    if (memory.t >= seconds - quarter) late.push_back(memory.*what);
  }
  if (early.empty() || late.empty()) return 0;
  return Quantile(late, 0.5) / Quantile(early, 0.5) - 1;
}

int Report(const Plan& plan, const Soak& soak, const SoakHand& scope, const SoakHand& instrument,
           const TickWatch& watch) {
  nlohmann::ordered_json json;
  int failures = 0;
  const auto row = [&](const char* what, double value, const std::string& words, bool holds) {
    failures += !holds;
    fmt::print("{:52} {:>14}  {}\n", what, words, holds ? "" : "FAILED");
    json[what] = value;
  };
  const auto count = [&](const char* what, long value, bool holds = true) {
    row(what, static_cast<double>(value), std::to_string(value), holds);
  };
  const auto number = [&](const char* what, double value, const char* unit, bool holds = true) {
    row(what, value, fmt::format("{:.3g} {}", value, unit), holds);
  };
  const bool is_long = plan.seconds >= kShortest;
  const auto growth = [&](const char* what, double Memory::*of) {
    const double share = GrowthOf(soak, of, plan.seconds);
    row(what, share, fmt::format("{:+.2f} %", 100 * share), !is_long || share <= kGrowth);
  };
  number("time", plan.seconds, "s");
  number("resident memory at the end", soak.memory.back().resident, "MB");
  growth("growth of the resident memory after the warm-up", &Memory::resident);
  growth("growth of the heap after the warm-up", &Memory::heap);
  if (plan.has_window) {
    number("resident memory of the window at the end", soak.memory.back().window, "MB");
    growth("growth of the window's memory after the warm-up", &Memory::window);
    count("the window ended by itself", soak.window_ended, !soak.window_ended);
  }
  const SoakHand::Kept& own = instrument.kept();
  count("ticks, as the hand counts", own.ticks);
  count("ticks left out, as the hand's clock counts", own.left_out);
  // The servo also counts a tick that comes half a period late. The first and last tick of a
  // stretch may be late by the hand's clock.
  count("ticks left out, as the servo counts", soak.servo.missed,
        soak.servo.missed >= own.left_out - own.stretches);
  count("ticks without force because they came late", soak.servo.overruns);
  number("time between ticks, p50", 1e3 * own.between.Quantile(0.5), "ms");
  number("time between ticks, p99", 1e3 * own.between.Quantile(0.99), "ms");
  number("time between ticks, p99.9", 1e3 * own.between.Quantile(0.999), "ms");
  number("time between ticks, longest", 1e3 * own.between.largest(), "ms");
  count("steps of the tissue", soak.steps, soak.steps > 0);
  number("tissue step, p50", Quantile(soak.step_ms, 0.5), "ms");
  number("tissue step, p99", Quantile(soak.step_ms, 0.99), "ms");
  number("tissue step, p99.9", Quantile(soak.step_ms, 0.999), "ms");
  number("tissue step, longest", Quantile(soak.step_ms, 1), "ms");
  count("cuts", soak.cuts, !is_long || soak.cuts > 0);
  count("tissues made whole again", soak.resets);
  count("bodies that their solver reset", soak.solver_resets, soak.solver_resets == 0);
  count("states that are not numbers", soak.not_finite + watch.not_finite,
        soak.not_finite + watch.not_finite == 0);
  const long bad = own.not_finite + scope.kept().not_finite;
  count("forces that are not numbers", bad, bad == 0);
  const long above = own.above_peak + scope.kept().above_peak;
  count("forces above the limit of the device", above, above == 0);
  number("largest force", std::max(own.largest, scope.kept().largest), "N");
  count("ticks with a force", own.pushed + scope.kept().pushed, own.pushed > 0);
  count("ticks in contact", watch.contacts, watch.contacts > 0);
  count("rests that were watched", soak.rests, !is_long || soak.rests > 0);
  number("most energy gained at rest, of the largest",
         soak.largest_energy > 0 ? soak.energy_gain / soak.largest_energy : 0, "",
         soak.energy_gain <= kEnergyNoise * soak.largest_energy);
  for (const Memory& memory : soak.memory)
    json["memory"].push_back({{"t", memory.t},
                              {"resident_mb", memory.resident},
                              {"heap_mb", memory.heap},
                              {"window_mb", memory.window}});
  fmt::print("{} failures\n", failures);
  if (!plan.json.empty()) WriteAtomically(plan.json, json.dump(1) + "\n");
  return failures == 0 ? 0 : 1;
}

int RunSoak(const Plan& plan) {
  const TempFolder folder;
  const std::filesystem::path resources = ARTHRO_SOURCE_DIR "/resources";
  const LoadedScene loaded = LoadScene(resources / "demo");
  Session session(loaded);
  EnlivenTissues(session, loaded, ReadTissuePresets(resources / "presets/tissues"),
                 TissuePace::kThread);
  const std::vector<TraceRow> rows = ReadTrace(resources / "demo/trace.csv");
  SoakHand scope(RowsOf(rows, DeviceRole::kScope), plan.seed, "a"),
      instrument(RowsOf(rows, DeviceRole::kInstrument), plan.seed + 1, "b");
  TickWatch watch;
  std::optional<WindowProcess> window;
  if (plan.has_window) window.emplace(folder.path());
  const Soak soak = Run(plan, scope, instrument, session, watch, window ? &*window : nullptr);
  return Report(plan, soak, scope, instrument, watch);
}

}  // namespace
}  // namespace arthro::test

int main(int argc, char** argv) {
  arthro::test::Plan plan;
  bool has_no_window = false;
  CLI::App program("Practises for a long time and looks for growth, lost ticks and wrong numbers");
  program.add_option("--seconds", plan.seconds, "Time")->capture_default_str();
  program.add_option("--seed", plan.seed, "Start of the random hands")->capture_default_str();
  program.add_option("--json", plan.json, "The table as JSON");
  program.add_flag("--without-window", has_no_window, "No window beside it");
  CLI11_PARSE(program, argc, argv);
  plan.has_window = !has_no_window;
  try {
    return arthro::test::RunSoak(plan);
  } catch (const std::exception& error) {
    fmt::print(stderr, "soak: {}\n", error.what());
    return 2;
  }
}
