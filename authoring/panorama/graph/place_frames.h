// Places frames by their pairs: chooses pairs, rejects false ones, finds connected frames and
// computes their positions. Works with any source of pairs, so that it can be tested without
// pictures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/graph/cycle_check.h"
#include "authoring/panorama/graph/links/frame_window.h"
#include "authoring/panorama/graph/links/pair_book.h"
#include "authoring/panorama/graph/refinement/refine.h"
#include "authoring/panorama/graph/register_options.h"

namespace arthro::authoring {

struct PlacedGraph {
  std::vector<int> component;  // -1: not placed; 0: the panorama; 1…: pieces that are not joined
  std::vector<std::string> reason;            // why not placed
  std::vector<cv::Matx33d> plane_from_frame;  // each component in its central frame's plane
  std::vector<double> expected_error_px;      // in that plane
  std::vector<PairEstimate> pairs;            // accepted pairs
  std::vector<double> pair_error_px;          // residual of each
  int tried = 0, dropped = 0, loops = 0, bridges_refused = 0;
  double variance_factor = 1, camera_deviation = 0;  // values of component 0 (refine.h)
  double drift_factor = 0;  // median of the loops' squared disagreement over its expected variance
  double drift_px = 0;      // largest disagreement of a loop with the path around it
  double closure_px = 0;    // mean over the triangles
  double refine_ms = 0;     // processor time, single thread
};

// `camera`: of the rectified frames, if their lens is known. `unusable`: reason why a frame cannot
// be placed whatever its pairs; empty when it can.
PlacedGraph PlaceFrames(const std::vector<std::string>& unusable, const PairMaker& maker,
                        const FrameWindow& window, const std::optional<Pinhole>& camera,
                        const GraphOptions& options, const CycleOptions& cycles,
                        const RefineOptions& refine, int threads, const Progress& progress);

}  // namespace arthro::authoring
