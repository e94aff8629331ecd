// Ten minutes of random probing, lifting, biting and shaving of a meniscus [FEM-21], twice from one
// seed: every step finite, no step lost, memory flat from minute to minute, and the second run,
// which makes its factors on the stepping thread, gives the same bits as the first, which makes
// them on another. Fails (exit 1) where one of these does not hold; times are printed only. `--seed
// N` for another session, `--minutes N` for a longer one, `--work N` for another limit of a step's
// work.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <malloc.h>
#include <string>
#include <unistd.h>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "simulation/core/finite.h"
#include "simulation/core/process_cost.h"
#include "tests/benchmark/bench_report.h"
#include "tests/simulation/tissue/body/meniscus_body.h"
#include "tests/simulation/tissue/body/random_hand.h"
#include "tests/support/ticks.h"

namespace arthro::simulation {
namespace {

using test::kFrame;
constexpr int kCutsToReset = 120;    // bites and shavings in one session of a trainee
constexpr double kHeapGrowth = 1.0;  // MB allowed from the first minute to the last
// Not wedged, contacts have up to twice the friction of their push, of which the servo may lose all
// [coupling.cpp, kWedged].
constexpr double kServoShare = 100 * 2 * 0.03 / (1 - 2 * 0.03);  // %
constexpr double kMemoryGrowth = 16.0;  // MB resident, the allocator's own holes included

struct Plan {
  std::uint64_t seed = 3;
  int minutes = 10;
  int minute = 3600;  // steps
  bool has_thread = true;
  BodyOptions body;
};

// FNV-1a over the bits of numbers.
class Hash {
 public:
  void Add(double value) {
    std::uint64_t bits = std::bit_cast<std::uint64_t>(value);
    for (int i = 0; i < 8; ++i, bits >>= 8) value_ = (value_ ^ (bits & 0xff)) * 0x100000001b3ull;
  }
  void Add(const glm::dvec3& v) { Add(v.x), Add(v.y), Add(v.z); }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ull;
};

struct Minute {
  std::uint64_t hash = 0;
  double heap = 0, resident = 0;  // MB, with the tissue whole again
};

struct SlowStep {
  int step = 0;
  double ms = 0;
  std::string did;
};

struct Soak {
  std::vector<SlowStep> slowest;  // longest first
  std::vector<Minute> minutes;
  std::vector<double> all_ms, uncut_ms, reset_ms;  // processor time of the stepping thread
  std::vector<double> work;                        // in iterations, of a step that solved
  std::vector<double> iterations;                  // a step that was not asleep
  std::vector<double> pages;                       // new from the system, per step
  std::vector<double> servo_share;  // %, error of the servo's force at the step's own tip
  int steps = 0, awake = 0, touched = 0, cuts = 0, debris = 0, sessions = 0, inverted = 0;
  int not_finite = 0, faults = 0, unsaid_faults = 0, fallbacks = 0, clamps = 0, unconverged = 0;
  int bad_poses = 0, jumps = 0, deepest_factor = 0;
  double removed = 0;      // m³
  int slips = 0;           // steps with a tool that slipped off
  double servo_error = 0;  // N, largest
};

double HeapMb() {
  const struct mallinfo2 info = mallinfo2();
  return 1e-6 * static_cast<double>(info.uordblks + info.hblkhd);
}

double ResidentMb() {
  std::ifstream file("/proc/self/statm");
  double pages = 0, resident = 0;
  file >> pages >> resident;
  return 1e-6 * resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

void NoteSlow(SlowStep step, std::vector<SlowStep>& slowest) {
  constexpr std::size_t kNoted = 12;
  if (slowest.size() == kNoted && step.ms <= slowest.back().ms) return;
  const auto place = std::ranges::upper_bound(slowest, step.ms, std::greater<>(), &SlowStep::ms);
  slowest.insert(place, std::move(step));
  if (slowest.size() > kNoted) slowest.pop_back();
}

Soak Run(const Plan& plan) {
  const BodySpec spec = test::MeniscusBody();
  TissueWorld world({spec}, plan.body, nullptr, plan.has_thread);
  world.TakeMemory();
  test::RandomHand hand(plan.seed, spec.portal_from_body);
  WorldPicture picture;
  Soak soak;
  Hash hash;
  // Room at once: what is noted down is not to look like a leak.
  const auto steps = static_cast<std::size_t>(plan.minutes * plan.minute);
  for (std::vector<double>* of_steps :
       {&soak.all_ms, &soak.uncut_ms, &soak.work, &soak.iterations, &soak.pages, &soak.servo_share})
    of_steps->reserve(steps);
  soak.reset_ms.reserve(steps / kCutsToReset + static_cast<std::size_t>(plan.minutes));
  const auto reset = [&] {
    const CutReport& cut = picture.bodies[0].cut;
    soak.removed += cut.removed;
    soak.debris += cut.debris;
    ++soak.sessions;
    const double begin = ThreadCpuMs();
    world.Reset();
    soak.reset_ms.push_back(ThreadCpuMs() - begin);
    world.TakeMemory();
    world.Show(picture);
  };
  for (int step = 1; step <= plan.minutes * plan.minute; ++step) {
    // A display that misses frames now and then: up to three at once.
    const double dt = step % 97 == 0 ? 3 * kFrame : kFrame;
    const Instrumentation now = hand.Next(dt);
    const long pages = ThreadPageFaults();
    const double begin = ThreadCpuMs();
    world.Step(now, dt);
    const double took = ThreadCpuMs() - begin;
    soak.pages.push_back(static_cast<double>(ThreadPageFaults() - pages));
    world.Show(picture);

    const BodyPicture& body = picture.bodies[0];
    const BodyReport& report = body.report;
    const ToolCoupling& coupling = world.coupling();
    ++soak.steps;
    soak.all_ms.push_back(took);
    if (!report.was_cut && !report.took_shape) soak.uncut_ms.push_back(took);
    const bool solved = !report.is_asleep && !report.was_cut && !report.took_shape;
    if (solved) soak.work.push_back(report.step.work);
    NoteSlow({step, took,
              report.was_cut      ? "cut"
              : report.took_shape ? "made a shape"
                                  : fmt::format("solved, work {}", report.step.work)},
             soak.slowest);
    if (!report.is_asleep) {
      ++soak.awake;
      soak.iterations.push_back(report.step.iterations);
    }
    soak.touched += report.contacts > 0;
    soak.cuts += report.was_cut;
    soak.slips += report.slipped > 0;
    if (report.tool_force > 0) {
      soak.servo_share.push_back(100 * report.servo_error / report.tool_force);
      soak.servo_error = std::max(soak.servo_error, report.servo_error);
    }
    soak.faults += report.was_reset;
    soak.unsaid_faults += report.was_reset && !coupling.is_faulty;
    soak.inverted += report.step.inverted > 0;
    soak.fallbacks += report.step.used_fallback;
    soak.clamps += report.step.clamped_speed;
    soak.unconverged += !report.is_asleep && !report.step.converged;
    soak.deepest_factor = std::max(soak.deepest_factor, report.factor_age);
    // A coupling's tip is the hand's own, which may be no number; its contacts may not.
    ToolCoupling of_tissue = coupling;
    of_tissue.tip = glm::dvec3(0.0);
    soak.not_finite +=
        !AllFinite(body.positions) || !AllFinite(body.normals) || !IsFinite(of_tissue);

    for (const glm::dvec3& x : body.positions) hash.Add(x);
    hash.Add(static_cast<double>(coupling.step));
    hash.Add(coupling.count);
    for (int i = 0; i < coupling.count; ++i) {
      const TissueContact& contact = coupling.contact[static_cast<std::size_t>(i)];
      hash.Add(contact.rub), hash.Add(contact.normal);
      for (const double number : {contact.stiffness, contact.depth, contact.power})
        hash.Add(number);
      for (int column = 0; column < 3; ++column) hash.Add(contact.curvature[column]);
    }
    hash.Add(body.cut.removed);

    const bool is_minute = step % plan.minute == 0;
    if (is_minute || body.cut.cuts >= kCutsToReset) reset();
    if (!is_minute) continue;
    soak.minutes.push_back({hash.value(), HeapMb(), ResidentMb()});
    const Minute& minute = soak.minutes.back();
    std::printf("minute %2zu: heap %7.2f MB, resident %7.2f MB, bits %016llx, %d cuts, %d faults\n",
                soak.minutes.size(), minute.heap, minute.resident,
                static_cast<unsigned long long>(minute.hash), soak.cuts, soak.faults);
    std::fflush(stdout);
  }
  soak.bad_poses = hand.bad_poses();
  soak.jumps = hand.jumps();
  return soak;
}

std::string Quantiles(std::vector<double> values) {
  if (values.empty()) return "none";
  std::sort(values.begin(), values.end());
  const auto at = [&](double q) {
    return values[std::min(values.size() - 1,
                           static_cast<std::size_t>(q * static_cast<double>(values.size())))];
  };
  return fmt::format("p50 {:.2f}, p99 {:.2f}, p99.9 {:.2f}, most {:.2f}", at(0.5), at(0.99),
                     at(0.999), values.back());
}

void Print(const Soak& soak) {
  fmt::print("{} steps: {} awake, {} touched, {} jumps of the hand, {} bad poses\n", soak.steps,
             soak.awake, soak.touched, soak.jumps, soak.bad_poses);
  fmt::print("ms a step: {}\nms a step without a cut: {}\nms a reset: {}\n", Quantiles(soak.all_ms),
             Quantiles(soak.uncut_ms), Quantiles(soak.reset_ms));
  for (const SlowStep& slow : soak.slowest)
    fmt::print("  {:.1f} ms: step {} {}\n", slow.ms, slow.step, slow.did);
  fmt::print("work of a step that solved: {}\n", Quantiles(soak.work));
  fmt::print("pages a step got from the system: {}\n", Quantiles(soak.pages));
  fmt::print("iterations a step that is awake: {}; oldest factor {} steps\n",
             Quantiles(soak.iterations), soak.deepest_factor);
  fmt::print(
      "% of its force by which the servo is off where the step solved it: {}; {:.3f} N at most; {} "
      "steps slipped\n",
      Quantiles(soak.servo_share), soak.servo_error, soak.slips);
  fmt::print("{} cuts in {} sessions, {:.1f} mm³ removed, {} pieces of debris\n", soak.cuts,
             soak.sessions, 1e9 * soak.removed, soak.debris);
  fmt::print(
      "steps with inverted elements {}, fallback {}, speed clamped {}, above the tolerance {}, "
      "faults {}, not finite {}\n",
      soak.inverted, soak.fallbacks, soak.clamps, soak.unconverged, soak.faults, soak.not_finite);
  std::fflush(stdout);
}

// Claims that do not hold, one line each.
int Judge(const Plan& plan, const Soak& first, const Soak& second) {
  int failures = 0;
  const auto expect = [&](bool holds, const std::string& what) {
    if (holds) return;
    ++failures;
    fmt::print("FAILED: {}\n", what);
  };
  for (const Soak* soak : {&first, &second}) {
    expect(soak->not_finite == 0, "a position, a normal or a coupling was not a number");
    expect(soak->unsaid_faults == 0, "a body was reset and its coupling did not say so");
    expect(soak->faults == 0, "a body was reset by its solver");
    expect(soak->servo_share.empty() || std::ranges::max(soak->servo_share) < kServoShare,
           "the servo's force was off where the step solved it");
    expect(soak->touched > soak->steps / 10, "the hand hardly met the tissue");
    // mm³ a second of a session; a bite of a punch is some 5 mm³.
    expect(1e9 * soak->removed > 0.5 * kFrame * soak->steps, "the hand hardly cut");
    const Minute& early = soak->minutes.front();
    const Minute& late = soak->minutes.back();
    expect(late.heap - early.heap < kHeapGrowth, "the heap grew");
    // In the first minutes the allocator's arenas fill up.
    expect(plan.minutes < 10 || late.resident - soak->minutes[1].resident < kMemoryGrowth,
           "resident memory grew");
  }
  for (std::size_t i = 0; i < first.minutes.size(); ++i)
    if (first.minutes[i].hash != second.minutes[i].hash) {
      expect(false, fmt::format("other bits from minute {} on", i + 1));
      break;
    }
  return failures;
}

}  // namespace
}  // namespace arthro::simulation

int main(int argc, char** argv) {
  using namespace arthro::simulation;
  arthro::test::BenchReport report("tissue soak", argc, argv);
  Plan plan;
  if (report.quick()) plan.minutes = 2, plan.minute = 180;
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::strcmp(argv[i], "--seed") == 0) plan.seed = std::strtoull(argv[i + 1], nullptr, 10);
    if (std::strcmp(argv[i], "--minutes") == 0) plan.minutes = std::max(1, std::atoi(argv[i + 1]));
    if (std::strcmp(argv[i], "--work") == 0)
      plan.body.solver.max_work = std::max(1, std::atoi(argv[i + 1]));
  }
  const Soak first = Run(plan);
  Print(first);
  plan.has_thread = false;
  const Soak second = Run(plan);
  Print(second);
  return Judge(plan, first, second) == 0 ? 0 : 1;
}
