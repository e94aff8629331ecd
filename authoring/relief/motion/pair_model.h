// How two frames of a clip relate: by a rotation alone, or by a motion that shows depth.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "authoring/relief/motion/bundle/bundle.h"
#include "authoring/relief/motion/bundle/tracks.h"

namespace arthro::authoring {

// One track seen in both frames, by the numbers of its observations.
struct SharedTrack {
  int track = 0, in_a = 0, in_b = 0;
};

// The tracks of every frame: (track, observation) in the order of the tracks.
using TracksByFrame = std::vector<std::vector<std::pair<int, int>>>;
TracksByFrame IndexByFrame(const std::vector<Track>& tracks, int frames);

std::vector<SharedTrack> SharedTracks(const TracksByFrame& by_frame, int a, int b);

// Rotation b_from_a that fits the rays best, and the median residual that it leaves.
struct RotationFit {
  Eigen::Matrix3d b_from_a = Eigen::Matrix3d::Identity();
  double median = 0;  // rad
};
RotationFit FitRotation(const std::vector<Track>& tracks, const std::vector<SharedTrack>& shared);

// Pose of b in the camera frame of a, with a distance of 1 between them; from the essential matrix
// by MAGSAC. Nothing where too few tracks agree.
struct RelativePose {
  CameraPose b_in_a;
  int inliers = 0;
};
std::optional<RelativePose> FitMotion(const std::vector<Track>& tracks,
                                      const std::vector<SharedTrack>& shared, double threshold);

}  // namespace arthro::authoring
