// Options for finding and matching the points of frames.
#pragma once

#include "simulation/core/options.h"

namespace arthro::authoring {

enum class Detector { kSurf, kSift, kAkaze, kOrb };

struct FeatureOptions {
  Detector detector = Detector::kSurf;
  int features = 700;
  double ratio = 0.85;
  double max_error = 3.0;
  int max_trials = 2000;
  int fewest_inliers = 16;
  int seed = 0;  // fixed, so that the same video gives the same panorama

  template <class V>
  void Visit(V&& v) {
    v("detector", detector,
      Choices<Detector>{{{Detector::kSurf, "surf"},
                         {Detector::kSift, "sift"},
                         {Detector::kAkaze, "akaze"},
                         {Detector::kOrb, "orb"}}},
      "", "Detector of points; SURF is the paper's.");
    v("features", features, Range{50, 10000}, "", "Points per frame, spread over it.");
    v("ratio", ratio, Range{0.3, 1.0}, "",
      "A match must be this much closer than the second best.");
    v("max_error", max_error, Range{0.5, 20.0}, "px", "A match with a larger error is an outlier.");
    v("max_trials", max_trials, Range{50, 100000}, "", "RANSAC samples before giving up.");
    v("fewest_inliers", fewest_inliers, Range{8, 1000}, "",
      "A pair with fewer inliers is refused.");
    v("seed", seed, Range{0, 2147483647}, "", "Start of the random sequence.");
  }
};

}  // namespace arthro::authoring
