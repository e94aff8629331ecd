#include "tests/support/haptics/analytic_relief.h"

#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "simulation/core/units.h"

namespace arthro::test {
namespace {

// `distance` of the surface along a unit ray.
template <class Distance>
AnalyticRelief Small(Distance&& distance) {
  AnalyticRelief made = AnalyticRelief::Make(ProjectionType::kGnomonic, {});
  made.width = made.height = 512;
  made.backdrop.radius = 0.0525;
  made.backdrop.projection.centre_px = {255.5, 255.5};
  made.relief = [=, backdrop = made.backdrop](glm::dvec2 p) {
    return backdrop.radius - distance(DirectionFromPixel(backdrop.projection, p));
  };
  return made;
}

}  // namespace

AnalyticRelief AnalyticRelief::Make(ProjectionType type, std::function<double(glm::dvec2)> relief) {
  AnalyticRelief made;
  made.backdrop.radius = 0.05;
  made.backdrop.projection.type = type;
  made.backdrop.projection.centre_px = {511.5, 511.5};
  made.backdrop.projection.focal_px = 1000.0;
  made.backdrop.projection.px_per_deg = 1000.0 * kRadianPerDegree;
  made.relief = std::move(relief);
  return made;
}

AnalyticRelief AnalyticRelief::Waves(ProjectionType type) {
  return Make(type, [](glm::dvec2 p) {
    return 0.0035 + 0.0022 * std::sin(0.0125 * p.x + 0.3) * std::cos(0.011 * p.y) +
           0.0011 * std::sin(0.008 * p.x + 0.02 * p.y);
  });
}

// n·x = c
AnalyticRelief AnalyticRelief::Plane() {
  const glm::dvec3 n = glm::normalize(glm::dvec3(0.15, -0.1, 1.0));
  return Small([n](const glm::dvec3& ray) { return 0.045 / glm::dot(n, ray); });
}

AnalyticRelief AnalyticRelief::Ball() {
  return Small([](const glm::dvec3& ray) {
    constexpr double kRadius = 0.040, kDistance = 0.085;
    const double along = kDistance * ray.z;
    return along - std::sqrt(along * along - kDistance * kDistance + kRadius * kRadius);
  });
}

DepthMap AnalyticRelief::Float() const {
  DepthMap map(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) map.at(x, y) = static_cast<float>(relief({x, y}));
  return map;
}

DepthMap AnalyticRelief::EightBit(double range) const {
  DepthMap map = Float();
  for (float& h : map.relief)
    h = static_cast<float>(std::round(static_cast<double>(h) / range * 255.0) / 255.0 * range);
  return map;
}

SurfaceMesh AnalyticRelief::Mesh(glm::dvec2 low, glm::dvec2 high, int cells, double raise) const {
  SurfaceMesh mesh;
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) {
      const glm::dvec3 x = Surface(low + (high - low) * glm::dvec2(i, j) / double(cells));
      mesh.vertices.push_back(x - raise * glm::normalize(x));
    }
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const int a = j * (cells + 1) + i, b = a + 1, c = a + cells + 1, d = c + 1;
      mesh.triangles.push_back({a, c, b});
      mesh.triangles.push_back({b, c, d});
    }
  return mesh;
}

glm::dvec3 AnalyticRelief::Surface(glm::dvec2 p) const {
  return (backdrop.radius - relief(p)) * DirectionFromPixel(backdrop.projection, p);
}

glm::dvec3 AnalyticRelief::Normal(glm::dvec2 p) const {
  constexpr double kStep = 0.01;
  const glm::dvec3 du = Surface(p + glm::dvec2(kStep, 0)) - Surface(p - glm::dvec2(kStep, 0));
  const glm::dvec3 dv = Surface(p + glm::dvec2(0, kStep)) - Surface(p - glm::dvec2(0, kStep));
  const glm::dvec3 n = glm::normalize(glm::cross(du, dv));
  return glm::dot(n, Surface(p)) < 0 ? n : -n;
}

glm::dvec2 AnalyticRelief::Nearest(const glm::dvec3& x, glm::dvec2 start) const {
  glm::dvec2 p = start;
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
    glm::dvec2 step = glm::dvec2(c * gradient.x - b * gradient.y, a * gradient.y - b * gradient.x) *
                      (kStep / det);
    const double length = glm::length(step);
    if (length > 2.0) step *= 2.0 / length;
    p -= step;
    if (length < 1e-6) break;
  }
  return p;
}

}  // namespace arthro::test
