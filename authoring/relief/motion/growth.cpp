#include "authoring/relief/motion/growth.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <Eigen/Dense>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

#include "simulation/core/at.h"

namespace arthro::authoring {
namespace {

constexpr double kLeastAngle = 0.02618;  // rad (1.5°) between the rays of a point
constexpr double kGrowthPerAdjustment = 1.2;

// Largest angle between two used rays of a point.
double AngleOf(const Reconstruction& scene, const Track& track, const TrackPoint& point) {
  std::vector<Eigen::Vector3d> rays;
  for (std::size_t k = 0; k < track.seen.size(); ++k)
    if (const auto& pose = scene.poses[At(track.seen[k].frame)]; pose && point.uses[k])
      rays.push_back((point.position - pose->centre).normalized());
  double least = 1;
  for (std::size_t i = 0; i < rays.size(); ++i)
    for (std::size_t j = i + 1; j < rays.size(); ++j) least = std::min(least, rays[i].dot(rays[j]));
  return std::acos(std::clamp(least, -1.0, 1.0));
}

// The point nearest to the used rays; then drops the worst observation until all agree.
bool Triangulate(const Reconstruction& scene, const Track& track, const LensProfile& lens,
                 TrackPoint& point) {
  point.uses.assign(track.seen.size(), false);
  int posed = 0;
  for (std::size_t k = 0; k < track.seen.size(); ++k)
    if (scene.poses[At(track.seen[k].frame)]) point.uses[k] = true, ++posed;
  for (int used = posed; used >= 2 && 3 * used >= 2 * posed; --used) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < track.seen.size(); ++k) {
      if (!point.uses[k]) continue;
      const CameraPose& pose = *scene.poses[At(track.seen[k].frame)];
      const Eigen::Vector3d ray = pose.world_from_camera * track.seen[k].ray;
      const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - ray * ray.transpose();
      normal += across;
      right += across * pose.centre;
    }
    const Eigen::LDLT<Eigen::Matrix3d> solver(normal);
    point.position = solver.solve(right);
    if (!point.position.allFinite()) return false;
    double worst = 0;
    std::size_t worst_at = 0;
    for (std::size_t k = 0; k < track.seen.size(); ++k) {
      if (!point.uses[k]) continue;
      const double error =
          PixelErrorOf(*scene.poses[At(track.seen[k].frame)], lens, point.position, track.seen[k]);
      if (error > worst) worst = error, worst_at = k;
    }
    if (worst < kInlier) return AngleOf(scene, track, point) >= kLeastAngle;
    point.uses[worst_at] = false;
  }
  return false;
}

// Points of one frame's tracks.
struct FramePoints {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> pixels;
  std::vector<Observation> seen;
};

FramePoints PointsOf(const std::vector<Track>& tracks,
                     const std::vector<std::pair<int, int>>& in_frame,
                     const std::vector<int>& point_of, const Reconstruction& scene) {
  FramePoints found;
  for (const auto& [track, k] : in_frame) {
    if (point_of[At(track)] < 0) continue;
    const Observation& seen = tracks[At(track)].seen[At(k)];
    found.points.push_back(scene.points[At(point_of[At(track)])].position);
    found.pixels.push_back(seen.pixel);
    found.seen.push_back(seen);
  }
  return found;
}

int Refined(const FramePoints& all, const LensProfile& lens, CameraPose& pose) {
  int inliers = 0;
  for (const double reach : {4 * kInlier, kInlier, kInlier}) {
    FramePoints near;
    for (std::size_t i = 0; i < all.points.size(); ++i)
      if (PixelErrorOf(pose, lens, all.points[i], all.seen[i]) < reach) {
        near.points.push_back(all.points[i]);
        near.pixels.push_back(all.pixels[i]);
      }
    inliers = static_cast<int>(near.points.size());
    if (inliers < kLeastPoints || !AdjustPose(near.points, near.pixels, lens, pose)) return 0;
  }
  return inliers;
}

