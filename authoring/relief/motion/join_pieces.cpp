#include "authoring/relief/motion/join_pieces.h"

#include <algorithm>
#include <array>
#include <optional>
#include <random>
#include <set>

#include <Eigen/Dense>
#include <opencv2/features2d.hpp>

#include "authoring/relief/motion/growth.h"
#include "simulation/core/at.h"

namespace arthro::authoring {
namespace {

constexpr int kLeastAgreeing = 15;         // shared points that agree with a similarity
constexpr double kLeastAgreement = 0.15;   // share of the shared points; look-alikes are many
constexpr double kAgrees = 1.5 * kInlier;  // px, before the adjustment of the whole
constexpr double kJoinRatio = 0.85;        // best over second-best descriptor distance
constexpr int kTrials = 1500;

// One tissue point in both pieces, by the numbers of its points.
struct SharedPoint {
  std::size_t in_scene = 0, in_other = 0;
};

// scene_from_other: x ↦ scale · rotation x + shift.
struct Similarity {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  double scale = 1;

  Eigen::Vector3d operator()(const Eigen::Vector3d& x) const {
    return scale * (rotation * x) + shift;
  }
  Similarity Inverse() const {
    const Eigen::Matrix3d back = rotation.transpose();
    return {back, -(back * shift) / scale, 1 / scale};
  }
};

// The descriptors of all points that have some, and the point of each row.
struct Looks {
  cv::Mat rows;  // CV_32F
  std::vector<std::size_t> point_of;
};

Looks LooksOf(const std::vector<Track>& tracks, const Reconstruction& scene) {
  Looks looks;
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    const cv::Mat& own = tracks[At(scene.points[i].track)].descriptors;
    if (own.empty()) continue;
    looks.rows.push_back(own);
    looks.point_of.insert(looks.point_of.end(), static_cast<std::size_t>(own.rows), i);
  }
  looks.rows.convertTo(looks.rows, CV_32F);
  return looks;
}

// For each point of `from` the one of `to` that looks most like it, where no other comes near.
std::vector<std::optional<std::size_t>> MostAlike(const Looks& from, const Looks& to,
                                                  std::size_t points) {
  std::vector<std::optional<std::size_t>> best(points);
  std::vector<float> least(points, std::numeric_limits<float>::max());
  std::vector<std::vector<cv::DMatch>> matches;
  constexpr int kNearest = 4;  // a point has up to three descriptors
  cv::BFMatcher(cv::NORM_L2).knnMatch(from.rows, to.rows, matches, kNearest);
  for (const auto& nearest : matches) {
    if (nearest.size() < 2) continue;
    const std::size_t point = to.point_of[At(nearest[0].trainIdx)];
    const auto second = std::find_if(nearest.begin() + 1, nearest.end(), [&](const auto& match) {
      return to.point_of[At(match.trainIdx)] != point;
    });
    if (second == nearest.end() || nearest[0].distance > kJoinRatio * second->distance) continue;
    const std::size_t own = from.point_of[At(nearest[0].queryIdx)];
    if (nearest[0].distance >= least[own]) continue;
    least[own] = nearest[0].distance;
    best[own] = point;
  }
  return best;
}

std::vector<SharedPoint> SharedPoints(const std::vector<Track>& tracks, const Reconstruction& scene,
                                      const Reconstruction& other) {
  std::vector<SharedPoint> shared;
  std::vector<int> in_scene(tracks.size(), -1);
  for (std::size_t i = 0; i < scene.points.size(); ++i)
    in_scene[At(scene.points[i].track)] = static_cast<int>(i);
  for (std::size_t i = 0; i < other.points.size(); ++i)
    if (const int at = in_scene[At(other.points[i].track)]; at >= 0) shared.push_back({At(at), i});
  const Looks ours = LooksOf(tracks, scene), theirs = LooksOf(tracks, other);
  if (ours.rows.empty() || theirs.rows.empty()) return shared;
  const auto there = MostAlike(ours, theirs, scene.points.size()),
             back = MostAlike(theirs, ours, other.points.size());
  for (std::size_t i = 0; i < there.size(); ++i)
    if (there[i] && back[*there[i]] == i && scene.points[i].track != other.points[*there[i]].track)
      shared.push_back({i, *there[i]});
  return shared;
}

// True where a position falls on most of the pixels at which a point was seen.
bool FallsOn(const std::vector<Track>& tracks, const LensProfile& lens, const Reconstruction& scene,
             const TrackPoint& point, const Eigen::Vector3d& position) {
  const Track& track = tracks[At(point.track)];
  int used = 0, agreeing = 0;
  for (std::size_t k = 0; k < track.seen.size(); ++k) {
    const auto& pose = scene.poses[At(track.seen[k].frame)];
    if (!pose || !point.uses[k]) continue;
    ++used;
    agreeing += PixelErrorOf(*pose, lens, position, track.seen[k]) < kAgrees;
  }
  return 2 * agreeing > used;
}

std::optional<Similarity> Fitted(const std::vector<SharedPoint>& shared,
                                 const Reconstruction& scene, const Reconstruction& other) {
  Eigen::Matrix3Xd from(3, shared.size()), to(3, shared.size());
  for (std::size_t i = 0; i < shared.size(); ++i) {
    from.col(static_cast<Eigen::Index>(i)) = other.points[shared[i].in_other].position;
    to.col(static_cast<Eigen::Index>(i)) = scene.points[shared[i].in_scene].position;
  }
  const Eigen::Matrix4d fit = Eigen::umeyama(from, to, true);
  const double scale = fit.col(0).head<3>().norm();
  if (!fit.allFinite() || !(scale > 1e-6) || !(scale < 1e6)) return std::nullopt;
  return Similarity{fit.topLeftCorner<3, 3>() / scale, fit.topRightCorner<3, 1>(), scale};
}

// The similarity that most shared points agree with, and those points.
std::optional<Similarity> FindSimilarity(const std::vector<Track>& tracks, const LensProfile& lens,
                                         const Reconstruction& scene, const Reconstruction& other,
                                         std::vector<SharedPoint>& shared) {
  if (shared.size() < static_cast<std::size_t>(kLeastAgreeing)) return std::nullopt;
  const auto agreeing = [&](const Similarity& similarity) {
    const Similarity back = similarity.Inverse();
    std::vector<SharedPoint> found;
    for (const SharedPoint& pair : shared) {
      const TrackPoint &ours = scene.points[pair.in_scene], &theirs = other.points[pair.in_other];
      if (FallsOn(tracks, lens, scene, ours, similarity(theirs.position)) &&
          FallsOn(tracks, lens, other, theirs, back(ours.position)))
        found.push_back(pair);
    }
    return found;
  };
  std::mt19937 random(1);
  std::vector<SharedPoint> most;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::array<std::size_t, 3> at{};
    for (std::size_t& i : at) i = random() % shared.size();
    if (at[0] == at[1] || at[1] == at[2] || at[0] == at[2]) continue;
    const auto similarity = Fitted({shared[at[0]], shared[at[1]], shared[at[2]]}, scene, other);
    if (!similarity) continue;
    auto found = agreeing(*similarity);
    if (found.size() > most.size()) most = std::move(found);
  }
  std::optional<Similarity> best;
  for (int round = 0; round < 3 && most.size() >= static_cast<std::size_t>(kLeastAgreeing);
       ++round) {
    const auto similarity = Fitted(most, scene, other);
    if (!similarity) break;
    auto found = agreeing(*similarity);
    if (best && found.size() <= most.size()) break;
    most = std::move(found);
    best = similarity;
  }
  if (most.size() < static_cast<std::size_t>(kLeastAgreeing) ||
      static_cast<double>(most.size()) < kLeastAgreement * static_cast<double>(shared.size()))
    return std::nullopt;
  shared = std::move(most);
  return best;
}

