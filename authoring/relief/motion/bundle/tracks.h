// Tissue points followed through the frames of a clip: optical flow forwards, checked backwards,
// and features over gaps. Frames are counted in the clip's usable frames; pixels are working ones.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "authoring/panorama/frames/working_frame.h"
#include "authoring/relief/relief_options.h"
#include "simulation/core/progress.h"
#include "simulation/scene/lens.h"

namespace arthro::authoring {

struct Observation {
  int frame = 0;
  Eigen::Vector2d pixel;
  Eigen::Vector3d ray;  // unit, camera frame
};

struct Track {
  std::vector<Observation> seen;  // sorted by frame, at most one per frame, at least two
  cv::Mat descriptors;            // CV_8UC1, a SIFT descriptor per row; may be empty
};

// Tracks that stay put in the picture while others move are fixed to the lens and are left out.
std::vector<Track> FollowPoints(const std::vector<WorkingFrame>& frames, const Lens& lens,
                                const ReliefOptions& options, const Progress& progress);

}  // namespace arthro::authoring
