// A benchmark's table: how long a callable takes (median and 99th percentile over many samples)
// and, beside it, how far its result is from an independent reference, since speed without error
// says nothing. A benchmark is a program of its own:
//   int main(int argc, char** argv) {
//     BenchReport report("scope", argc, argv);
//     report.Measure("view from pose", 1000, [&] { KeepAlive(ViewFromPose(pose, 0.5)); }, "2e-16
//     rad");
//   }
// `--quick` takes few samples: a smoke run that shows that it runs, not how fast.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace arthro::test {

// The compiler must believe that somebody looks at `value`.
template <class T>
inline void KeepAlive(const T& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

struct Timing {
  double median = 0, p99 = 0;  // s a call
};

// Times `calls` calls of `callable` a sample. Samples are sorted; p99 of n samples is the
// ceil(0.99 n)-th.
template <class F>
Timing TimeCalls(int warm_up, int samples, int calls, F&& callable) {
  using Clock = std::chrono::steady_clock;
  for (int i = 0; i < warm_up * calls; ++i) callable();
  std::vector<double> seconds(static_cast<std::size_t>(samples));
  for (double& s : seconds) {
    const Clock::time_point start = Clock::now();
    for (int i = 0; i < calls; ++i) callable();
    s = std::chrono::duration<double>(Clock::now() - start).count() / calls;
  }
  std::sort(seconds.begin(), seconds.end());
  const std::size_t last = seconds.size() - 1;
  return {seconds[seconds.size() / 2],
          seconds[std::min(last, (seconds.size() * 99 + 99) / 100 - 1)]};
}

class BenchReport {
 public:
  // Prints the header: what is measured, on which machine, in which build.
  BenchReport(const char* title, int argc, char** argv) {
    for (int i = 1; i < argc; ++i) quick_ |= std::strcmp(argv[i], "--quick") == 0;
    std::printf("# %s | %s | %u cores | %s | gcc %s%s\n", title, CpuModel().c_str(),
                std::thread::hardware_concurrency(), ARTHRO_BUILD_TYPE, __VERSION__,
                quick_ ? " | quick: times mean nothing" : "");
    std::printf("%-44s %10s %10s %-4s  %s\n", "what", "median", "p99", "unit", "error");
  }

  bool quick() const { return quick_; }

  // One row. `calls` is how many calls make a sample: choose it so that a sample lasts at least
  // some microseconds, or the clock is what is measured. `error` says how far the result is from
  // what.
  template <class F>
  Timing Measure(const std::string& name, int calls, F&& callable, const std::string& error = "",
                 int samples = 300) {
    const Timing timing = quick_ ? TimeCalls(0, 3, 1, callable)
                                 : TimeCalls(std::max(1, samples / 10), samples, calls, callable);
    Row(name, timing, error);
    return timing;
  }

  // A row whose times were taken elsewhere.
  void Row(const std::string& name, const Timing& timing, const std::string& error = "") const {
    struct Unit {
      double seconds;
      const char* name;
    };
    Unit unit{1e-9, "ns"};
    for (const Unit larger : {Unit{1e-6, "us"}, Unit{1e-3, "ms"}, Unit{1.0, "s"}})
      if (timing.median >= larger.seconds) unit = larger;
    std::printf("%-44s %10.3g %10.3g %-4s  %s\n", name.c_str(), timing.median / unit.seconds,
                timing.p99 / unit.seconds, unit.name, error.c_str());
    std::fflush(stdout);
  }

 private:
  static std::string CpuModel() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
      if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown processor";
  }

  bool quick_ = false;
};

}  // namespace arthro::test
