#include "authoring/panorama/preparation/frame_masks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace arthro::authoring {
namespace {

constexpr double kGlintRatio = 1.13;  // ratio to the local whiteness
constexpr double kGlintStep = 16;     // grey levels above it, so that noise is no highlight
constexpr double kHeadroom =
    0.35;  // share of the range left up to white: near it highlights are compressed
constexpr double kSaturated = 250;  // grey levels of the weakest channel
constexpr int kGlintReach = 7;      // px of the half grid: a larger highlight is saturated
constexpr int kGlow = 2;            // px by which highlights are grown

cv::Mat Disc(int radius) {
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1});
}

// Weakest channel of each pixel.
cv::Mat WhitenessOf(const cv::Mat& rgb) {
  cv::Mat white(rgb.size(), CV_8U);
  for (int y = 0; y < rgb.rows; ++y) {
    const std::uint8_t* in = rgb.ptr<std::uint8_t>(y);
    std::uint8_t* out = white.ptr<std::uint8_t>(y);
    for (int x = 0; x < rgb.cols; ++x, in += 3) out[x] = std::min(in[0], std::min(in[1], in[2]));
  }
  return white;
}

// An odd side would not halve to whole pixels, and resizing would cost several times as much.
cv::Mat EvenSided(const cv::Mat& picture) {
  if (picture.cols % 2 == 0 && picture.rows % 2 == 0) return picture;
  cv::Mat even;
  cv::copyMakeBorder(picture, even, 0, picture.rows % 2, 0, picture.cols % 2, cv::BORDER_REPLICATE);
  return even;
}

}  // namespace

cv::Mat HighlightMask(const cv::Mat& rgb, const cv::Mat& mask) {
  const cv::Mat white = WhitenessOf(rgb);
  // Background under small white objects: an opening on a half grid, so that the edge of large pale
  // tissue is background. The rim's black does not count.
  cv::Mat small, small_mask, low;
  const cv::Size half((rgb.cols + 1) / 2, (rgb.rows + 1) / 2);
  cv::resize(EvenSided(white), small, half, 0, 0, cv::INTER_AREA);
  cv::resize(EvenSided(mask), small_mask, half, 0, 0, cv::INTER_AREA);
  small_mask = small_mask == 255;  // a cell that is half rim is darker than its tissue
  const cv::Mat square = cv::getStructuringElement(cv::MORPH_RECT, {kGlintReach, kGlintReach});
  small.setTo(255, small_mask == 0);
  cv::erode(small, low, square);
  low.setTo(0, small_mask == 0);
  cv::dilate(low, low, square);  // beyond the rim too
  cv::Mat ground;
  cv::resize(low, ground, half * 2, 0, 0, cv::INTER_LINEAR);

  std::array<double, 256> least{};  // least whiteness of a highlight, by background
  for (int g = 0; g < 256; ++g)
    least[g] =
        std::min(kSaturated, g + std::max(kGlintStep, std::min((kGlintRatio - 1) * g + kGlintStep,
                                                               kHeadroom * (255 - g))));
  cv::Mat glint = cv::Mat::zeros(rgb.size(), CV_8U);
  for (int y = 0; y < rgb.rows; ++y) {
    const std::uint8_t *w = white.ptr<std::uint8_t>(y), *g = ground.ptr<std::uint8_t>(y),
                       *m = mask.ptr<std::uint8_t>(y);
    std::uint8_t* out = glint.ptr<std::uint8_t>(y);
    for (int x = 0; x < rgb.cols; ++x) out[x] = m[x] && w[x] >= least[g[x]] ? 255 : 0;
  }
  cv::dilate(glint, glint, Disc(kGlow));
  cv::bitwise_and(glint, mask, glint);
  return glint;
}

cv::Mat ToolMask(const cv::Mat& rgb, const cv::Mat& mask) {
  constexpr double kColourless = 0.04;  // chroma over brightness of metal in white light
  constexpr double kSmallest = 0.01;    // share of the window
  constexpr double kLongest = 2.0;      // ratio of length to width of a shaft, at least
  constexpr double kFilled = 0.72;      // share of its bounding rectangle: straight sides
  cv::Mat none = cv::Mat::zeros(rgb.size(), CV_8U);
  cv::Mat small, window;
  // Whole blocks of 4 x 4 px; the last block on either axis includes the remainder.
  const cv::Size quarter(rgb.cols / 4, rgb.rows / 4);
  if (quarter.empty()) return none;
  const cv::Rect blocks(0, 0, 4 * quarter.width, 4 * quarter.height);
  cv::resize(rgb(blocks), small, quarter, 0, 0, cv::INTER_AREA);
  cv::resize(mask(blocks), window, quarter, 0, 0, cv::INTER_AREA);
  window = window == 255;
  const int area = cv::countNonZero(window);
  if (area == 0) return none;

  cv::Mat metal = cv::Mat::zeros(small.size(), CV_8U);
  for (int y = 0; y < small.rows; ++y)
    for (int x = 0; x < small.cols; ++x) {
      if (!window.at<std::uint8_t>(y, x)) continue;
      const cv::Vec3b& p = small.at<cv::Vec3b>(y, x);
      const int most = std::max(p[0], std::max(p[1], p[2]));
      const int least = std::min(p[0], std::min(p[1], p[2]));
      if (most - least <= kColourless * most + 1) metal.at<std::uint8_t>(y, x) = 255;
    }
  cv::morphologyEx(metal, metal, cv::MORPH_CLOSE, Disc(2));
  cv::morphologyEx(metal, metal, cv::MORPH_OPEN, Disc(2));

  cv::Mat inner, labels, stats, centroids, tool = cv::Mat::zeros(small.size(), CV_8U);
  cv::erode(window, inner, Disc(3), {-1, -1}, 1, cv::BORDER_CONSTANT, 0);
  const int count = cv::connectedComponentsWithStats(metal, labels, stats, centroids);
  for (int label = 1; label < count; ++label) {
    if (stats.at<int>(label, cv::CC_STAT_AREA) < kSmallest * area) continue;
    std::vector<cv::Point> points;
    bool at_rim = false;
    for (int y = 0; y < labels.rows; ++y)
      for (int x = 0; x < labels.cols; ++x)
        if (labels.at<int>(y, x) == label) {
          points.emplace_back(x, y);
          at_rim |= inner.at<std::uint8_t>(y, x) == 0;
        }
    const cv::RotatedRect box = cv::minAreaRect(points);
    const double length = std::max(box.size.width, box.size.height) + 1;
    const double width = std::min(box.size.width, box.size.height) + 1;
    if (!at_rim || length < kLongest * width ||
        static_cast<double>(points.size()) < kFilled * length * width)
      continue;
    for (const cv::Point& p : points) tool.at<std::uint8_t>(p) = 255;
  }
  if (cv::countNonZero(tool) == 0) return none;
  cv::dilate(tool, tool, Disc(2));  // its blurred and shaded sides
  cv::resize(tool, tool, blocks.size(), 0, 0, cv::INTER_NEAREST);
  cv::copyMakeBorder(tool, none, 0, rgb.rows - blocks.height, 0, rgb.cols - blocks.width,
                     cv::BORDER_REPLICATE);
  cv::bitwise_and(none, mask, none);
  return none;
}

}  // namespace arthro::authoring
