// Structure from motion: poses of the frames and points of the tissue from tracks, grown from the
// pair of frames that shows most depth. Frame and unit are free until the portal is known.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "authoring/relief/bundle.h"
#include "authoring/relief/lens_profile.h"
#include "authoring/relief/tracks.h"
#include "simulation/core/progress.h"

namespace arthro::authoring {

struct MotionFrame {
  int tracks = 0;      // seen in it
  int inliers = 0;     // tracks within 3 px of their point
  double rms_px = 0;   // residual of the inliers
  std::string reason;  // why it has no pose; "" when it has
};

struct Motion {
  Reconstruction scene;
  std::vector<MotionFrame> frames;
  double rms_px = 0;
  double long_track_rms_px = 0;  // tracks seen in five frames and more, outliers up to 10 px
  // Quantities that the verdicts test.
  double median_reach_px = 0;  // median over the tracks, of how far a track moves in the picture
  double rotation_residual_px = 0;  // 90th percentile over pairs, of the median after a rotation
};

// Called whenever poses were added and adjusted, in a frame of its own. May be empty.
using MotionObserver = std::function<void(const Reconstruction&)>;

Motion SolveMotion(const std::vector<Track>& tracks, int frames, const LensProfile& lens,
                   const Progress& progress, const MotionObserver& observer = {});

// Keeps the observations within 3 px of their point, drops points that nothing determines, and adds
// points of tracks that have none. To be called between two adjustments.
void RefreshPoints(const std::vector<Track>& tracks, const LensProfile& lens,
                   Reconstruction& scene);

// Counts each frame's inliers and takes the poses away that too few hold.
void CountInliers(const std::vector<Track>& tracks, const LensProfile& lens, Motion& motion);

}  // namespace arthro::authoring
