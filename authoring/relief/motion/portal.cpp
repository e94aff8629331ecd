#include "authoring/relief/motion/portal.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "authoring/relief/median.h"
#include "simulation/core/at.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

using Poses = std::vector<std::optional<CameraPose>>;

constexpr double kClearly = 0.4;  // share of the simpler explanation's miss
// Share of the insertion by which skin gives; up to it no second explanation is looked for.
constexpr double kSkinGives = 0.03;
// Share of the insertion by which shafts may miss under an explanation with more unknowns.
constexpr double kExplains = 0.05;
constexpr int kLeastStretch = 6;  // least frames of a stretch, and of a wandering head

double CostOf(const PivotFit& fit) {
  return fit.median_insertion > 0 ? fit.median_miss / fit.median_insertion : 1e9;
}

// Part of the way from the portal to the tip that does not lie along the shaft.
Eigen::Vector3d MissOf(const CameraPose& pose, const Eigen::Vector3d& shaft,
                       const Eigen::Vector3d& point) {
  const Eigen::Vector3d u = pose.world_from_camera * shaft, way = pose.centre - point;
  return way - u * u.dot(way);
}

PivotFit FitLocked(const Poses& poses, double view_angle, double head_turn) {
  return FitPivot(poses, view_angle, std::vector<double>(poses.size(), head_turn));
}

// A head at one turn: by steps of 5 degrees, then finer.
PivotFit FindLocked(const Poses& poses, double view_angle, const PivotFit& straight) {
  PivotFit best = straight;
  const auto search = [&](double from, double to, double step) {
    const double middle = best.head_turns.empty() ? 0 : best.head_turns.front();
    for (double degrees = from; degrees <= to; degrees += step) {
      const PivotFit fit = FitLocked(poses, view_angle, middle + RadiansFromDegrees(degrees));
      if (CostOf(fit) < CostOf(best)) best = fit;
    }
  };
  search(-175, 180, 5);
  search(-5, 5, 0.25);
  return best;
}

// A portal that slid once, between the two frames that explain the misses best.
PivotFit FindSlide(const Poses& poses, double view_angle, const PivotFit& locked) {
  std::vector<int> posed;
  for (std::size_t f = 0; f < poses.size(); ++f)
    if (poses[f]) posed.push_back(static_cast<int>(f));
  PivotFit best = locked;
  double least = 1e300;
  for (int k = kLeastStretch; k + kLeastStretch <= static_cast<int>(posed.size()); ++k) {
    Poses before = poses, after = poses;
    std::fill(before.begin() + posed[At(k)], before.end(), std::nullopt);
    std::fill(after.begin(), after.begin() + posed[At(k)], std::nullopt);
    PivotFit fit = locked;
    fit.stretches = {
        {0, FitPivot(before, view_angle, locked.head_turns).stretches.front().point},
        {posed[At(k)], FitPivot(after, view_angle, locked.head_turns).stretches.front().point}};
    double squares = 0;
    for (const int f : posed)
      squares +=
          MissOf(*poses[At(f)], ShaftInCamera(view_angle, fit.head_turns[At(f)]), fit.PointOf(f))
              .squaredNorm();
    if (squares >= least) continue;
    least = squares;
    MeasurePivot(poses, view_angle, fit);
    best = std::move(fit);
  }
  return best;
}

// A head that wanders: the way from the portal to a tip makes the view angle with the optical axis,
// wherever the head is turned. Levenberg-Marquardt over the portal's three coordinates.
struct WanderingHead {
  const Poses& poses;
  double view_angle;

