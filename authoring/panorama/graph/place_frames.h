// Places frames by their pairs: chooses pairs, rejects false ones, finds connected frames and
// computes their positions. Works with any source of pairs, so that it can be tested without
// pictures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/graph/cycle_check.h"
#include "authoring/panorama/graph/frame_window.h"
#include "authoring/panorama/graph/pair_book.h"
#include "authoring/panorama/graph/refinement/refine.h"
#include "simulation/core/options.h"

namespace arthro::authoring {

enum class GraphStages { kPairs, kLoops, kRefinement };

struct GraphOptions {
  GraphStages stages = GraphStages::kRefinement;
  int loop_rounds = 2;
  double loops_per_frame = 0.7;
  double least_gain = 0.3;
  double loop_overlap = 0.25;
  int searches_per_gap = 6;
  double bridge_similarity = 0.3;
  double most_surprise = 4.0;
  double most_misfit = 3.0;
  template <class V>
  void Visit(V&& v) {
    v("stages", stages,
      Choices<GraphStages>{{{GraphStages::kPairs, "pairs"},
                            {GraphStages::kLoops, "loops"},
                            {GraphStages::kRefinement, "refinement"}}},
      "",
      "Extent of registration: neighbours only, with loops, or with the refinement of all frames "
      "together.");
    v("loop_rounds", loop_rounds, Range{0, 10}, "",
      "Number of searches for loops, each with the positions of the one before.");
    v("loops_per_frame", loops_per_frame, Range{0.0, 20.0}, "",
      "Pairs besides the neighbours that are tried, per frame and round.");
    v("least_gain", least_gain, Range{0.0, 100.0}, "",
      "A loop is tried when the variance that it would check is at least this multiple of its "
      "own.");
    v("loop_overlap", loop_overlap, Range{0.1, 1.0}, "",
      "Share of the window that two frames must have in common to be tried as a loop.");
    v("searches_per_gap", searches_per_gap, Range{0, 100}, "",
      "Pairs tried without prediction where neighbours do not agree.");
    v("bridge_similarity", bridge_similarity, Range{0.0, 1.0}, "",
      "A pair that alone joins two pieces must be at least this similar.");
    v("most_surprise", most_surprise, Range{1.0, 100.0}, "",
      "A pair that the places contradict by more than this times its error is false.");
    v("most_misfit", most_misfit, Range{0.1, 100.0}, "px",
      "The contradiction must also exceed this.");
  }
};

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
