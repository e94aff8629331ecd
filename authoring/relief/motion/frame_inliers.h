// How well each frame of a reconstruction is explained: the points that agree with its pose, and
// the residual that neighbouring tracks share. Pixels are working ones.
#pragma once

#include <vector>

#include "authoring/relief/motion/bundle/lens_profile.h"
#include "authoring/relief/motion/bundle/tracks.h"
#include "authoring/relief/motion/motion.h"

namespace arthro::authoring {

// Counts each frame's inliers, takes the poses away that too few hold, and says why a frame has
// none.
void CountInliers(const std::vector<Track>& tracks, const LensProfile& lens, Motion& motion);

}  // namespace arthro::authoring
