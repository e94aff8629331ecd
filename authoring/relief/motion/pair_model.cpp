#include "authoring/relief/motion/pair_model.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

namespace arthro::authoring {
namespace {

constexpr double kLeastForward = 0.2;  // cosine; rays further off the axis have no flat picture
constexpr int kLeastInliers = 25;

const Observation& Seen(const std::vector<Track>& tracks, int track, int observation) {
  return tracks[static_cast<std::size_t>(track)].seen[static_cast<std::size_t>(observation)];
}

}  // namespace

TracksByFrame IndexByFrame(const std::vector<Track>& tracks, int frames) {
  TracksByFrame by_frame(static_cast<std::size_t>(frames));
  for (std::size_t t = 0; t < tracks.size(); ++t)
    for (std::size_t k = 0; k < tracks[t].seen.size(); ++k)
      by_frame[static_cast<std::size_t>(tracks[t].seen[k].frame)].emplace_back(static_cast<int>(t),
                                                                               static_cast<int>(k));
  return by_frame;
}

std::vector<SharedTrack> SharedTracks(const TracksByFrame& by_frame, int a, int b) {
  const auto &in_a = by_frame[static_cast<std::size_t>(a)],
             &in_b = by_frame[static_cast<std::size_t>(b)];
  std::vector<SharedTrack> shared;
  for (auto p = in_a.begin(), q = in_b.begin(); p != in_a.end() && q != in_b.end();) {
    if (p->first < q->first)
      ++p;
    else if (q->first < p->first)
      ++q;
    else {
      shared.push_back({p->first, p->second, q->second});
      ++p, ++q;
    }
  }
  return shared;
}

RotationFit FitRotation(const std::vector<Track>& tracks, const std::vector<SharedTrack>& shared) {
  RotationFit fit;
  if (shared.size() < 3) return fit;
  std::vector<double> residuals(shared.size(), 0);
  double scale = 1e9;  // the first fit weighs all alike
  for (int round = 0; round < 8; ++round) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < shared.size(); ++i) {
      const double weight = 1 / (1 + residuals[i] * residuals[i] / (scale * scale));
      sum += weight * Seen(tracks, shared[i].track, shared[i].in_b).ray *
             Seen(tracks, shared[i].track, shared[i].in_a).ray.transpose();
    }
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Vector3d signs(1, 1, 1);
    signs.z() = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
    fit.b_from_a = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
    for (std::size_t i = 0; i < shared.size(); ++i)
      residuals[i] = (fit.b_from_a * Seen(tracks, shared[i].track, shared[i].in_a).ray)
                         .cross(Seen(tracks, shared[i].track, shared[i].in_b).ray)
                         .norm();
    std::vector<double> sorted = residuals;
    std::nth_element(sorted.begin(),
                     sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
    fit.median = sorted[sorted.size() / 2];
    scale = std::max(1e-5, fit.median);
  }
  return fit;
}

std::optional<RelativePose> FitMotion(const std::vector<Track>& tracks,
                                      const std::vector<SharedTrack>& shared, double threshold) {
  std::vector<cv::Point2d> in_a, in_b;
  for (const SharedTrack& s : shared) {
    const Eigen::Vector3d &a = Seen(tracks, s.track, s.in_a).ray,
                          &b = Seen(tracks, s.track, s.in_b).ray;
    if (a.z() < kLeastForward || b.z() < kLeastForward) continue;
    in_a.emplace_back(a.x() / a.z(), a.y() / a.z());
    in_b.emplace_back(b.x() / b.z(), b.y() / b.z());
  }
  if (in_a.size() < static_cast<std::size_t>(kLeastInliers)) return std::nullopt;
  cv::Mat mask, r, t;
  const cv::Mat camera = cv::Mat::eye(3, 3, CV_64F);
  const cv::Mat essential =
      cv::findEssentialMat(in_a, in_b, camera, cv::USAC_MAGSAC, 0.9999, threshold, 2000, mask);
  if (essential.rows != 3 || essential.cols != 3) return std::nullopt;
  // Points far away, as at a small turn of the scope, are in front too.
  const int inliers = cv::recoverPose(essential, in_a, in_b, camera, r, t, 500.0, mask);
  if (inliers < kLeastInliers) return std::nullopt;
  Eigen::Matrix3d b_from_a;
  Eigen::Vector3d shift;
  cv::cv2eigen(r, b_from_a);
  cv::cv2eigen(t, shift);
  return RelativePose{{b_from_a.transpose(), -b_from_a.transpose() * shift}, inliers};
}

}  // namespace arthro::authoring
