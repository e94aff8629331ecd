#include "authoring/relief/motion/bundle/pose_covariance.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace arthro::authoring {
namespace {

using PoseBlock = Eigen::Matrix<double, 2, 6>;
using PointBlock = Eigen::Matrix<double, 2, 3>;

std::size_t At(Eigen::Index i) { return static_cast<std::size_t>(i); }

Eigen::Matrix3d Cross(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

// Derivative of the pixel by the point in the camera frame, by central differences.
PointBlock PixelByLocal(const LensProfile& lens, const Eigen::Vector3d& local) {
  const double small = 1e-5 * local.norm();
  PointBlock slope;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d a = local + small * Eigen::Vector3d::Unit(i),
                          b = local - small * Eigen::Vector3d::Unit(i);
    Eigen::Vector2d up, down;
    lens.Project(a.data(), up.data());
    lens.Project(b.data(), down.data());
    slope.col(i) = (up - down) / (2 * small);
  }
  return slope;
}

// The frames that enter: all that have a pose, or as many of them as allowed.
std::vector<std::size_t> ChosenFrames(const Reconstruction& scene, int most) {
  std::vector<std::size_t> posed, chosen;
  for (std::size_t f = 0; f < scene.poses.size(); ++f)
    if (scene.poses[f]) posed.push_back(f);
  const std::size_t count = std::min(posed.size(), static_cast<std::size_t>(most));
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(posed[i * posed.size() / count]);
  return chosen;
}

// Normal equations of the poses after the points are eliminated. A pose's unknowns are a turn about
// the world's axes and a shift of the centre, in `unit`.
struct ReducedSystem {
  Eigen::MatrixXd normal;
  double squares = 0;        // px², weighted
  double weight = 0;         // mean over the observations
  double range = 0;          // mean distance of the points from their cameras, in units
  Eigen::Index freedom = 0;  // observations less unknowns
  std::vector<int> pose_of;  // index by frame; -1: does not enter
};

ReducedSystem Reduce(const std::vector<Track>& tracks, const LensProfile& lens,
                     const Reconstruction& scene, const std::vector<std::size_t>& chosen,
                     double unit) {
  constexpr double kLossAt = 1.0;  // px, that of the adjustment's Cauchy loss
  ReducedSystem system;
  const auto poses = static_cast<Eigen::Index>(chosen.size());
  system.normal = Eigen::MatrixXd::Zero(6 * poses, 6 * poses);
  system.freedom = 7 - 6 * poses;
  system.pose_of.assign(scene.poses.size(), -1);
  for (std::size_t i = 0; i < chosen.size(); ++i) system.pose_of[chosen[i]] = static_cast<int>(i);
  std::size_t observations = 0;
  for (const TrackPoint& point : scene.points) {
    const Track& track = tracks[At(point.track)];
    Eigen::Matrix3d v = Eigen::Matrix3d::Zero();
    std::vector<int> of;
    std::vector<Eigen::Matrix<double, 6, 3>> w;
    std::vector<Eigen::Matrix<double, 6, 6>> u;
    double squares = 0, weights = 0, ranges = 0;
    for (std::size_t k = 0; k < track.seen.size(); ++k) {
      const Observation& seen = track.seen[k];
      const int pose = system.pose_of[At(seen.frame)];
      if (!point.uses[k] || pose < 0) continue;
      const CameraPose& camera = *scene.poses[At(seen.frame)];
      const Eigen::Vector3d local = camera.InCamera(point.position);
      Eigen::Vector2d at;
      lens.Project(local.data(), at.data());
      const double error = (at - seen.pixel).squaredNorm();
      const double weight = 1 / (1 + error / (kLossAt * kLossAt));
      const PointBlock by_point =
          PixelByLocal(lens, local) * camera.world_from_camera.transpose() * unit;
      PoseBlock by_pose;
      by_pose.leftCols<3>() = by_point * Cross((point.position - camera.centre) / unit);
      by_pose.rightCols<3>() = -by_point;
      v += weight * by_point.transpose() * by_point;
      of.push_back(pose);
      w.push_back(weight * by_pose.transpose() * by_point);
      u.push_back(weight * by_pose.transpose() * by_pose);
      squares += weight * error;
      weights += weight;
      ranges += local.norm() / unit;
    }
    if (of.size() < 2) continue;
    const Eigen::LDLT<Eigen::Matrix3d> solver(v);
    for (std::size_t i = 0; i < of.size(); ++i) {
      system.normal.block<6, 6>(6 * of[i], 6 * of[i]) += u[i];
      const Eigen::Matrix<double, 3, 6> solved = solver.solve(w[i].transpose());
      for (std::size_t j = 0; j < of.size(); ++j)
        system.normal.block<6, 6>(6 * of[j], 6 * of[i]) -= w[j] * solved;
    }
    system.squares += squares;
    system.weight += weights;
    system.range += ranges;
    observations += of.size();
    system.freedom += 2 * static_cast<Eigen::Index>(of.size()) - 3;
  }
  const auto count = static_cast<double>(std::max<std::size_t>(1, observations));
  system.weight /= count;
  system.range /= count;
  return system;
}

// Motions of the poses under the seven similarity transforms, a column each.
Eigen::MatrixXd Similarities(const std::vector<Eigen::Vector3d>& centres) {
  Eigen::MatrixXd moves = Eigen::MatrixXd::Zero(6 * static_cast<Eigen::Index>(centres.size()), 7);
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const auto row = 6 * static_cast<Eigen::Index>(i);
    moves.block<3, 3>(row, 0).setIdentity();
    moves.block<3, 3>(row + 3, 0) = -Cross(centres[i]);
    moves.block<3, 3>(row + 3, 3).setIdentity();
    moves.block<3, 1>(row + 3, 6) = centres[i];
  }
  return moves;
}

}  // namespace

