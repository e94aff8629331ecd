// Speed against error of relief, on clips of a cavity with known surface and poses: measured from
// the motion of the scope with and without portal and brightness, estimated from the brightness of
// a panorama of homographies, and the points of COLMAP where it is installed. The processor time
// spans from the pictures to the relief.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "simulation/core/options.h"
#include "simulation/core/progress.h"

namespace arthro::app {

struct ReliefBenchOptions {
  int seed = 1;
  std::string clip;
  int touches = 1000;
  bool quick = false;
  template <class V>
  void Visit(V&& v) {
    v("seed", seed, Range{0, 2147483647}, "", "Seed of the noise and of the touches.");
    v("clip", clip, Any{}, "",
      "Folder of a clip with known truth: frames, lens.json, gt.json and radius.npy. None: three "
      "small clips that are drawn for the benchmark.");
    v("touches", touches, Range{10, 100000}, "", "Touches at which forces are compared.");
    v("quick", quick, Any{}, "", "One small clip and two ways.");
  }
};

struct ReliefBenchRow {
  std::string clip;  // "easy"
  std::string way;   // "motion and portal"
  std::string outcome = "done";
  int frames = 0, placed = 0;
  double cpu_ms = 0;    // per frame
  double coverage = 0;  // share of the directions that three frames see
  // Error of the radius about the portal, mm; NaN where there is no surface.
  double rmse_mm = 0, median_mm = 0;
  double within_1mm = 0, spearman = 0;
  double apart_px = 0;        // distance of one place between frames; NaN without a panorama
  double force_error = 0;     // N, rms
  double force_of_truth = 0;  // N, rms of the force over the true surface
};

struct ReliefBench {
  ReliefBenchOptions options;
  std::vector<ReliefBenchRow> rows;
};

ReliefBench RunReliefBench(const ReliefBenchOptions& options, const Progress& progress);

std::string TableOf(const ReliefBench& bench);
nlohmann::json JsonOf(const ReliefBench& bench);
std::string PlotOf(const ReliefBench& bench);  // SVG

}  // namespace arthro::app
