// Registration: the position of every frame of a clip in one plane [paper, 3.1]. Estimates pairs by
// features first, then refines and verifies each by all of its pixels; aligns pairs without
// features directly; closes loops by prediction; then refines all frames together.
#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/lens/rectifier.h"
#include "authoring/panorama/frames/placed_frame.h"
#include "authoring/panorama/frames/working_frame.h"
#include "authoring/panorama/graph/focal_fit.h"
#include "authoring/panorama/graph/place_frames.h"
#include "authoring/panorama/graph/register_options.h"
#include "simulation/core/progress.h"

namespace arthro::authoring {

// Least relative error of a lens file's focal length that counts as wrong; with a right lens the
// frames' own focal length agrees within a fifth of this.
inline constexpr double kFocalIsWrong = 0.01;

struct RegisterReport {
  double features_ms = 0, pairs_ms = 0, refine_ms = 0;  // processor time, all threads together
  int pairs_tried = 0, pairs_kept = 0, pairs_dropped = 0;
  int feature_pairs = 0, direct_pairs = 0;  // kept pairs, by the method that found them
  int components = 0;
  double drift_px = 0, closure_px = 0, variance_factor = 1, camera_deviation = 0, drift_factor = 0;
  FocalFit focal;                   // focal length of the lens; not determined without one
  std::vector<PairEstimate> pairs;  // kept pairs
  std::vector<std::string> warnings;
};

// Returns one result per frame, in order. `mask` is the view's, at scale 1 or any other. Throws
// Error(kBadArgument) when working frames differ in size or scale, and Error(kCancelled). With the
// lens that rectified the frames, checks its focal length; a wrong one increases the expected
// errors by its effect.
std::vector<FrameResult> Register(const std::vector<WorkingFrame>& frames,
                                  const RectifiedView& view, const cv::Mat& mask,
                                  const RegisterOptions& options, RegisterReport* report,
                                  const Progress& progress, const Lens* lens = nullptr);

}  // namespace arthro::authoring
