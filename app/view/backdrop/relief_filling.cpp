#include "app/view/backdrop/relief_filling.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace arthro::app {
namespace {

// Largest channel of a pixel that was not imaged: black, up to the errors of JPEG.
constexpr std::uint8_t kUnimaged = 16;

bool IsFilled(const ColourImage& panorama, const DepthMap& depth, std::size_t pixel) {
  const std::uint8_t* rgb = &panorama.rgb[3 * pixel];
  return std::isnan(depth.relief[pixel]) && rgb[0] <= kUnimaged && rgb[1] <= kUnimaged &&
         rgb[2] <= kUnimaged;
}

bool IsOf(const DepthMap& depth, const ColourImage& panorama) {
  return !depth.empty() && depth.width == panorama.width && depth.height == panorama.height;
}

// Means of the known values of 2 x 2 texels; NaN where there is none.
DepthMap Halved(const DepthMap& relief) {
  DepthMap half((relief.width + 1) / 2, (relief.height + 1) / 2);
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x) {
      float sum = 0;
      int known = 0;
      for (int v = 2 * y; v < std::min(2 * y + 2, relief.height); ++v)
        for (int u = 2 * x; u < std::min(2 * x + 2, relief.width); ++u)
          if (std::isfinite(relief.at(u, v))) sum += relief.at(u, v), ++known;
      half.at(x, y) =
          known > 0 ? sum / static_cast<float>(known) : std::numeric_limits<float>::quiet_NaN();
    }
  return half;
}

// Value of the coarser map at the middle of a finer texel.
float Between(const DepthMap& coarse, int x, int y) {
  const float u = std::clamp(0.5f * static_cast<float>(x) - 0.25f, 0.0f,
                             static_cast<float>(coarse.width - 1)),
              v = std::clamp(0.5f * static_cast<float>(y) - 0.25f, 0.0f,
                             static_cast<float>(coarse.height - 1));
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const int right = std::min(i + 1, coarse.width - 1), below = std::min(j + 1, coarse.height - 1);
  const float f = u - static_cast<float>(i), g = v - static_cast<float>(j);
  return (1 - g) * ((1 - f) * coarse.at(i, j) + f * coarse.at(right, j)) +
         g * ((1 - f) * coarse.at(i, below) + f * coarse.at(right, below));
}

}  // namespace

void FillUnknown(DepthMap& relief) {
  if (std::all_of(relief.relief.begin(), relief.relief.end(),
                  [](float h) { return std::isfinite(h); }))
    return;
  if (relief.width <= 1 && relief.height <= 1) {
    std::fill(relief.relief.begin(), relief.relief.end(), 0.0f);
    return;
  }
  DepthMap coarse = Halved(relief);
  FillUnknown(coarse);
  for (int y = 0; y < relief.height; ++y)
    for (int x = 0; x < relief.width; ++x)
      if (!std::isfinite(relief.at(x, y))) relief.at(x, y) = Between(coarse, x, y);
}

void FillUnimaged(ColourImage& panorama, const DepthMap& depth) {
  if (!IsOf(depth, panorama)) return;
  std::vector<std::uint8_t> is_filled(depth.relief.size());
  for (std::size_t i = 0; i < is_filled.size(); ++i)
    is_filled[i] = IsFilled(panorama, depth, i) ? 1 : 0;
  if (std::find(is_filled.begin(), is_filled.end(), 1) == is_filled.end()) return;
  // One channel after the other, from half the size on: a third of the memory.
  for (std::size_t c = 0; c < 3; ++c) {
    DepthMap half((panorama.width + 1) / 2, (panorama.height + 1) / 2);
    const auto pixel = [&](int x, int y) {
      return static_cast<std::size_t>(y) * static_cast<std::size_t>(panorama.width) +
             static_cast<std::size_t>(x);
    };
    for (int y = 0; y < half.height; ++y)
      for (int x = 0; x < half.width; ++x) {
        int sum = 0, known = 0;
        for (int v = 2 * y; v < std::min(2 * y + 2, panorama.height); ++v)
          for (int u = 2 * x; u < std::min(2 * x + 2, panorama.width); ++u)
            if (is_filled[pixel(u, v)] == 0) sum += panorama.rgb[3 * pixel(u, v) + c], ++known;
        half.at(x, y) = known > 0 ? static_cast<float>(sum) / static_cast<float>(known)
                                  : std::numeric_limits<float>::quiet_NaN();
      }
    FillUnknown(half);
    for (int y = 0; y < panorama.height; ++y)
      for (int x = 0; x < panorama.width; ++x)
        if (is_filled[pixel(x, y)] != 0)
          panorama.rgb[3 * pixel(x, y) + c] =
              static_cast<std::uint8_t>(std::lround(Between(half, x, y)));
  }
}

bool FillsOthers(const ColourImage& panorama, const DepthMap& before, const DepthMap& after) {
  const bool was_of = IsOf(before, panorama), is_of = IsOf(after, panorama);
  if (!was_of && !is_of) return false;
  for (std::size_t i = 0; i < panorama.rgb.size() / 3; ++i)
    if ((was_of && IsFilled(panorama, before, i)) != (is_of && IsFilled(panorama, after, i)))
      return true;
  return false;
}

}  // namespace arthro::app
