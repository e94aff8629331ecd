// Finds pair estimates that contradict each other. Around a triangle of frames the three
// homographies must compose to the identity; a pair that spoils more triangles than it closes is
// false. Later, when all frames have positions, a pair that stays far from them is false too.
#pragma once

#include <vector>

#include "authoring/panorama/graph/register_options.h"
#include "authoring/panorama/pairs/pair_estimate.h"

namespace arthro::authoring {

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
