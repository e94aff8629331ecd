// Rectified frames of a cavity whose distance is known at every pixel: a wall with a bump, a
// hollow, a fold and roughness under a light at the scope, brightness = albedo × cosine /
// distance², glints, vignette, noise, gamma.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "simulation/scene/image.h"

namespace arthro::test {

struct DepthSceneOptions {
  int seed = 1;
  int size = 240;       // px per side
  double tissue = 1;    // 0: all pale; 1: pale and red, with texture
  double noise = 0.01;  // relative to white, before encoding
  double highlights = 0.6;
  double gamma = 1.6;
  double vignette = 0.3;
};

struct DepthScene {
  ColourImage picture;           // black outside the round window
  std::vector<double> distance;  // nominal 1; NaN outside the window
  double focal = 1, centre = 0;  // px; the window is 90° wide

  glm::dvec3 RayOf(int x, int y) const {
    return glm::normalize(glm::dvec3((x - centre) / focal, (y - centre) / focal, 1));
  }
  // Index of the pixel that shows a point in front of the scope; row-major.
  std::optional<std::size_t> PixelOf(const glm::dvec3& x) const {
    if (!(x.z > 1e-6)) return std::nullopt;
    const double u = centre + focal * x.x / x.z + 0.5, v = centre + focal * x.y / x.z + 0.5;
    if (u < 0 || v < 0 || u >= picture.width || v >= picture.height) return std::nullopt;
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(picture.width) +
           static_cast<std::size_t>(u);
  }
};

DepthScene MakeDepthScene(const DepthSceneOptions& options);

}  // namespace arthro::test
