#include "authoring/depth/highlight_fill.h"

#include <algorithm>
#include <cmath>

namespace arthro::authoring {
namespace {

// A plane at half the size of the one below; weight 0 where nothing is known yet.
struct Level {
  int width = 0, height = 0;
  std::vector<float> grey, weight;

  Level(int w, int h)
      : width(w),
        height(h),
        grey(static_cast<std::size_t>(w) * h, 0.0f),
        weight(static_cast<std::size_t>(w) * h, 0.0f) {}
  std::size_t Index(int x, int y) const { return static_cast<std::size_t>(y) * width + x; }
};

// Each pixel is the mean of the known ones among its four; `known(x, y, grey)` reads the finer
// plane.
template <class Known>
Level Halve(int width, int height, const Known& known) {
  Level half((width + 1) / 2, (height + 1) / 2);
  ForStripsOfRows(half.height, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < half.width; ++x) {
        float sum = 0.0f, weight = 0.0f;
        for (int v = 2 * y; v < std::min(height, 2 * y + 2); ++v)
          for (int u = 2 * x; u < std::min(width, 2 * x + 2); ++u) {
            float grey = 0.0f;
            if (!known(u, v, grey)) continue;
            sum += grey;
            weight += 1.0f;
          }
        if (weight == 0.0f) continue;
        half.grey[half.Index(x, y)] = sum / weight;
        half.weight[half.Index(x, y)] = 1.0f;
      }
  });
  return half;
}

// The value of a level between its pixels, for pixel (x, y) of the plane below, over its known
// pixels.
bool Between(const Level& level, int x, int y, float& grey) {
  const float u = (static_cast<float>(x) - 0.5f) / 2.0f, v = (static_cast<float>(y) - 0.5f) / 2.0f;
  const int left = static_cast<int>(std::floor(u)), top = static_cast<int>(std::floor(v));
  float sum = 0.0f, weight = 0.0f;
  for (int j = top; j <= top + 1; ++j)
    for (int i = left; i <= left + 1; ++i) {
      if (i < 0 || j < 0 || i >= level.width || j >= level.height) continue;
      const float share = (1.0f - std::abs(u - static_cast<float>(i))) *
                          (1.0f - std::abs(v - static_cast<float>(j))) *
                          level.weight[level.Index(i, j)];
      sum += share * level.grey[level.Index(i, j)];
      weight += share;
    }
  if (weight <= 0.0f) return false;
  grey = sum / weight;
  return true;
}

}  // namespace

void FillHighlights(GreyPlane& plane, const std::vector<std::uint8_t>& highlight) {
  // Push: halve until one pixel is left.
  std::vector<Level> levels;
  levels.push_back(Halve(plane.width, plane.height, [&](int x, int y, float& grey) {
    const std::size_t i = plane.Index(x, y);
    grey = plane.grey[i];
    return plane.imaged[i] && !highlight[i];
  }));
  while (levels.back().width > 1 || levels.back().height > 1) {
    const Level& fine = levels.back();
    levels.push_back(Halve(fine.width, fine.height, [&](int x, int y, float& grey) {
      grey = fine.grey[fine.Index(x, y)];
      return fine.weight[fine.Index(x, y)] > 0.0f;
    }));
  }
  // Pull: what a level does not know it takes from the next coarser one.
  for (std::size_t i = levels.size() - 1; i-- > 0;) {
    Level& fine = levels[i];
    ForStripsOfRows(fine.height, [&](int first, int last) {
      for (int y = first; y < last; ++y)
        for (int x = 0; x < fine.width; ++x) {
          const std::size_t at = fine.Index(x, y);
          if (fine.weight[at] == 0.0f && Between(levels[i + 1], x, y, fine.grey[at]))
            fine.weight[at] = 1.0f;
        }
    });
  }
  ForStripsOfRows(plane.height, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < plane.width; ++x) {
        const std::size_t i = plane.Index(x, y);
        float grey = 0.0f;
        if (plane.imaged[i] && highlight[i] && Between(levels[0], x, y, grey))
          plane.grey[i] = static_cast<std::uint16_t>(std::lround(grey));
      }
  });
}

}  // namespace arthro::authoring
