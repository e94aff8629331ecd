#include "tests/support/depth_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "authoring/phantom/clip/plane_noise.h"

namespace arthro::test {

DepthScene MakeDepthScene(const DepthSceneOptions& options) {
  using authoring::NormalOf;
  using authoring::PlaneNoise;
  const int n = options.size;
  Random random(static_cast<std::uint64_t>(options.seed) * 6007 + 77);
  DepthScene scene;
  scene.picture = ColourImage(n, n);
  scene.centre = (n - 1) / 2.0;
  const double radius = n / 2.0 - 2, cell = n / 240.0;
  scene.focal = radius;  // tan 45° = 1

  // Distances along each ray.
  const auto any = [&](double reach) { return random.Uniform(-reach, reach); };
  const double hollow_x = any(0.3), hollow_y = any(0.3), bump_x = any(0.6), bump_y = any(0.6),
               lean = random.Uniform(0, 6), fold = random.Uniform(0, 6);
  const cv::Size size(n, n);
  const cv::Mat rough = PlaneNoise(size, {70 * cell, 3}, random),
                kind = PlaneNoise(size, {90 * cell, 2}, random),
                texture = PlaneNoise(size, {20 * cell, 4}, random);
  const auto square = [](double v) { return v * v; };
  std::vector<double> range(static_cast<std::size_t>(n) * n);
  const auto at = [&](int x, int y) -> double& {
    return range[static_cast<std::size_t>(y) * n + x];
  };
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const double u = (x - scene.centre) / radius, v = (y - scene.centre) / radius;
      double d = 1 + 0.35 * std::exp(-(square(u - hollow_x) + square(v - hollow_y)) / 0.08) -
                 0.45 * std::exp(-(square(u - bump_x) / 0.06 + square(v - bump_y) / 0.20));
      d +=
          0.25 * (u * u + v * v) * std::cos(std::atan2(v, u) + lean) + 0.12 * rough.at<float>(y, x);
      const double across = u * std::cos(fold) + v * std::sin(fold);
      at(x, y) = std::max(0.2, d + 0.5 / (1 + std::exp(-(across - 0.25) / 0.012)));  // a step
    }

  // Light.
  scene.distance.assign(range.size(), std::numeric_limits<double>::quiet_NaN());
  const double half = std::atan(1.0);
  for (int y = 1; y + 1 < n; ++y)
    for (int x = 1; x + 1 < n; ++x) {
      if (std::hypot(x - scene.centre, y - scene.centre) >= radius) continue;
      const auto point = [&](int u, int v) { return at(u, v) * scene.RayOf(u, v); };
      const glm::dvec3 normal = glm::normalize(
          glm::cross(point(x + 1, y) - point(x - 1, y), point(x, y + 1) - point(x, y - 1)));
      const glm::dvec3 ray = scene.RayOf(x, y);
      const double cosine = std::abs(glm::dot(normal, ray)), fall = square(at(x, y));
      const double red_share = options.tissue / (1 + std::exp(-kind.at<float>(y, x) / 0.05));
      const double grain = 1 + 0.06 * options.tissue * texture.at<float>(y, x);
      const double pale[] = {0.86, 0.80, 0.75}, red[] = {0.72, 0.36, 0.31};
      const double rim = std::acos(std::min(1.0, ray.z)) / half;
      scene.distance[static_cast<std::size_t>(y) * n + x] = at(x, y);
      std::uint64_t bits = random.Next();
      for (int c = 0; c < 3; ++c, bits >>= 12) {
        const double albedo = (pale[c] * (1 - red_share) + red[c] * red_share) * grain;
        double light = (albedo * cosine + options.highlights * std::pow(cosine, 400)) / fall;
        light *= 0.45 * (1 - options.vignette * rim * rim);
        light += options.noise * NormalOf(bits);
        scene.picture.at(x, y)[c] = static_cast<std::uint8_t>(
            255 * std::pow(std::clamp(light, 0.0, 1.0), 1 / options.gamma) + 0.5);
      }
    }
  return scene;
}

}  // namespace arthro::test
