// Finds pair estimates that contradict each other. Around a triangle of frames the three
// homographies must compose to the identity; a pair that spoils more triangles than it closes is
// false. Later, when all frames have positions, a pair that stays far from them is false too.
#pragma once

#include <vector>

#include "authoring/panorama/pairs/pair_estimate.h"
#include "simulation/core/options.h"

namespace arthro::authoring {

struct CycleOptions {
  double most_closure = 4.0;
  double closure_deviations = 5.0;
  template <class V>
  void Visit(V&& v) {
    v("most_closure", most_closure, Range{0.1, 100.0}, "px",
      "A loop of pairs that misses its beginning by more is inconsistent.");
    v("closure_deviations", closure_deviations, Range{1.0, 100.0}, "",
      "The same, times the error that the pairs' covariances expect; the larger one counts.");
  }
};

struct TriangleVote {
  int closes = 0, spoils = 0;
};

struct CycleCheck {
  std::vector<TriangleVote> votes;  // final votes, one per pair
  std::vector<bool> is_false;
  double worst_closure_px = 0, mean_closure_px = 0;  // over the triangles among the kept pairs
};

CycleCheck CheckTriangles(int frames, const std::vector<PairEstimate>& pairs,
                          const CycleOptions& options);

}  // namespace arthro::authoring