  Eigen::VectorXd Residuals(const Eigen::Vector3d& point, std::vector<double>* turns) const {
    constexpr double kSteady = 0.05;  // weight of a turn between two frames against a miss
    std::vector<double> residuals, found(poses.size(), 0);
    std::optional<double> last;
    for (std::size_t f = 0; f < poses.size(); ++f) {
      if (!poses[f]) continue;
      const Eigen::Vector3d d =
          poses[f]->world_from_camera.transpose() * (poses[f]->centre - point).normalized();
      residuals.push_back(std::atan2(d.head<2>().norm(), d.z()) - view_angle);
      found[f] = std::atan2(d.x(), d.y());
      if (last) {
        const double turn = std::remainder(found[f] - *last, 2 * M_PI);
        residuals.push_back(kSteady * turn);
        found[f] = *last + turn;
      }
      last = found[f];
    }
    if (turns) *turns = found;
    return Eigen::Map<Eigen::VectorXd>(residuals.data(),
                                       static_cast<Eigen::Index>(residuals.size()));
  }

  // Moves the portal to the nearest minimum; `length` is the unit of its coordinates.
  double Descend(Eigen::Vector3d& point, double length) const {
    Eigen::VectorXd residuals = Residuals(point, nullptr);
    double cost = residuals.squaredNorm(), damping = 1e-2;
    for (int step = 0; step < 60 && damping < 1e6; ++step) {
      Eigen::MatrixXd slope(residuals.size(), 3);
      const double small = 1e-5 * length;
      for (int i = 0; i < 3; ++i)
        slope.col(i) =
            (Residuals(point + small * Eigen::Vector3d::Unit(i), nullptr) - residuals) / small;
      Eigen::Matrix3d normal = slope.transpose() * slope;
      normal.diagonal() *= 1 + damping;
      const Eigen::Vector3d move = -normal.ldlt().solve(slope.transpose() * residuals);
      if (!move.allFinite()) break;
      const Eigen::VectorXd next = Residuals(point + move, nullptr);
      if (next.squaredNorm() < cost) {
        const bool is_done = cost - next.squaredNorm() < 1e-9 * cost;
        point += move;
        residuals = next;
        cost = next.squaredNorm();
        damping = std::max(1e-9, damping / 5);
        if (is_done) break;
      } else {
        damping *= 5;
      }
    }
    return cost;
  }
};

PivotFit FindWandering(const Poses& poses, double view_angle, const PivotFit& locked) {
  const WanderingHead head{poses, view_angle};
  // Starts behind the tips, at several distances and to every side.
  Eigen::Vector3d middle = Eigen::Vector3d::Zero(), axis = Eigen::Vector3d::Zero();
  int count = 0;
  for (const auto& pose : poses)
    if (pose) {
      middle += pose->centre;
      axis += pose->world_from_camera.col(2);
      ++count;
    }
  PivotFit best = locked;
  if (count < kLeastStretch) return best;
  middle /= count;
  axis.normalize();
  double spread = 0;
  for (const auto& pose : poses)
    if (pose) spread += (pose->centre - middle).squaredNorm() / count;
  spread = std::sqrt(spread);
  const Eigen::Vector3d aside = axis.unitOrthogonal(), across = axis.cross(aside);
  double least = 1e300;
  for (const double distance : {1.0, 2.0, 4.0, 8.0})
    for (int side = 0; side < 8; ++side) {
      const double angle = 2 * M_PI * side / 8;
      const Eigen::Vector3d way =
          std::cos(view_angle) * axis +
          std::sin(view_angle) * (std::cos(angle) * aside + std::sin(angle) * across);
      Eigen::Vector3d point = middle - distance * spread * way;
      const double cost = head.Descend(point, spread);
      if (!(cost < least) || !point.allFinite()) continue;
      PivotFit fit;
      fit.head = HeadMotion::kWandering;
      head.Residuals(point, &fit.head_turns);
      fit.stretches = {{0, point}};
      MeasurePivot(poses, view_angle, fit);
      if (!(fit.median_insertion > 0)) continue;
      least = cost;
      fit.shaft_spread = FitPivot(poses, view_angle, fit.head_turns).shaft_spread;
      best = std::move(fit);
    }
  return best;
}

}  // namespace

const Eigen::Vector3d& PivotFit::PointOf(int frame) const {
  const auto next = std::find_if(stretches.begin() + 1, stretches.end(),
                                 [frame](const PortalStretch& s) { return s.first > frame; });
  return std::prev(next)->point;
}

