// Verifies that two frames show the same place under a homography, and estimates its accuracy.
// Applied to every pair, whichever method found it.
#pragma once

#include <string>

#include "authoring/panorama/pairs/direct_pyramid.h"
#include "authoring/panorama/pairs/pair_estimate.h"

namespace arthro::authoring {

struct PairVerdict {
  bool is_accepted = false;
  std::string why_not;      // empty when accepted
  double overlap = 0;       // share of frame a's pixels that frame b shows
  double similarity = 0;    // correlation of the two bands there
  double certainty = 0;     // certainty of the similarity, in deviations above chance
  double weakest_part = 0;  // least certainty among nine parts of the overlap
  double corner_sigma = 0;  // px: uncertainty of the worst corner of the overlap
};

// Fills overlap and similarity of `pair`; with `source` direct also control points, information,
// inliers and rms.
PairVerdict VerifyPair(const DirectPyramid& a, const DirectPyramid& b, const DirectOptions& options,
                       PairEstimate& pair);

}  // namespace arthro::authoring
