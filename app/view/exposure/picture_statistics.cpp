#include "app/view/exposure/picture_statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace arthro::app {
namespace {

constexpr int kClipped = 250, kBlack = 5;
constexpr int kUnit = 1000;  // thousandths per grey level

// Luma in thousandths of a grey level: whole numbers, so that the limit of a flat pixel is exact.
int Grey(const std::uint8_t* rgb) { return 299 * rgb[0] + 587 * rgb[1] + 114 * rgb[2]; }

// Returns the lowest grey level of the histogram that at least `share` of all pixels do not exceed.
double Percentile(const std::array<int, 256>& histogram, int all, double share) {
  const double wanted = std::max(1.0, std::ceil(share * all));
  int below = 0;
  for (int level = 0; level < 256; ++level) {
    below += histogram[static_cast<std::size_t>(level)];
    if (below >= wanted) return level;
  }
  return 255;
}

}  // namespace

PictureMask DiscMask(int width, int height, double centre_x, double centre_y, double radius) {
  PictureMask mask{width, height, {}};
  mask.counts.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      mask.counts.push_back(std::hypot(x - centre_x, y - centre_y) < radius);
  return mask;
}

PictureStatistics MeasurePicture(const ColourImage& picture, const PictureMask& mask) {
  PictureStatistics of;
  std::array<int, 256> histogram{};
  int all = 0, clipped = 0, black = 0, pairs = 0, flat = 0;
  double gradients = 0, cb_sum = 0, cr_sum = 0, squares = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      if (!mask.at(x, y)) continue;
      const std::uint8_t* rgb = picture.at(x, y);
      const int grey = Grey(rgb);
      ++all;
      ++histogram[static_cast<std::size_t>((grey + kUnit / 2) / kUnit)];
      clipped += std::max({rgb[0], rgb[1], rgb[2]}) >= kClipped ? 1 : 0;
      black += grey <= kBlack * kUnit ? 1 : 0;
      const double cb = 0.564 * (rgb[2] - grey / double(kUnit)),
                   cr = 0.713 * (rgb[0] - grey / double(kUnit));
      cb_sum += cb, cr_sum += cr, squares += cb * cb + cr * cr;
      // Forward differences, where both neighbours count.
      if (x + 1 >= picture.width || y + 1 >= picture.height || !mask.at(x + 1, y) ||
          !mask.at(x, y + 1))
        continue;
      const int both =
          std::abs(Grey(picture.at(x + 1, y)) - grey) + std::abs(Grey(picture.at(x, y + 1)) - grey);
      ++pairs;
      gradients += 0.5 * both / kUnit;
      flat += both <= kUnit ? 1 : 0;
    }
  if (all == 0 || pairs == 0) return of;
  of.p1 = Percentile(histogram, all, 0.01);
  of.p50 = Percentile(histogram, all, 0.5);
  of.p99 = Percentile(histogram, all, 0.99);
  of.clipped = double(clipped) / all;
  of.black = double(black) / all;
  of.gradient = gradients / pairs;
  of.flat = double(flat) / pairs;
  const double cb = cb_sum / all, cr = cr_sum / all;
  of.chroma = std::sqrt(std::max(squares / all - cb * cb - cr * cr, 0.0));
  of.pictures = 1;
  return of;
}

PictureStatistics MeanOf(std::span<const PictureStatistics> pictures) {
  PictureStatistics mean;
  for (const PictureStatistics& one : pictures) mean.pictures += one.pictures > 0 ? 1 : 0;
  if (mean.pictures == 0) return mean;
  for (double PictureStatistics::*value :
       {&PictureStatistics::p1, &PictureStatistics::p50, &PictureStatistics::p99,
        &PictureStatistics::clipped, &PictureStatistics::black, &PictureStatistics::gradient,
        &PictureStatistics::flat, &PictureStatistics::chroma}) {
    for (const PictureStatistics& one : pictures)
      if (one.pictures > 0) mean.*value += one.*value;
    mean.*value /= mean.pictures;
  }
  return mean;
}

}  // namespace arthro::app