double PivotFit::MedianHeadTurn(const Poses& poses) const {
  std::vector<double> turns;
  for (std::size_t f = 0; f < poses.size() && f < head_turns.size(); ++f)
    if (poses[f]) turns.push_back(head_turns[f]);
  return Median(turns);
}

void MeasurePivot(const Poses& poses, double view_angle, PivotFit& fit) {
  std::vector<double> insertions, misses;
  for (std::size_t f = 0; f < poses.size(); ++f) {
    if (!poses[f]) continue;
    const Eigen::Vector3d shaft = ShaftInCamera(view_angle, fit.head_turns[f]);
    const Eigen::Vector3d& point = fit.PointOf(static_cast<int>(f));
    insertions.push_back((poses[f]->world_from_camera * shaft).dot(poses[f]->centre - point));
    misses.push_back(MissOf(*poses[f], shaft, point).norm());
  }
  fit.median_insertion = Median(insertions);
  fit.median_miss = Median(misses);
}

PivotFit FitPivot(const Poses& poses, double view_angle, const std::vector<double>& head_turns) {
  PivotFit fit;
  fit.head_turns = head_turns;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  int count = 0;
  for (std::size_t f = 0; f < poses.size(); ++f) {
    if (!poses[f]) continue;
    const Eigen::Vector3d u =
        poses[f]->world_from_camera * ShaftInCamera(view_angle, head_turns[f]);
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - u * u.transpose();
    normal += across;
    right += across * poses[f]->centre;
    ++count;
  }
  if (count < 3) return fit;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(normal / count);
  fit.shaft_spread = std::sqrt(std::max(0.0, eigen.eigenvalues()[0]));
  fit.stretches.front().point = normal.ldlt().solve(right);
  MeasurePivot(poses, view_angle, fit);
  return fit;
}

PivotFit FindPivot(const Poses& poses, double view_angle, bool is_straight) {
  PivotFit best = FitLocked(poses, view_angle, 0);
  if (CostOf(best) < kSkinGives) return best;
  if (!is_straight) {
    const PivotFit turned = FindLocked(poses, view_angle, best);
    if (CostOf(turned) < kClearly * CostOf(best)) best = turned;
    if (CostOf(best) < kSkinGives) return best;
  }
  const PivotFit slid = FindSlide(poses, view_angle, best);
  const PivotFit wandering = is_straight ? best : FindWandering(poses, view_angle, best);
  constexpr double kSimpler = 1.5;  // factor by which the simpler of the two may be worse
  const PivotFit& later = CostOf(slid) < kSimpler * CostOf(wandering) ? slid : wandering;
  const double most = std::min(kExplains, kClearly * CostOf(best));
  return CostOf(later) < most ? later : best;
}

Eigen::Matrix3d PortalAxes(const Poses& poses, double view_angle,
                           const std::vector<double>& head_turns) {
  Eigen::Vector3d z = Eigen::Vector3d::Zero(), x = Eigen::Vector3d::Zero();
  for (std::size_t f = 0; f < poses.size(); ++f)
    if (poses[f]) {
      z += poses[f]->world_from_camera *
           ShaftInCamera(view_angle, f < head_turns.size() ? head_turns[f] : 0);
      x += poses[f]->world_from_camera.col(0);
    }
  z.normalize();
  x -= z * z.dot(x);
  if (x.norm() < 1e-6) x = z.unitOrthogonal();
  x.normalize();
  Eigen::Matrix3d axes;
  axes.row(0) = x;
  axes.row(1) = z.cross(x);
  axes.row(2) = z;
  return axes;
}

void ChangeFrame(const Eigen::Matrix3d& axes, const Eigen::Vector3d& origin, double scale,
                 Reconstruction& scene) {
  for (auto& pose : scene.poses)
    if (pose) {
      pose->world_from_camera = axes * pose->world_from_camera;
      pose->centre = scale * (axes * (pose->centre - origin));
    }
  for (TrackPoint& point : scene.points)
    point.position = scale * (axes * (point.position - origin));
}

}  // namespace arthro::authoring