// Finds a pose from three points at a time, or from the nearest posed frame.
std::optional<CameraPose> PoseOf(const FramePoints& all, const LensProfile& lens,
                                 const std::optional<CameraPose>& neighbour) {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> flat;
  for (std::size_t i = 0; i < all.points.size(); ++i) {
    const Eigen::Vector3d& ray = all.seen[i].ray;
    if (ray.z() < 0.2) continue;
    points.emplace_back(all.points[i].x(), all.points[i].y(), all.points[i].z());
    flat.emplace_back(ray.x() / ray.z(), ray.y() / ray.z());
  }
  std::optional<CameraPose> best;
  int most = 0;
  const auto offer = [&](CameraPose pose) {
    const int inliers = Refined(all, lens, pose);
    if (inliers > most) most = inliers, best = pose;
  };
  cv::Mat turn, shift, rotation, inliers;
  if (points.size() >= static_cast<std::size_t>(kLeastPoints) &&
      cv::solvePnPRansac(points, flat, cv::Mat::eye(3, 3, CV_64F), cv::noArray(), turn, shift,
                         false, 500, static_cast<float>(2.5 / lens.focal_px()), 0.999, inliers,
                         cv::SOLVEPNP_AP3P)) {
    cv::Rodrigues(turn, rotation);
    Eigen::Matrix3d camera_from_world;
    Eigen::Vector3d t;
    cv::cv2eigen(rotation, camera_from_world);
    cv::cv2eigen(shift, t);
    offer({camera_from_world.transpose(), -camera_from_world.transpose() * t});
  }
  if (neighbour && 2 * most < static_cast<int>(all.points.size())) offer(*neighbour);
  if (most < kLeastPoints || most < kLeastShare * static_cast<double>(all.points.size()))
    return std::nullopt;
  return best;
}

}  // namespace

double PixelErrorOf(const CameraPose& pose, const LensProfile& lens, const Eigen::Vector3d& point,
                    const Observation& seen) {
  const Eigen::Vector3d local = pose.InCamera(point);
  if (local.dot(seen.ray) <= 0) return 1e9;
  Eigen::Vector2d at;
  lens.Project(local.data(), at.data());
  return (at - seen.pixel).norm();
}

std::optional<Eigen::Vector3d> NearestPoint(const Reconstruction& scene, const Track& track) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  int posed = 0;
  for (const Observation& seen : track.seen) {
    const auto& pose = scene.poses[At(seen.frame)];
    if (!pose) continue;
    const Eigen::Vector3d ray = pose->world_from_camera * seen.ray;
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - ray * ray.transpose();
    normal += across;
    right += across * pose->centre;
    ++posed;
  }
  if (posed < 2) return std::nullopt;
  const Eigen::Vector3d point = normal.ldlt().solve(right);
  if (!point.allFinite()) return std::nullopt;
  return point;
}

int PosedFrames(const Reconstruction& scene) {
  return static_cast<int>(
      std::count_if(scene.poses.begin(), scene.poses.end(), [](const auto& p) { return !!p; }));
}

void RefreshPoints(const std::vector<Track>& tracks, const LensProfile& lens,
                   Reconstruction& scene) {
  std::vector<TrackPoint> kept;
  std::vector<bool> has_point(tracks.size(), false);
  for (TrackPoint& point : scene.points) {
    const Track& track = tracks[At(point.track)];
    int used = 0;
    for (std::size_t k = 0; k < track.seen.size(); ++k) {
      const auto& pose = scene.poses[At(track.seen[k].frame)];
      point.uses[k] = pose && PixelErrorOf(*pose, lens, point.position, track.seen[k]) < kInlier;
      used += point.uses[k];
    }
    if (used < 2 || AngleOf(scene, track, point) < kLeastAngle) continue;
    has_point[At(point.track)] = true;
    kept.push_back(std::move(point));
  }
  for (std::size_t t = 0; t < tracks.size(); ++t) {
    if (has_point[t]) continue;
    TrackPoint point;
    point.track = static_cast<int>(t);
    if (Triangulate(scene, tracks[t], lens, point)) kept.push_back(std::move(point));
  }
  scene.points = std::move(kept);
}

