// Joins two reconstructions of one clip that show the same tissue: a similarity from points that
// both hold, either because a track runs through both or because their features look alike.
#pragma once

#include <atomic>
#include <vector>

#include "authoring/relief/motion/bundle/bundle.h"
#include "authoring/relief/motion/bundle/lens_profile.h"
#include "authoring/relief/motion/bundle/tracks.h"

namespace arthro::authoring {

// Adds the frames and points of `other` to `scene`. Tracks of one tissue point that were followed
// apart become one; the second of them is left without observations. False, and nothing is changed,
// where the two share too little.
bool JoinPieces(const Reconstruction& other, const LensProfile& lens, std::vector<Track>& tracks,
                const std::atomic<bool>* stop, Reconstruction& scene);

}  // namespace arthro::authoring
