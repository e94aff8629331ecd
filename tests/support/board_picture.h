// Raw pictures of a flat target through a given lens, computed in code: each pixel is the mean of 4
// x 4 rays. The target's lattice step is 1; the target may be limited to a number of squares.
#pragma once

#include <cmath>
#include <functional>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <opencv2/core.hpp>

#include "simulation/scene/lens.h"

namespace arthro::test {

struct BoardPlace {
  double tilt_x = 0, tilt_y = 0, roll = 0;  // rad
  glm::dvec3 middle{0, 0, 12};              // in the camera frame, steps
};

inline glm::dmat3 TurnOf(const BoardPlace& place) {
  const double a = place.tilt_x, b = place.tilt_y, c = place.roll;
  const glm::dmat3 x(1, 0, 0, 0, std::cos(a), std::sin(a), 0, -std::sin(a), std::cos(a));
  const glm::dmat3 y(std::cos(b), 0, -std::sin(b), 0, 1, 0, std::sin(b), 0, std::cos(b));
  const glm::dmat3 z(std::cos(c), std::sin(c), 0, -std::sin(c), std::cos(c), 0, 0, 0, 1);
  return y * x * z;
}

using RayOfPixel = std::function<bool(double x, double y, glm::dvec3& ray)>;

// `brightness` of a point of the board, 0 to 1.
inline cv::Mat BoardPicture(cv::Size size, const RayOfPixel& ray_of, const BoardPlace& place,
                            const std::function<double(double, double)>& brightness) {
  const glm::dmat3 turn = TurnOf(place);
  const glm::dvec3 normal = turn[2];
  cv::Mat picture(size, CV_8UC1, cv::Scalar(0));
  constexpr int kSide = 4;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      double sum = 0;
      for (int n = 0; n < kSide * kSide; ++n) {
        glm::dvec3 ray;
        if (!ray_of(x + (n % kSide + 0.5) / kSide - 0.5, y + (n / kSide + 0.5) / kSide - 0.5, ray))
          continue;
        const double along = glm::dot(normal, ray);
        if (!(along > 1e-6)) continue;
        const glm::dvec3 at = ray * (glm::dot(normal, place.middle) / along) - place.middle;
        sum += brightness(glm::dot(at, turn[0]), glm::dot(at, turn[1]));
      }
      picture.at<uchar>(y, x) = static_cast<uchar>(255 * sum / (kSide * kSide) + 0.5);
    }
  return picture;
}

inline double ChessAt(double u, double v) {
  if (std::abs(u) > 5 || std::abs(v) > 4) return 0.95;
  return (static_cast<int>(std::floor(u)) + static_cast<int>(std::floor(v))) & 1 ? 0.95 : 0.06;
}
inline double LinesAt(double u, double v) {
  return std::min(std::abs(u - std::round(u)), std::abs(v - std::round(v))) < 0.055 ? 0.1 : 1.0;
}
inline double DotsAt(double u, double v) {
  return std::hypot(u - std::round(u), v - std::round(v)) < 0.2 ? 0.1 : 1.0;
}

}  // namespace arthro::test