Reconstruction StartFrom(const std::vector<Track>& tracks, const TracksByFrame& by_frame,
                         const LensProfile& lens, int frames, int a, int b,
                         const Progress& progress, double done) {
  Reconstruction scene;
  scene.poses.resize(At(frames));
  const auto shared = SharedTracks(by_frame, a, b);
  const auto motion = FitMotion(tracks, shared, 1.5 / lens.focal_px());
  if (!motion) return scene;
  scene.poses[At(a)] = CameraPose{};
  scene.poses[At(b)] = motion->b_in_a;
  for (int round = 0; round < 2; ++round) {
    RefreshPoints(tracks, lens, scene);
    progress.Step("choosing a start", done);
    AdjustBundle(tracks, lens, {.iterations = 20, .fixed_frame = a, .stop = progress.stop}, scene,
                 nullptr);
    progress.Step("choosing a start", done);
  }
  RefreshPoints(tracks, lens, scene);
  return scene;
}

void Grow(const std::vector<Track>& tracks, const TracksByFrame& by_frame, const LensProfile& lens,
          const std::vector<bool>& may_add, const Progress& progress,
          const MotionObserver& observer, Reconstruction& scene) {
  const int frames = static_cast<int>(scene.poses.size());
  const auto posed = [&] { return PosedFrames(scene); };
  int adjusted_at = posed();
  std::set<int> failed;
  for (bool is_second = false;;) {
    progress.Step("finding poses", static_cast<double>(posed()) / frames);
    std::vector<int> point_of(tracks.size(), -1);
    for (std::size_t i = 0; i < scene.points.size(); ++i)
      point_of[At(scene.points[i].track)] = static_cast<int>(i);
    int next = -1, most = kLeastPoints - 1;
    for (int f = 0; f < frames; ++f) {
      if (scene.poses[At(f)] || !may_add[At(f)] || failed.contains(f)) continue;
      const int seen = static_cast<int>(
          std::count_if(by_frame[At(f)].begin(), by_frame[At(f)].end(),
                        [&](const auto& entry) { return point_of[At(entry.first)] >= 0; }));
      if (seen > most) most = seen, next = f;
    }
    if (next < 0) {
      if (is_second || failed.empty()) break;
      // Those that failed once may find better points now.
      is_second = true;
      failed.clear();
      AdjustBundle(tracks, lens, {.stop = progress.stop}, scene, nullptr);
      RefreshPoints(tracks, lens, scene);
      continue;
    }
    std::optional<CameraPose> neighbour;
    for (int step = 1; step < frames && !neighbour; ++step)
      for (const int f : {next - step, next + step})
        if (f >= 0 && f < frames && scene.poses[At(f)] && !neighbour)
          neighbour = scene.poses[At(f)];
    const auto pose =
        PoseOf(PointsOf(tracks, by_frame[At(next)], point_of, scene), lens, neighbour);
    if (!pose) {
      failed.insert(next);
      continue;
    }
    scene.poses[At(next)] = pose;
    RefreshPoints(tracks, lens, scene);
    const int now = posed();
    if (now <= 6 || now >= kGrowthPerAdjustment * adjusted_at) {
      adjusted_at = now;
      AdjustBundle(tracks, lens, {.iterations = 12, .stop = progress.stop}, scene, nullptr);
      RefreshPoints(tracks, lens, scene);
      if (observer) observer(scene);
    }
  }
  for (int round = 0; round < 3; ++round) {
    progress.Step("adjusting all poses", 0.9);
    AdjustBundle(tracks, lens, {.iterations = round < 2 ? 15 : 40, .stop = progress.stop}, scene,
                 nullptr);
    progress.Step("adjusting all poses", 0.9);
    RefreshPoints(tracks, lens, scene);
    if (observer) observer(scene);
  }
}

}  // namespace arthro::authoring
