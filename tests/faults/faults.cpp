// Disturbs every job of the program, its editor and its practice, at random moments and by every
// fault of fault.h, and looks at what is left [FILE-08, FILE-09, FILE-14].
//   faults [--count 500] [--seed 1] [--job WORDS] [--fault WORD] [--most-lost-s 2]
//          [--longest-force-ms 25] [--seconds S]
// Prints a table of jobs by faults and `N of N`. Windows need Xvfb, the full disk the right to
// mount.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tests/faults/job_trials.h"
#include "tests/faults/window_trials.h"
#include "tests/hostile/samples.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {
namespace {

struct Choice {
  int count = 500;
  double seconds = 1e9;
  std::uint64_t seed = 1;
  std::string job, fault;
  WindowLimits limits;
};

// A job and a fault that take part, by turns.
struct Pair {
  std::string job;
  Fault fault = Fault::kKill;
  std::function<Trial(double moment, double strength)> run;
  bool is_slow = false;
};

bool TakesPart(const std::string& job, Fault fault, const Choice& choice) {
  if (fault == Fault::kFullDisk && !SmallDisk::IsAllowed()) return false;
  return job.find(choice.job) != std::string::npos &&
         std::string(ToString(fault)).find(choice.fault) != std::string::npos;
}

// Windows take three times as many turns as another job: they have more states to be met in.
std::vector<Pair> PairsOf(const std::vector<FaultedJob>& jobs, JobTrials& job_trials,
                          WindowTrials* window_trials, const Choice& choice) {
  std::vector<Pair> pairs;
  for (const FaultedJob& job : jobs)
    for (const Fault fault : FaultsOf(job))
      if (TakesPart(job.name, fault, choice))
        pairs.push_back({job.name, fault,
                         [&job, &job_trials, fault](double moment, double strength) {
                           return job_trials.Run(job, fault, moment, strength);
                         },
                         job.is_slow});
  if (window_trials == nullptr) return pairs;
  for (const char* const window : {WindowTrials::kEdit, WindowTrials::kPractise})
    for (const Fault fault : WindowTrials::FaultsOf(window))
      for (int i = 0; i < 3 && TakesPart(window, fault, choice); ++i)
        pairs.push_back({window, fault, [=](double moment, double strength) {
                           return window == std::string(WindowTrials::kEdit)
                                      ? window_trials->Edit(fault, moment, strength)
                                      : window_trials->Practise(fault, moment, strength);
                         }});
  return pairs;
}

void PrintTable(const std::vector<Trial>& trials, const std::map<std::string, double>& seconds) {
  std::vector<std::string> jobs;
  for (const Trial& trial : trials)
    if (std::ranges::find(jobs, trial.job) == jobs.end()) jobs.push_back(trial.job);
  fmt::print(
      "\nTrials passed of trials, by job and fault. In brackets: signal, sentence, done, "
      "too late.\n{:24}",
      "");
  for (const Fault fault : kEveryFault) fmt::print("{:>11}", ToString(fault));
  fmt::print("\n");
  for (const std::string& job : jobs) {
    fmt::print("{:24}", job);
    for (const Fault fault : kEveryFault) {
      int passed = 0, all = 0;
      for (const Trial& trial : trials)
        if (trial.job == job && trial.fault == fault) ++all, passed += trial.complaints.empty();
      fmt::print("{:>11}", all == 0 ? "." : fmt::format("{}/{}", passed, all));
    }
    fmt::print("{:>9.1f} s\n", seconds.at(job));
  }
  fmt::print("{:24}", "[signal,sent.,done,late]");
  for (const Fault fault : kEveryFault) {
    std::array<int, 4> ends{};
    for (const Trial& trial : trials)
      if (trial.fault == fault) ++ends[static_cast<std::size_t>(trial.end)];
    fmt::print("{:>11}", fmt::format("{},{},{},{}", ends[0], ends[1], ends[2], ends[3]));
  }
  fmt::print("\n");
}

int RunTrials(const Choice& choice) {
  const TempFolder folder;
  const Samples samples(folder.path());
  const MappedFaultPage page(folder.path());
  const std::vector<FaultedJob> jobs = EveryFaultedJob(samples);
  JobTrials job_trials(samples, page);
  if (!SmallDisk::IsAllowed())
    fmt::print("No disk can be mounted here: the full disk takes no part.\n");

  std::mt19937_64 random(choice.seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::optional<WindowTrials> window_trials;
  if (WindowTrials::IsPossible())
    window_trials.emplace(samples, page, choice.limits);
  else
    fmt::print("Xvfb is not installed: windows take no part.\n");
  std::vector<Pair> pairs =
      PairsOf(jobs, job_trials, window_trials ? &*window_trials : nullptr, choice);
  if (pairs.empty()) throw std::runtime_error("there is no such job or fault");
  std::shuffle(pairs.begin(), pairs.end(), random);

  const bool has_quick = std::ranges::any_of(pairs, [](const Pair& p) { return !p.is_slow; });
  std::vector<Trial> trials;
  std::map<std::string, double> seconds;  // time of the trials of a job
  int failures = 0;
  const double end = MonotonicSeconds() + choice.seconds;
  for (int i = 0, turn = 0; i < choice.count && MonotonicSeconds() < end; ++i, ++turn) {
    // A slow job takes part in the first round only.
    const auto next = [&] { return static_cast<std::size_t>(turn) % pairs.size(); };
    while (has_quick && static_cast<std::size_t>(turn) >= pairs.size() && pairs[next()].is_slow)
      ++turn;
    const Pair& pair = pairs[next()];
    const double begin = MonotonicSeconds();
    const double moment = share(random), strength = share(random);
    Trial& trial = trials.emplace_back(Trial{pair.job, pair.fault});
    try {
      trial = pair.run(moment, strength);
    } catch (const std::exception& fault) {  // the undisturbed job fails
      trial.complaints.push_back(fault.what());
    }
    seconds[trial.job] += MonotonicSeconds() - begin;
    if (i % 50 == 49) {
      fmt::print("{} trials, {} failures\n", i + 1, failures);
      std::fflush(stdout);
    }
    if (trial.complaints.empty()) continue;
    ++failures;
    fmt::print("FAILURE {}: {}, {} at {:.3f} s, strength {:.2f}: {}\n  stderr: {}\n", i, trial.job,
               ToString(trial.fault), trial.at, strength,
               Printable(fmt::format("{}", fmt::join(trial.complaints, "; "))),
               Printable(trial.said));
    std::fflush(stdout);
  }
  PrintTable(trials, seconds);
  double lost = 0, force_ms = 0;
  for (const Trial& trial : trials) {
    lost = std::max(lost, trial.lost_s);
    force_ms = std::max(force_ms, trial.force_ms);
  }
  fmt::print("Most edits lost {:.2f} s, longest force after a fault {:.1f} ms\n", lost, force_ms);
  fmt::print("{} of {}\n", trials.size() - static_cast<std::size_t>(failures), trials.size());
  return failures == 0 ? 0 : 1;
}

}  // namespace
}  // namespace arthro::test

int main(int argc, char** argv) {
  arthro::test::Choice choice;
  CLI::App program("Disturbs every job and window at random moments and looks at what is left");
  program.add_option("--count", choice.count, "Trials")->capture_default_str();
  program.add_option("--seconds", choice.seconds, "Time after which no trial begins");
  program.add_option("--seed", choice.seed, "Start of the random sequence")->capture_default_str();
  program.add_option("--job", choice.job, "Only jobs that have these words in their name");
  program.add_option("--fault", choice.fault, "Only faults that have this word in their name");
  program
      .add_option("--most-lost-s", choice.limits.most_lost,
                  "Edits older than this must not be lost")
      ->capture_default_str();
  program
      .add_option("--longest-force-ms", choice.limits.longest_force_ms,
                  "Time after a fault by which no force is given")
      ->capture_default_str();
  CLI11_PARSE(program, argc, argv);
  try {
    return arthro::test::RunTrials(choice);
  } catch (const std::exception& error) {
    fmt::print(stderr, "faults: {}\n", error.what());
    return 2;
  }
}
