// Speed against error of registration, on phantom clips with known homographies: detectors, working
// scales and stages of our chain, and OpenCV's stitcher on the same frames. The processor time
// spans from the decoded raw frame to its place, without drawing and scoring of the clip.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "authoring/panorama/graph/register_options.h"
#include "authoring/phantom/clip/clip_options.h"
#include "simulation/core/options.h"
#include "simulation/core/progress.h"

namespace arthro::app {

struct RegistrationBenchOptions {
  int seed = 1;
  int frames = 0;
  int width = 800, height = 640;
  bool every_chain = false;
  bool peers = true;
  double peer_limit = 60;
  template <class V>
  void Visit(V&& v) {
    v("seed", seed, Range{0, 2147483647}, "", "Seed of the phantom clips.");
    v("frames", frames, Range{0, 2000}, "",
      "Frames of each clip; 0 takes the number of its preset.");
    v("width", width, Range{64, 4096}, "px", "Width of a frame.");
    v("height", height, Range{64, 4096}, "px", "Height of a frame.");
    v("every_chain", every_chain, Any{}, "",
      "Run every detector at every scale with every set of stages, instead of varying one at a "
      "time.");
    v("peers", peers, Any{}, "", "Run OpenCV's stitcher beside ours.");
    v("peer_limit", peer_limit, Range{1, 3600}, "s", "Processor time limit of OpenCV's stitcher.");
  }
};

struct RegistrationBenchRow {
  std::string clip;   // "easy"
  std::string chain;  // "SURF, 1/2, loops + refinement"
  bool is_peer = false;
  std::string outcome = "done";
  int frames = 0, placed = 0, right = 0, wrong_as_good = 0;
  double mean_px = 0, max_px = 0;  // NaN when no frame is right
  double covered = 0;              // share of placed frames within their expected error
  double cpu_ms = 0;               // per frame
};

struct RegistrationBench {
  RegistrationBenchOptions options;
  std::vector<RegistrationBenchRow> rows;
};

// Chains in the order of the runs.
struct BenchChain {
  std::string words;
  double scale = 0.5;
  authoring::RegisterOptions options;
};
std::vector<BenchChain> BenchChains(bool every_chain);

RegistrationBench RunRegistrationBench(const RegistrationBenchOptions& options,
                                       const Progress& progress);

std::string TableOf(const RegistrationBench& bench);
nlohmann::json JsonOf(const RegistrationBench& bench);
std::string PlotOf(const RegistrationBench& bench);  // SVG

}  // namespace arthro::app
