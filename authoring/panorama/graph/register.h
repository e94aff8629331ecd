// Registration: where every frame of a clip lies in one plane. Features first, as the paper has it,
// each pair then refined and verified by all of its pixels; pairs without features are aligned
// directly; loops by prediction; then all frames at once. [paper, 3.1]
#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/lens/rectifier.h"
#include "authoring/panorama/frames/placed_frame.h"
#include "authoring/panorama/frames/working_frame.h"
#include "authoring/panorama/graph/focal_fit.h"
#include "authoring/panorama/graph/place_frames.h"
#include "authoring/panorama/pairs/direct_options.h"
#include "authoring/panorama/pairs/feature_options.h"
#include "simulation/core/part_visitor.h"
#include "simulation/core/progress.h"

namespace arthro::authoring {

enum class PairMethod { kFeaturesThenDirect, kDirect, kFeatures };

struct RegisterOptions {
  PairMethod method = PairMethod::kDirect;
  int threads = 2;
  FeatureOptions features;
  DirectOptions direct;
  GraphOptions graph;
  CycleOptions cycles;
  RefineOptions refine;
  template <class V>
  void Visit(V&& v) {
    v("method", method,
      Choices<PairMethod>{{{PairMethod::kFeaturesThenDirect, "features_then_direct"},
                           {PairMethod::kDirect, "direct"},
                           {PairMethod::kFeatures, "features"}}},
      "", "How pairs of frames are laid over each other.");
    v("threads", threads, Range{1, 64}, "", "Frames and pairs worked on at once.");
    features.Visit(v);
    direct.Visit(PartVisitor<V>{v, "direct_"});
    graph.Visit(PartVisitor<V>{v, "graph_"});
    cycles.Visit(PartVisitor<V>{v, "cycles_"});
    refine.Visit(PartVisitor<V>{v, "refine_"});
  }
};

// Share by which a lens file's focal length may miss the frames' own before it counts as wrong; on
// clips with a right lens it is found within a fifth of this.
inline constexpr double kFocalIsWrong = 0.01;

struct RegisterReport {
  double features_ms = 0, pairs_ms = 0, refine_ms = 0;  // CPU, all threads together
  int pairs_tried = 0, pairs_kept = 0, pairs_dropped = 0;
  int feature_pairs = 0, direct_pairs = 0;  // kept, by what found them first
  int components = 0;
  double drift_px = 0, closure_px = 0, variance_factor = 1, camera_deviation = 0, drift_factor = 0;
  FocalFit focal;                   // of the lens; not determined without one
  std::vector<PairEstimate> pairs;  // that were kept
  std::vector<std::string> warnings;
};

// One result a frame, in order. `mask` is the view's, at scale 1 or any other. Throws
// Error(kBadArgument) when working frames differ in size or scale, Error(kCancelled). With the lens
// that rectified the frames its focal length is checked, and where it is wrong the expected errors
// grow by what it costs.
std::vector<FrameResult> Register(const std::vector<WorkingFrame>& frames,
                                  const RectifiedView& view, const cv::Mat& mask,
                                  const RegisterOptions& options, RegisterReport* report,
                                  const Progress& progress, const Lens* lens = nullptr);

}  // namespace arthro::authoring
