#include "authoring/depth/highlights.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "authoring/depth/imaged_area.h"

namespace arthro::authoring {
namespace {

// Radius of the largest highlight, as a share of the picture's shorter side.
constexpr double kGlintRadius = 0.0125;
// Least contrast of a highlight with the brightest background around it: a sixth of the range.
constexpr int kGlintContrast = kWhite / 6;
// Radius of the glow around a highlight, as a share of the picture's shorter side.
constexpr double kGlow = 0.003;

// px, side of the blocks in which the background is estimated; finer is slower without gain.
constexpr int kBlock = 4;

// Mean grey of the imaged pixels of each block; white without any, which erosion ignores.
cv::Mat BlockMeans(const GreyPlane& plane) {
  cv::Mat means((plane.height + kBlock - 1) / kBlock, (plane.width + kBlock - 1) / kBlock, CV_16U);
  ForStripsOfRows(means.rows, [&](int first, int last) {
    for (int by = first; by < last; ++by)
      for (int bx = 0; bx < means.cols; ++bx) {
        std::uint32_t sum = 0, count = 0;
        for (int y = by * kBlock; y < std::min(plane.height, (by + 1) * kBlock); ++y)
          for (int x = bx * kBlock; x < std::min(plane.width, (bx + 1) * kBlock); ++x) {
            const std::size_t i = plane.Index(x, y);
            sum += plane.imaged[i] ? plane.grey[i] : 0;
            count += plane.imaged[i];
          }
        means.at<std::uint16_t>(by, bx) =
            count > 0 ? static_cast<std::uint16_t>(sum / count) : kWhite;
      }
  });
  return means;
}

// Background without small bright areas: a morphological opening of the block means. The dilation
// is one block wider than the erosion, so that the edge of large bright tissue is background.
cv::Mat GroundOf(const GreyPlane& plane) {
  const int radius =
      static_cast<int>(std::ceil(kGlintRadius * std::min(plane.width, plane.height) / kBlock));
  const auto square = [](int r) {
    return cv::getStructuringElement(cv::MORPH_RECT, {2 * r + 1, 2 * r + 1});
  };
  cv::Mat ground;
  cv::erode(BlockMeans(plane), ground, square(radius));
  cv::dilate(ground, ground, square(radius + 1));
  return ground;
}

// Plane at half the size of the one below; weight 0 where the value is unknown.
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

// Sets each pixel to the mean of the known ones among its four; `known(x, y, grey)` reads the finer
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

// Interpolates a level at pixel (x, y) of the plane below, over the known pixels.
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

std::vector<std::uint8_t> FindHighlights(const GreyPlane& plane,
                                         const std::vector<std::uint8_t>& flags) {
  const cv::Mat ground = GroundOf(plane);
  std::vector<std::uint8_t> marks(flags.size());
  ForStripsOfRows(plane.height, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      const std::uint16_t* under = ground.ptr<std::uint16_t>(y / kBlock);
      for (int x = 0; x < plane.width; ++x) {
        const std::size_t i = plane.Index(x, y);
        const bool stands_out =
            (flags[i] & kPale) && plane.grey[i] > under[x / kBlock] + kGlintContrast;
        marks[i] = plane.imaged[i] && (stands_out || (flags[i] & kSaturated)) ? kSaturated : 0;
      }
    }
  });
  const int glow =
      std::max(1, static_cast<int>(std::lround(kGlow * std::min(plane.width, plane.height))));
  std::vector<std::uint8_t> highlight =
      Grow(RunsOf(marks, plane.width, plane.height, kSaturated), plane.width, plane.height, glow);
  for (std::size_t i = 0; i < highlight.size(); ++i) highlight[i] &= plane.imaged[i];
  return highlight;
}

void FillHighlights(GreyPlane& plane, const std::vector<std::uint8_t>& highlight) {
  // Push: halves the plane until one pixel is left.
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
  // Pull: fills unknown pixels of a level from the next coarser one.
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
