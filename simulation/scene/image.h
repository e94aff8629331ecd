// Pictures as plain values. Row-major from the top-left pixel, whose centre is (0, 0); x right, y
// down.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "simulation/scene/relief_origin.h"

namespace arthro {

// 8-bit sRGB, three bytes a pixel in the order R, G, B.
struct ColourImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;

  ColourImage() = default;
  ColourImage(int w, int h)
      : width(w), height(h), rgb(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * 3) {}
  bool empty() const { return width <= 0 || height <= 0; }
  std::uint8_t* at(int x, int y) { return &rgb[(static_cast<std::size_t>(y) * width + x) * 3]; }
  const std::uint8_t* at(int x, int y) const {
    return &rgb[(static_cast<std::size_t>(y) * width + x) * 3];
  }
};

// The relief h of the backdrop [method.md, Backdrop], in metres: 0 on the sphere, larger is nearer
// the portal, NaN where nothing was imaged.
struct DepthMap {
  int width = 0, height = 0;
  std::vector<float> relief;

  DepthMap() = default;
  DepthMap(int w, int h, float fill = 0.0f)
      : width(w),
        height(h),
        relief(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), fill) {}
  bool empty() const { return width <= 0 || height <= 0; }
  float& at(int x, int y) { return relief[static_cast<std::size_t>(y) * width + x]; }
  float at(int x, int y) const { return relief[static_cast<std::size_t>(y) * width + x]; }
};

// Origin of each value of a depth map.
struct OriginMap {
  int width = 0, height = 0;
  std::vector<ReliefOrigin> origin;

  OriginMap() = default;
  OriginMap(int w, int h, ReliefOrigin fill = ReliefOrigin::kNone)
      : width(w),
        height(h),
        origin(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), fill) {}
  bool empty() const { return width <= 0 || height <= 0; }
  ReliefOrigin& at(int x, int y) { return origin[static_cast<std::size_t>(y) * width + x]; }
  ReliefOrigin at(int x, int y) const { return origin[static_cast<std::size_t>(y) * width + x]; }
};

}  // namespace arthro