PoseSigmas SigmasOf(const std::vector<Track>& tracks, const LensProfile& lens,
                    const Reconstruction& scene, int most_frames) {
  PoseSigmas found;
  found.frames.resize(scene.poses.size());
  const std::vector<std::size_t> chosen = ChosenFrames(scene, most_frames);
  if (chosen.size() < 2) return found;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const std::size_t f : chosen)
    middle += scene.poses[f]->centre / static_cast<double>(chosen.size());
  double unit = 0;  // the cameras' spread, so that the matrix is well scaled
  std::vector<Eigen::Vector3d> centres;
  for (const std::size_t f : chosen) {
    centres.push_back(scene.poses[f]->centre - middle);
    unit += centres.back().squaredNorm() / static_cast<double>(chosen.size());
  }
  unit = std::sqrt(unit);
  if (!(unit > 0)) return found;
  for (Eigen::Vector3d& centre : centres) centre /= unit;

  ReducedSystem system = Reduce(tracks, lens, scene, chosen, unit);
  if (system.freedom <= 0) return found;
  const double variance = system.squares / static_cast<double>(system.freedom);
  found.pixel = std::sqrt(variance / system.weight);
  // The seven directions that pixels do not see get a weight of their own; the alignment takes them
  // out again.
  const Eigen::MatrixXd moves = Similarities(centres);
  const double weight = system.normal.diagonal().mean();
  system.normal += weight * moves * moves.transpose();
  const Eigen::Index size = system.normal.rows();
  const Eigen::LDLT<Eigen::MatrixXd> solver(system.normal);
  if (solver.info() != Eigen::Success || !solver.isPositive()) return found;
  Eigen::MatrixXd covariance = solver.solve(Eigen::MatrixXd::Identity(size, size)) * variance;
  // Aligns by the similarity that brings the poses nearest to where they are.
  const double lever = system.range * system.range;
  Eigen::MatrixXd weighted = moves;
  for (Eigen::Index row = 0; row < size; ++row)
    if (row % 6 < 3) weighted.row(row) *= lever;
  const Eigen::MatrixXd fit = (weighted.transpose() * moves).ldlt().solve(weighted.transpose());
  const Eigen::MatrixXd align = Eigen::MatrixXd::Identity(size, size) - moves * fit;
  covariance = align * covariance * align.transpose();
  for (std::size_t f = 0; f < scene.poses.size(); ++f) {
    if (!scene.poses[f]) continue;
    const auto next = std::lower_bound(chosen.begin(), chosen.end(), f);
    const bool is_before =
        next == chosen.end() || (next != chosen.begin() && *next - f > f - *std::prev(next));
    const auto row = 6 * ((is_before ? std::prev(next) : next) - chosen.begin());
    const double turn = covariance.block<3, 3>(row, row).trace(),
                 shift = covariance.block<3, 3>(row + 3, row + 3).trace();
    if (turn >= 0 && shift >= 0)
      found.frames[f] = PoseSigma{unit * std::sqrt(shift), std::sqrt(turn)};
  }
  return found;
}

double RmsRotation(const PoseSigmas& sigmas) {
  double squares = 0;
  int count = 0;
  for (const auto& frame : sigmas.frames)
    if (frame) squares += frame->rotation * frame->rotation, ++count;
  return std::sqrt(squares / std::max(1, count));
}

}  // namespace arthro::authoring
