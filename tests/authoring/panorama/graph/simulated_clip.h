// A clip without pictures: the true homographies of a scope that moves over a plane, and pair
// estimates of them with Gaussian noise of known covariance.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/pairs/pair_estimate.h"

namespace arthro::test {

using authoring::FourPoints;
using authoring::PairEstimate;

inline constexpr double kFocal = 430, kCentre = 400, kRadius = 330;  // px of the rectified view

inline cv::Point2d Move(const cv::Matx33d& h, const cv::Point2d& p) {
  const cv::Vec3d q = h * cv::Vec3d(p.x, p.y, 1);
  return {q[0] / q[2], q[1] / q[2]};
}

// Centre and eight points at 85 % of the round window.
inline std::vector<cv::Point2d> NinePoints() {
  std::vector<cv::Point2d> points{{kCentre, kCentre}};
  for (int i = 0; i < 8; ++i)
    points.emplace_back(kCentre + 0.85 * kRadius * std::cos(i * CV_PI / 4),
                        kCentre + 0.85 * kRadius * std::sin(i * CV_PI / 4));
  return points;
}

// Homography P R inv(K): the scope at (x, y) and distance z over the plane, rotated by small
// angles.
inline cv::Matx33d PlaceOver(double x, double y, double z, double tilt_x, double tilt_y,
                             double roll) {
  const double cx = std::cos(tilt_x), sx = std::sin(tilt_x), cy = std::cos(tilt_y),
               sy = std::sin(tilt_y), cz = std::cos(roll), sz = std::sin(roll);
  const cv::Matx33d rx(1, 0, 0, 0, cx, -sx, 0, sx, cx), ry(cy, 0, sy, 0, 1, 0, -sy, 0, cy),
      rz(cz, -sz, 0, sz, cz, 0, 0, 0, 1), k(kFocal, 0, kCentre, 0, kFocal, kCentre, 0, 0, 1),
      p(z, 0, x, 0, z, y, 0, 0, 1);
  cv::Matx33d h = p * (rz * ry * rx) * k.inv();
  return h * (1 / h(2, 2));
}

// A closed ring of frames, or a line when it is not closed.
inline std::vector<cv::Matx33d> TruePlaces(int frames, bool is_closed, double step = 100) {
  std::vector<cv::Matx33d> places;
  for (int i = 0; i < frames; ++i) {
    const double turn = 2 * CV_PI * i / frames, reach = step * frames / (2 * CV_PI);
    const double x = is_closed ? 2000 + reach * std::cos(turn) : 500 + step * i;
    const double y = is_closed ? 1500 + reach * std::sin(turn) : 1500 + 60 * std::sin(0.3 * i);
    places.push_back(PlaceOver(x, y, kFocal * (1 + 0.06 * std::sin(1.7 * turn + 1)),
                               0.06 * std::sin(3 * turn), 0.06 * std::cos(2 * turn + 0.5),
                               0.2 * std::sin(turn)));
  }
  return places;
}

inline FourPoints ControlPoints() {
  const double d = 0.6 * kRadius;
  return {cv::Point2d(kCentre - d, kCentre - d), cv::Point2d(kCentre + d, kCentre - d),
          cv::Point2d(kCentre + d, kCentre + d), cv::Point2d(kCentre - d, kCentre + d)};
}

// Homography that maps four points to four others, exact to a double; OpenCV computes it from
// points of single precision.
inline cv::Matx33d FromFourPoints(const FourPoints& from, const FourPoints& to) {
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

// The true pair with noise of `sigma` px on every coordinate of the control points.
inline PairEstimate NoisyPair(const std::vector<cv::Matx33d>& places, int a, int b, double sigma,
                              std::mt19937& random) {
  std::normal_distribution<double> normal(0, sigma);
  PairEstimate pair;
  pair.a = a;
  pair.b = b;
  const cv::Matx33d truth =
      places[static_cast<std::size_t>(b)].inv() * places[static_cast<std::size_t>(a)];
  pair.control_in_a = ControlPoints();
  FourPoints to;
  for (std::size_t k = 0; k < 4; ++k) {
    to[k] = Move(truth, pair.control_in_a[k]);
    to[k].x += normal(random);
    to[k].y += normal(random);
  }
  pair.b_from_a = FromFourPoints(pair.control_in_a, to);
  pair.information = cv::Matx<double, 8, 8>::eye() * (1 / (sigma * sigma));
  pair.inliers = 200;
  pair.similarity = 0.8;
  pair.overlap = 0.6;
  return pair;
}

// Worst of the nine points of each frame after the best single homography of the plane, since a
// panorama's own plane is free.
inline std::vector<double> WorstErrors(const std::vector<cv::Matx33d>& estimated,
                                       const std::vector<cv::Matx33d>& truth) {
  cv::Matx33d plane = truth[0] * estimated[0].inv();
  const std::vector<cv::Point2d> points = NinePoints();
  for (int step = 0; step < 8; ++step) {
    cv::Matx<double, 8, 8> normal = cv::Matx<double, 8, 8>::eye() * 1e-12;
    cv::Matx<double, 8, 1> right = cv::Matx<double, 8, 1>::zeros();
    for (std::size_t i = 0; i < truth.size(); ++i)
      for (const cv::Point2d& p : points) {
        // In units of 1000 px, so that the eight numbers have similar magnitudes.
        const cv::Point2d q = Move(plane * estimated[i], p) * 1e-3, t = Move(truth[i], p) * 1e-3;
        const double rows[2][8] = {{q.x, q.y, 1, 0, 0, 0, -q.x * q.x, -q.x * q.y},
                                   {0, 0, 0, q.x, q.y, 1, -q.x * q.y, -q.y * q.y}};
        const double off[2] = {t.x - q.x, t.y - q.y};
        for (int r = 0; r < 2; ++r)
          for (int c = 0; c < 8; ++c) {
            right(c) += rows[r][c] * off[r];
            for (int d = 0; d < 8; ++d) normal(c, d) += rows[r][c] * rows[r][d];
          }
      }
    const cv::Matx<double, 8, 1> x = normal.solve(right, cv::DECOMP_CHOLESKY);
    const cv::Matx33d scale(1e-3, 0, 0, 0, 1e-3, 0, 0, 0, 1);
    plane = scale.inv() * cv::Matx33d(1 + x(0), x(1), x(2), x(3), 1 + x(4), x(5), x(6), x(7), 1) *
            scale * plane;
  }
  std::vector<double> worst(truth.size(), 0);
  for (std::size_t i = 0; i < truth.size(); ++i)
    for (const cv::Point2d& p : points)
      worst[i] = std::max(worst[i], cv::norm(Move(plane * estimated[i], p) - Move(truth[i], p)));
  return worst;
}

}  // namespace arthro::test
