// Backdrops whose surface is known in closed form, and the force that a tip under it must feel: the
// reference for touch. The relief is a smooth function of the pixel, sampled into a depth map of
// any precision; the nearest point of the exact surface is found by Newton's method on the pixel.
#pragma once

#include <cmath>
#include <functional>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "simulation/core/units.h"
#include "simulation/scene/image.h"
#include "simulation/scene/scene.h"

namespace arthro::test {

struct AnalyticRelief {
  Backdrop backdrop;
  int width = 1024, height = 1024;
  std::function<double(glm::dvec2)> relief;  // m, of a pixel

  // 0.05 mm pixels on a sphere of 50 mm.
  static AnalyticRelief Make(ProjectionType type, std::function<double(glm::dvec2)> relief) {
    AnalyticRelief made;
    made.backdrop.radius = 0.05;
    made.backdrop.projection.type = type;
    made.backdrop.projection.centre_px = {511.5, 511.5};
    made.backdrop.projection.focal_px = 1000.0;
    made.backdrop.projection.px_per_deg = 1000.0 * kRadianPerDegree;
    made.relief = std::move(relief);
    return made;
  }
  // Two crossed waves: 6.6 mm from the lowest to the highest point, slopes up to about 1.
  static AnalyticRelief Waves(ProjectionType type) {
    return Make(type, [](glm::dvec2 p) {
      return 0.0035 + 0.0022 * std::sin(0.0125 * p.x + 0.3) * std::cos(0.011 * p.y) +
             0.0011 * std::sin(0.008 * p.x + 0.02 * p.y);
    });
  }

  DepthMap Float() const {
    DepthMap map(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) map.at(x, y) = static_cast<float>(relief({x, y}));
    return map;
  }
  DepthMap EightBit(double range = 0.007) const {
    DepthMap map = Float();
    for (float& h : map.relief)
      h = static_cast<float>(std::round(static_cast<double>(h) / range * 255.0) / 255.0 * range);
    return map;
  }

  glm::dvec3 Surface(glm::dvec2 p) const {
    return (backdrop.radius - relief(p)) * DirectionFromPixel(backdrop.projection, p);
  }
  // Unit, into free space.
  glm::dvec3 Normal(glm::dvec2 p) const {
    constexpr double kStep = 0.01;
    const glm::dvec3 du = Surface(p + glm::dvec2(kStep, 0)) - Surface(p - glm::dvec2(kStep, 0));
    const glm::dvec3 dv = Surface(p + glm::dvec2(0, kStep)) - Surface(p - glm::dvec2(0, kStep));
    const glm::dvec3 n = glm::normalize(glm::cross(du, dv));
    return glm::dot(n, Surface(p)) < 0 ? n : -n;
  }
  // The pixel of the surface point nearest to x, near `start`.
  glm::dvec2 Nearest(const glm::dvec3& x, glm::dvec2 p) const {
    for (int i = 0; i < 50; ++i) {
      constexpr double kStep = 0.05;
      const auto half_square = [&](glm::dvec2 q) {
        const glm::dvec3 d = (Surface(q) - x) * 1e3;
        return 0.5 * glm::dot(d, d);
      };
      const glm::dvec2 ex(kStep, 0), ey(0, kStep);
      const double f = half_square(p), fx = half_square(p + ex), gx = half_square(p - ex);
      const double fy = half_square(p + ey), gy = half_square(p - ey);
      const double cross = (half_square(p + ex + ey) - half_square(p + ex - ey) -
                            half_square(p - ex + ey) + half_square(p - ex - ey)) /
                           4.0;
      const double a = fx - 2 * f + gx, c = fy - 2 * f + gy, b = cross;
      const glm::dvec2 gradient((fx - gx) / 2, (fy - gy) / 2);
      const double det = a * c - b * b;
      glm::dvec2 step =
          glm::dvec2(c * gradient.x - b * gradient.y, a * gradient.y - b * gradient.x) *
          (kStep / det);
      const double length = glm::length(step);
      if (length > 2.0) step *= 2.0 / length;
      p -= step;
      if (length < 1e-6) break;
    }
    return p;
  }
};

}  // namespace arthro::test
