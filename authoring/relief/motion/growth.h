// Growth of a reconstruction: a start from two frames, then frame after frame, the one that sees
// most points first. Frame and unit are free.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "authoring/relief/motion/bundle/bundle.h"
#include "authoring/relief/motion/bundle/lens_profile.h"
#include "authoring/relief/motion/bundle/tracks.h"
#include "authoring/relief/motion/pair_model.h"
#include "simulation/core/progress.h"

namespace arthro::authoring {

inline constexpr double kInlier = 3.0;      // px between an observation and its point
inline constexpr int kLeastPoints = 12;     // points that a pose rests on
inline constexpr double kLeastShare = 0.4;  // share of a frame's points that agree with its pose

// Distance in the picture between a point and where it was seen; huge behind the camera.
double PixelErrorOf(const CameraPose& pose, const LensProfile& lens, const Eigen::Vector3d& point,
                    const Observation& seen);

// The point nearest to the rays of all posed observations; nothing where fewer than two are posed
// or the rays are parallel.
std::optional<Eigen::Vector3d> NearestPoint(const Reconstruction& scene, const Track& track);

int PosedFrames(const Reconstruction& scene);

// Two frames with points between them; without poses where the frames give none.
Reconstruction StartFrom(const std::vector<Track>& tracks, const TracksByFrame& by_frame,
                         const LensProfile& lens, int frames, int a, int b,
                         const Progress& progress, double done);

// Called whenever poses were added and adjusted, in a frame of its own. May be empty.
using MotionObserver = std::function<void(const Reconstruction&)>;

// Adds the frames of `may_add` that the points reach, and adjusts everything.
void Grow(const std::vector<Track>& tracks, const TracksByFrame& by_frame, const LensProfile& lens,
          const std::vector<bool>& may_add, const Progress& progress,
          const MotionObserver& observer, Reconstruction& scene);

// Keeps the observations within 3 px of their point, drops points that nothing determines, and adds
// points of tracks that have none. To be called between two adjustments.
void RefreshPoints(const std::vector<Track>& tracks, const LensProfile& lens,
                   Reconstruction& scene);

}  // namespace arthro::authoring
