#include "authoring/panorama/graph/focal_fit.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Geometry>

#include "authoring/panorama/graph/links/pair_graph.h"

namespace arthro::authoring {
namespace {

constexpr double kReach = 0.12;
constexpr double kStep = 0.02;
// Factor by which pairs may exceed their expected error before they lose weight: a wrong lens must
// not be taken for many false pairs.
constexpr double kPairFactor = 25;
// Deviation of the camera's rule: a wrong lens violates it much more, relief a little.
constexpr double kCameraDeviation = 0.003;
constexpr double kVague = 0.01;  // share of the focal length: a larger deviation determines nothing

// Homography through four points.
cv::Matx33d Through(const FourPoints& from, const FourPoints& to) {
  cv::Matx<double, 8, 8> m = cv::Matx<double, 8, 8>::zeros();
  cv::Matx<double, 8, 1> right;
  for (int k = 0; k < 4; ++k) {
    const cv::Point2d &p = from[static_cast<std::size_t>(k)], &q = to[static_cast<std::size_t>(k)];
    const double rows[2][8] = {{p.x, p.y, 1, 0, 0, 0, -p.x * q.x, -p.y * q.x},
                               {0, 0, 0, p.x, p.y, 1, -p.x * q.y, -p.y * q.y}};
    for (int r = 0; r < 2; ++r)
      for (int c = 0; c < 8; ++c) m(2 * k + r, c) = rows[r][c];
    right(2 * k) = q.x;
    right(2 * k + 1) = q.y;
  }
  const cv::Matx<double, 8, 1> h = m.solve(right, cv::DECOMP_LU);
  return {h(0), h(1), h(2), h(3), h(4), h(5), h(6), h(7), 1};
}

// Misfit of all frames, placed with the other focal length.
double MisfitAt(const FocalChange& change, int frames, const std::vector<PairEstimate>& pairs,
                int root, const RefineOptions& options, std::vector<cv::Matx33d>* places) {
  std::vector<PairEstimate> moved;
  moved.reserve(pairs.size());
  for (const PairEstimate& pair : pairs) moved.push_back(change.Apply(pair));
  *places = LeastVarianceTree(frames, moved, root).root_from_frame;
  RefineOptions loose = options;
  loose.camera_deviation = kCameraDeviation;
  return CameraMisfit(moved, root, loose, change.camera(), kPairFactor, places);
}

// Homography that maps points closest to others, by Gauss-Newton; both sets are scaled down.
Eigen::Matrix3d Closest(const std::vector<Eigen::Vector2d>& from,
                        const std::vector<Eigen::Vector2d>& to) {
  Eigen::Matrix3d h = Eigen::Matrix3d::Identity();
  for (int step = 0; step < 10; ++step) {
    Eigen::Matrix<double, 8, 8> normal = 1e-12 * Eigen::Matrix<double, 8, 8>::Identity();
    Eigen::Matrix<double, 8, 1> right = Eigen::Matrix<double, 8, 1>::Zero();
    for (std::size_t i = 0; i < from.size(); ++i) {
      const Eigen::Vector2d q = (h * from[i].homogeneous()).hnormalized();
      Eigen::Matrix<double, 2, 8> j;
      j << q.x(), q.y(), 1, 0, 0, 0, -q.x() * q.x(), -q.x() * q.y(),  //
          0, 0, 0, q.x(), q.y(), 1, -q.y() * q.x(), -q.y() * q.y();
      normal += j.transpose() * j;
      right += j.transpose() * (to[i] - q);
    }
    const Eigen::Matrix<double, 8, 1> x = normal.ldlt().solve(right);
    if (!x.allFinite()) break;
    Eigen::Matrix3d move;
    move << 1 + x[0], x[1], x[2], x[3], 1 + x[4], x[5], x[6], x[7], 1;
    h = move * h;
    if (x.norm() < 1e-10) break;
  }
  return h;
}

}  // namespace

FocalChange::FocalChange(const Lens& lens, const RectifiedView& view, double factor)
    : lens_(lens), other_(lens), view_(view), factor_(factor) {
  other_.focal_px *= factor;
}

Pinhole FocalChange::camera() const { return {factor_ * view_.focal_px, view_.cx, view_.cy}; }

cv::Point2d FocalChange::Apply(const cv::Point2d& rectified) const {
  const cv::Point2d off = rectified - cv::Point2d(view_.cx, view_.cy);
  const double radius = std::hypot(off.x, off.y);
  if (!(radius > 1e-6)) return rectified;
  const auto raw = RadiusFromAngle(lens_, std::atan(radius / view_.focal_px));
  const auto angle = raw ? AngleFromRadius(other_, *raw) : std::nullopt;
  // A point beyond the range of a flat picture keeps its direction.
  const double theta = std::min(angle.value_or(1.45), 1.45);
  const double zoom = factor_ * view_.focal_px * std::tan(theta) / radius;
  return {view_.cx + zoom * off.x, view_.cy + zoom * off.y};
}

cv::Matx22d FocalChange::Derivative(const cv::Point2d& p) const {
  constexpr double kHalf = 0.5;  // px
  const cv::Point2d dx = Apply(p + cv::Point2d(kHalf, 0)) - Apply(p - cv::Point2d(kHalf, 0)),
                    dy = Apply(p + cv::Point2d(0, kHalf)) - Apply(p - cv::Point2d(0, kHalf));
  return {dx.x / (2 * kHalf), dy.x / (2 * kHalf), dx.y / (2 * kHalf), dy.y / (2 * kHalf)};
}

PairEstimate FocalChange::Apply(const PairEstimate& pair) const {
  PairEstimate moved = pair;
  FourPoints target;
  cv::Matx<double, 8, 8> back = cv::Matx<double, 8, 8>::zeros();
  for (std::size_t k = 0; k < 4; ++k) {
    const cv::Point2d in_b = authoring::Apply(pair.b_from_a, pair.control_in_a[k]);
    target[k] = Apply(in_b);
    moved.control_in_a[k] = Apply(pair.control_in_a[k]);
    const cv::Matx22d inverse = Derivative(in_b).inv();
    for (int r = 0; r < 2; ++r)
      for (int c = 0; c < 2; ++c)
        back(2 * static_cast<int>(k) + r, 2 * static_cast<int>(k) + c) = inverse(r, c);
  }
  moved.b_from_a = Through(moved.control_in_a, target);
  moved.information = back.t() * pair.information * back;
  return moved;
}

cv::Matx33d FocalChange::Apply(const cv::Matx33d& plane_from_frame) const {
  const double reach = 0.6 * view_.focal_px;
  FourPoints here, plane;
  for (std::size_t k = 0; k < 4; ++k) {
    const cv::Point2d p{view_.cx + (k % 2 ? reach : -reach), view_.cy + (k / 2 ? reach : -reach)};
    here[k] = Apply(p);
    plane[k] = authoring::Apply(plane_from_frame, p);
  }
  return Through(here, plane);
}

FocalFit FitFocal(int frames, const std::vector<PairEstimate>& pairs, int root, const Lens& lens,
                  const RectifiedView& view, const RefineOptions& options) {
  FocalFit fit;
  if (pairs.size() < 3 || !(view.focal_px > 0) || !(options.camera_deviation > 0)) return fit;
  std::map<int, double> known;  // keys in tenths of a step
  const auto misfit = [&](int tenths) {
    const auto [at, is_new] = known.emplace(tenths, 0.0);
    std::vector<cv::Matx33d> places;
    if (is_new)
      at->second = MisfitAt(FocalChange(lens, view, 1 + 0.1 * kStep * tenths), frames, pairs, root,
                            options, &places);
    return at->second;
  };
  // Descends in steps, then in ever finer ones, until both neighbours are worse.
  const int most = static_cast<int>(std::lround(10 * kReach / kStep));
  int best = 0, step = 10;
  const auto descend = [&] {
    for (bool is_moving = true; is_moving;) {
      is_moving = false;
      for (const int next : {best - step, best + step})
        if (std::abs(next) <= most && misfit(next) < misfit(best)) {
          best = next;
          is_moving = true;
          break;
        }
    }
  };
  descend();
  if (best != 0) {
    step = 3;
    descend();
  }
  if (std::abs(best) + step > most) return fit;
  const double low = misfit(best - step), here = misfit(best), high = misfit(best + step);
  const double bend = low + high - 2 * here, unit = 0.1 * kStep * step;
  if (!(bend > 0) || !std::isfinite(bend)) return fit;
  // The least misfit shows by how much the pairs exceed their expected error.
  const double expected = std::max(1.0, 4.0 * static_cast<double>(pairs.size()));
  const double worse = std::max(1.0, here / expected);
  fit.deviation = unit * std::sqrt(worse / bend);
  if (!(fit.deviation < kVague)) return fit;
  fit.is_determined = true;
  fit.factor = 1 + 0.1 * kStep * best + unit * 0.5 * (low - high) / bend;
  return fit;
}

std::vector<double> FocalErrors(const std::vector<cv::Matx33d>& plane_from_frame,
                                const std::vector<PairEstimate>& pairs, int root,
                                const FocalChange& change, const std::vector<cv::Point2d>& points,
                                const RefineOptions& options) {
  const std::size_t frames = plane_from_frame.size();
  std::vector<double> errors(frames, 0.0);
  std::vector<cv::Matx33d> other;
  MisfitAt(change, static_cast<int>(frames), pairs, root, options, &other);
  std::vector<std::size_t> joined;
  for (std::size_t i = 0; i < frames; ++i)
    if (std::any_of(pairs.begin(), pairs.end(), [i](const PairEstimate& pair) {
          return static_cast<std::size_t>(pair.a) == i || static_cast<std::size_t>(pair.b) == i;
        }))
      joined.push_back(i);
  if (joined.empty()) return errors;
  // The given positions are a homography away from the plane of the other ones; the root's is the
  // initial guess.
  const auto at_root = static_cast<std::size_t>(root);
  const cv::Matx33d begin = change.Apply(plane_from_frame[at_root]) * other[at_root].inv();
  std::vector<Eigen::Vector2d> from, to;
  const double scale = 1e-3;  // so that a homography's numbers have similar magnitudes
  for (const std::size_t i : joined)
    for (const cv::Point2d& p : points) {
      const cv::Point2d q = authoring::Apply(begin * other[i], change.Apply(p)),
                        t = authoring::Apply(plane_from_frame[i], p);
      from.emplace_back(scale * q.x, scale * q.y);
      to.emplace_back(scale * t.x, scale * t.y);
    }
  const Eigen::Matrix3d plane = Closest(from, to);
  for (std::size_t i = 0; i < joined.size(); ++i)
    for (std::size_t k = 0; k < points.size(); ++k) {
      const std::size_t at = i * points.size() + k;
      const double off = ((plane * from[at].homogeneous()).hnormalized() - to[at]).norm() / scale;
      errors[joined[i]] = std::max(errors[joined[i]], off);
    }
  return errors;
}

}  // namespace arthro::authoring
