// Structure from motion: poses of the frames and points of the tissue from tracks, grown from the
// pair of frames that shows most depth. Frame and unit are free until the portal is known.
#pragma once

#include <string>
#include <vector>

#include "authoring/relief/motion/bundle/bundle.h"
#include "authoring/relief/motion/bundle/lens_profile.h"
#include "authoring/relief/motion/bundle/tracks.h"
#include "authoring/relief/motion/growth.h"
#include "simulation/core/progress.h"

namespace arthro::authoring {

struct MotionFrame {
  int tracks = 0;       // seen in it
  int inliers = 0;      // tracks within 3 px of their point
  double rms_px = 0;    // residual of the inliers
  int other_piece = 0;  // above 0: posed in another piece of the clip than the scene
  std::string reason;   // why it has no pose; "" when it has
};

struct Motion {
  Reconstruction scene;
  std::vector<MotionFrame> frames;
  double rms_px = 0;
  // Residual that neighbouring long tracks share in a frame, rms over the frames' areas.
  double coherent_residual_px = 0;
  // Quantities that the verdicts test.
  double median_reach_px = 0;  // median over the tracks, of how far a track moves in the picture
  double rotation_residual_px = 0;  // 90th percentile over pairs, of the median after a rotation
  // Largest difference between the paths of the tip that different starts led to, rms over the
  // path's spread. 0 where one start explained nearly all frames.
  double start_difference = 0;
};

// Pieces of the clip that grow apart are joined where they show the same tissue: their tracks of
// one tissue point become one track.
Motion SolveMotion(std::vector<Track>& tracks, int frames, const LensProfile& lens,
                   const Progress& progress, const MotionObserver& observer = {});

}  // namespace arthro::authoring
