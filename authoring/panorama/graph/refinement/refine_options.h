// Options of the refinement of all frames together (refine.h).
#pragma once

#include "simulation/core/options.h"

namespace arthro::authoring {

struct RefineOptions {
  double pair_floor = 0.03;
  double loss_scale = 3.0;
  int refine_iterations = 40;
  double camera_deviation = 0.0005;
  template <class V>
  void Visit(V&& v) {
    v("pair_floor", pair_floor, Range{0.0, 2.0}, "px",
      "Least error of every pair, added to its covariance.");
    v("loss_scale", loss_scale, Range{1.0, 100.0}, "",
      "Multiple of its expected error at which a pair begins to lose weight (Cauchy).");
    v("camera_deviation", camera_deviation, Range{0.0, 1.0}, "",
      "Deviation of a frame from the view of a calibrated scope onto a plane; widened for tissue "
      "that is not flat. 0 allows any homography.");
    v("refine_iterations", refine_iterations, Range{1, 1000}, "", "Iterations before giving up.");
  }
};

}  // namespace arthro::authoring
