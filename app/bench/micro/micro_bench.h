// Times of single functions by Google Benchmark, each with the distance of its result from an
// independent reference beside it. A group holds the functions of one stage and names the reference
// of its errors.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "simulation/core/options.h"
#include "simulation/core/progress.h"

namespace arthro::app {

struct MicroBenchOptions {
  std::string only;
  int repetitions = 30;
  double min_time = 0.01;
  bool quick = false;
  template <class V>
  void Visit(V&& v) {
    v("only", only, Any{}, "", "Groups whose names begin so; empty for all of them.");
    v("repetitions", repetitions, Range{1, 1000}, "", "Samples per function.");
    v("min_time", min_time, Range{1e-4, 10.0}, "s", "Shortest duration of a sample.");
    v("quick", quick, Any{}, "", "Small inputs and few samples: shows that every function runs.");
  }
};

// Distance of a result from the reference of its group.
struct MicroError {
  double value = std::numeric_limits<double>::quiet_NaN();  // in the unit of the group
  std::string text;                                         // for the table
};

struct MicroFunction {
  std::string name;
  std::function<void()> call;
  std::function<MicroError()> error;  // empty: the result is exact, or the reference itself
};

struct MicroGroup {
  std::string name;       // "lens"
  std::string error;      // quantity and unit of the errors: "worst radius error, px"
  std::string reference;  // "lens that rendered the targets"
  std::vector<MicroFunction> functions;
};

struct MicroRow {
  std::string group, name;
  double wall = 0, wall_p99 = 0, cpu = 0;  // s per call: median and 99th percentile of the samples
  MicroError error;
};

struct MicroBench {
  MicroBenchOptions options;
  std::vector<MicroGroup> groups;
  std::vector<MicroRow> rows;
};

MicroGroup AlignmentMicro(bool quick);  // poses of tissues from landmarks
MicroGroup ScopeMicro(bool quick);      // closed forms of the arthroscope, pivot calibration
MicroGroup LensMicro(bool quick);       // lens fit, rectifier
MicroGroup DepthMicro(bool quick);      // depth from colour against known distances
MicroGroup PreviewMicro(bool quick);    // preview of the depth against the whole result
MicroGroup ComposeMicro(bool quick);    // composition of placed frames
MicroGroup SolidMicro(bool quick);      // functions of solids
MicroGroup ReachMicro(bool quick);      // reach of scope and instrument
MicroGroup SurfaceMicro(bool quick);    // checks and filling of surfaces
MicroGroup KernelMicro(bool quick);     // assembly and matrix products of tissue
MicroGroup ObserverMicro(bool quick);   // frames of an attempt
MicroGroup BrushMicro(bool quick);      // a stroke on a depth map
MicroGroup MurkMicro(bool quick);       // murk of the fluid

// Throws Error(kBadArgument) when no group is named so.
MicroBench RunMicroBench(const MicroBenchOptions& options, const Progress& progress);

std::string TableOf(const MicroBench& bench);
nlohmann::json JsonOf(const MicroBench& bench);
// SVG of one group's errors over time; empty where the group has none above zero.
std::string PlotOf(const MicroBench& bench, const MicroGroup& group);
std::string PlotOf(const MicroBench& bench);  // SVG of the first group that has errors

// Keeps `value` alive, so that the compiler computes it.
template <class T>
inline void KeepAlive(const T& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

// Input that is made when a function first asks for it, and shared by copies.
template <class Make>
auto MadeOnce(Make make) {
  using T = decltype(make());
  auto made = std::make_shared<std::optional<T>>();
  return [made, make]() -> T& {
    if (!*made) made->emplace(make());
    return **made;
  };
}

}  // namespace arthro::app