// Moves the observations of one track to another, but for frames that the other has.
void Merge(const Track& from, Track& to) {
  std::set<int> frames;
  for (const Observation& seen : to.seen) frames.insert(seen.frame);
  for (const Observation& seen : from.seen)
    if (frames.insert(seen.frame).second) to.seen.push_back(seen);
  std::sort(to.seen.begin(), to.seen.end(),
            [](const Observation& a, const Observation& b) { return a.frame < b.frame; });
  to.descriptors.push_back(from.descriptors);
}

// Share of the frames that only `other` posed and that their points still hold.
double HeldFrames(const std::vector<Track>& tracks, const LensProfile& lens,
                  const std::vector<bool>& is_new, const Reconstruction& scene) {
  std::vector<int> points(scene.poses.size(), 0), inliers(scene.poses.size(), 0);
  for (const TrackPoint& point : scene.points)
    for (const Observation& seen : tracks[At(point.track)].seen) {
      const auto& pose = scene.poses[At(seen.frame)];
      if (!pose) continue;
      ++points[At(seen.frame)];
      inliers[At(seen.frame)] += PixelErrorOf(*pose, lens, point.position, seen) < kInlier;
    }
  int held = 0, all = 0;
  for (std::size_t f = 0; f < is_new.size(); ++f) {
    if (!is_new[f]) continue;
    ++all;
    held += inliers[f] >= kLeastPoints && inliers[f] >= kLeastShare * points[f];
  }
  return static_cast<double>(held) / std::max(1, all);
}

