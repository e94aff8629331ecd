#include "authoring/relief/motion/frame_inliers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "authoring/relief/median.h"
#include "authoring/relief/motion/growth.h"
#include "simulation/core/at.h"

namespace arthro::authoring {
namespace {

constexpr int kFollowed = 40;          // tracks of a frame that can be posed
constexpr std::size_t kLongTrack = 5;  // observations
constexpr double kLongReach = 10;      // px of residual, beyond which an observation is wrong

// Residuals of one area of one frame that point the same way: tissue that moved, not noise.
class Coherence {
 public:
  void Add(const Observation& seen, const Eigen::Vector2d& residual) {
    constexpr double kArea = 60;  // px
    areas_[{seen.frame, static_cast<int>(seen.pixel.x() / kArea),
            static_cast<int>(seen.pixel.y() / kArea)}]
        .push_back(residual);
  }

  // Root mean square over the areas of the median residual.
  double Rms() const {
    constexpr std::size_t kLeast = 5;  // residuals of an area
    double squares = 0;
    int count = 0;
    for (const auto& [area, residuals] : areas_) {
      if (residuals.size() < kLeast) continue;
      std::vector<double> x, y;
      for (const Eigen::Vector2d& r : residuals) x.push_back(r.x()), y.push_back(r.y());
      squares += Median(x) * Median(x) + Median(y) * Median(y);
      ++count;
    }
    return std::sqrt(squares / std::max(1, count));
  }

 private:
  std::map<std::array<int, 3>, std::vector<Eigen::Vector2d>> areas_;
};

Eigen::Vector2d ResidualOf(const CameraPose& pose, const LensProfile& lens,
                           const Eigen::Vector3d& point, const Observation& seen) {
  Eigen::Vector2d at;
  lens.Project(pose.InCamera(point).data(), at.data());
  return at - seen.pixel;
}

}  // namespace

void CountInliers(const std::vector<Track>& tracks, const LensProfile& lens, Motion& motion) {
  std::vector<double> squares(motion.frames.size(), 0);
  std::vector<int> points(motion.frames.size(), 0);
  for (MotionFrame& frame : motion.frames) frame.inliers = frame.tracks = 0;
  for (const Track& track : tracks)
    for (const Observation& seen : track.seen) ++motion.frames[At(seen.frame)].tracks;
  Coherence coherence;
  for (const TrackPoint& point : motion.scene.points) {
    const Track& track = tracks[At(point.track)];
    for (const Observation& seen : track.seen) {
      const auto& pose = motion.scene.poses[At(seen.frame)];
      if (!pose) continue;
      const double error = PixelErrorOf(*pose, lens, point.position, seen);
      ++points[At(seen.frame)];
      if (track.seen.size() >= kLongTrack && error < kLongReach)
        coherence.Add(seen, ResidualOf(*pose, lens, point.position, seen));
      if (error >= kInlier) continue;
      ++motion.frames[At(seen.frame)].inliers;
      squares[At(seen.frame)] += error * error;
    }
  }
  // Long tracks that no point explains count too: that is how tissue looks that moved.
  std::vector<bool> has_point(tracks.size(), false);
  for (const TrackPoint& point : motion.scene.points) has_point[At(point.track)] = true;
  for (std::size_t t = 0; t < tracks.size(); ++t) {
    if (has_point[t] || tracks[t].seen.size() < kLongTrack) continue;
    const auto point = NearestPoint(motion.scene, tracks[t]);
    if (!point) continue;
    for (const Observation& seen : tracks[t].seen)
      if (const auto& pose = motion.scene.poses[At(seen.frame)];
          pose && PixelErrorOf(*pose, lens, *point, seen) < kLongReach)
        coherence.Add(seen, ResidualOf(*pose, lens, *point, seen));
  }
  motion.coherent_residual_px = coherence.Rms();
  for (std::size_t f = 0; f < motion.frames.size(); ++f) {
    MotionFrame& frame = motion.frames[f];
    frame.rms_px = std::sqrt(squares[f] / std::max(1, frame.inliers));
    if (motion.scene.poses[f] &&
        (frame.inliers < kLeastPoints || frame.inliers < kLeastShare * points[f]))
      motion.scene.poses[f].reset();
    frame.reason =
        motion.scene.poses[f] ? ""
        : frame.tracks < kFollowed
            ? fmt::format("only {} points could be followed into it", frame.tracks)
        : frame.other_piece > 0
            ? fmt::format(
                  "it belongs to part {} of the clip, which shows no tissue that was "
                  "recognised in the largest part",
                  frame.other_piece + 1)
            : fmt::format("its {} points do not agree with the other frames", frame.tracks);
  }
}

}  // namespace arthro::authoring
