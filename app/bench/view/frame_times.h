// Times of frames that are drawn in turns, one of each kind per turn.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

#include "app/bench/quantile.h"
#include "simulation/core/process_cost.h"

namespace arthro::app {

struct FrameTimes {
  double wall = 0, wall_p99 = 0;  // s per frame: median and 99th percentile
  double cpu = 0, cpu_p99 = 0;    // sum of all threads
  double thread = 0;              // thread that calls OpenGL, median

  // Upper bound of the wall time on two cores that do nothing else: the work of the calling thread,
  // and half of that of the others.
  double OnTwoCores() const { return thread + 0.5 * (cpu - thread); }
};

// Frames of one kind, in the order of the turns, s.
struct FrameSeries {
  std::vector<double> wall, cpu, thread;

  FrameTimes Times() const {
    return {Quantile(wall, 0.5), Quantile(wall, 0.99), Quantile(cpu, 0.5), Quantile(cpu, 0.99),
            Quantile(thread, 0.5)};
  }
  // Times beyond those of another kind in the same turn.
  FrameTimes Beyond(const FrameSeries& other) const {
    const auto differences = [](std::vector<double> these, const std::vector<double>& those) {
      std::transform(these.begin(), these.end(), those.begin(), these.begin(), std::minus<>());
      return these;
    };
    return FrameSeries{differences(wall, other.wall), differences(cpu, other.cpu),
                       differences(thread, other.thread)}
        .Times();
  }
};

// Draws frame(kind) and waits for it by finish(kind), in `turns` turns after `warm_up` turns in
// which drivers compile and upload. step(share) is called once per turn.
template <class Frame, class Finish, class Step>
std::vector<FrameSeries> DrawInTurns(std::size_t kinds, int turns, int warm_up, const Frame& frame,
                                     const Finish& finish, const Step& step) {
  using Clock = std::chrono::steady_clock;
  std::vector<FrameSeries> series(kinds);
  for (int i = 0; i < warm_up + turns; ++i) {
    step(static_cast<double>(i) / (warm_up + turns));
    for (std::size_t kind = 0; kind < kinds; ++kind) {
      const Clock::time_point start = Clock::now();
      const double cpu = ProcessCpuMs(), thread = ThreadCpuMs();
      frame(kind);
      finish(kind);
      if (i < warm_up) continue;
      series[kind].cpu.push_back(1e-3 * (ProcessCpuMs() - cpu));
      series[kind].thread.push_back(1e-3 * (ThreadCpuMs() - thread));
      series[kind].wall.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    }
  }
  return series;
}

}  // namespace arthro::app
