// Focal length from the clip itself: a check of the given lens, and a way without one. Poses and
// points are adjusted with the focal length as one more unknown.
#pragma once

#include <atomic>
#include <vector>

#include "authoring/relief/motion/bundle/tracks.h"
#include "authoring/relief/motion/motion.h"
#include "simulation/scene/lens.h"

namespace arthro::authoring {

struct FocalFit {
  double factor = 1;  // new focal length over the old one
  double sigma = 0;   // standard error of the factor
  double rms_before_px = 0, rms_px = 0;
  Reconstruction scene;  // adjusted with it
};

FocalFit FitFocal(const std::vector<Track>& tracks, const Lens& lens, const Motion& motion,
                  const std::atomic<bool>* stop = nullptr);

// The same lens with another focal length; its round window stays.
Lens WithFocal(const Lens& lens, double factor);

// Rays of the observations through another lens. Observations outside of its model are dropped.
void ChangeLens(const Lens& lens, std::vector<Track>& tracks);

}  // namespace arthro::authoring