// Points that frames of both pieces agree about.
int Bridges(const std::vector<Track>& tracks, const std::vector<bool>& is_new,
            const Reconstruction& scene) {
  int bridges = 0;
  for (const TrackPoint& point : scene.points) {
    bool is_old_seen = false, is_new_seen = false;
    const Track& track = tracks[At(point.track)];
    for (std::size_t k = 0; k < track.seen.size(); ++k) {
      if (!point.uses[k]) continue;
      (is_new[At(track.seen[k].frame)] ? is_new_seen : is_old_seen) = true;
    }
    bridges += is_old_seen && is_new_seen;
  }
  return bridges;
}

}  // namespace

bool JoinPieces(const Reconstruction& other, const LensProfile& lens, std::vector<Track>& tracks,
                const std::atomic<bool>* stop, Reconstruction& scene) {
  std::vector<SharedPoint> shared = SharedPoints(tracks, scene, other);
  const auto similarity = FindSimilarity(tracks, lens, scene, other, shared);
  if (!similarity) return false;

  std::vector<Track> merged = tracks;
  Reconstruction joined = scene;
  std::vector<bool> is_new(scene.poses.size(), false), has_point(tracks.size(), false);
  for (std::size_t f = 0; f < joined.poses.size(); ++f) {
    if (joined.poses[f] || !other.poses[f]) continue;
    is_new[f] = true;
    joined.poses[f] = CameraPose{similarity->rotation * other.poses[f]->world_from_camera,
                                 (*similarity)(other.poses[f]->centre)};
  }
  for (const SharedPoint& pair : shared) {
    const int ours = scene.points[pair.in_scene].track, theirs = other.points[pair.in_other].track;
    if (ours == theirs || merged[At(ours)].seen.empty() || merged[At(theirs)].seen.empty())
      continue;
    Merge(merged[At(theirs)], merged[At(ours)]);
    merged[At(theirs)] = {};
    has_point[At(ours)] = has_point[At(theirs)] = true;
  }
  // Merged tracks find their point anew; the others keep theirs.
  std::erase_if(joined.points, [&](const TrackPoint& point) { return has_point[At(point.track)]; });
  for (const TrackPoint& point : joined.points) has_point[At(point.track)] = true;
  for (TrackPoint point : other.points) {
    if (has_point[At(point.track)]) continue;
    point.position = (*similarity)(point.position);
    joined.points.push_back(std::move(point));
  }
  for (int round = 0; round < 3; ++round) {
    RefreshPoints(merged, lens, joined);
    AdjustBundle(merged, lens, {.iterations = 15, .stop = stop}, joined, nullptr);
  }
  RefreshPoints(merged, lens, joined);
  constexpr double kLeastHeld = 0.7;
  if (HeldFrames(merged, lens, is_new, joined) < kLeastHeld ||
      Bridges(merged, is_new, joined) < kLeastAgreeing)
    return false;
  tracks = std::move(merged);
  scene = std::move(joined);
  return true;
}

}  // namespace arthro::authoring
