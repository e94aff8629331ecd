#include "app/view/exposure/footage_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include "app/view/drawing/srgb.h"

namespace arthro::app {
namespace {

constexpr int kBlocks = 96;         // blocks along the longer side
constexpr double kWidth = 1.0 / 6;  // sigma of the low-pass filter, over the longer side
constexpr double kMostLight = 3;

// Gaussian means of one line, each value with its weight.
void Smooth(std::vector<double>& values, std::vector<double>& weights, std::size_t first,
            std::size_t stride, int count, double sigma) {
  const int reach = static_cast<int>(2.5 * sigma);
  std::vector<double> value(static_cast<std::size_t>(count)), weight(value.size());
  for (int i = 0; i < count; ++i) {
    double sum = 0, total = 0;
    for (int k = std::max(0, i - reach); k <= std::min(count - 1, i + reach); ++k) {
      const std::size_t at = first + static_cast<std::size_t>(k) * stride;
      const double w = std::exp(-0.5 * (k - i) * (k - i) / (sigma * sigma));
      sum += w * values[at];  // already weighted
      total += w * weights[at];
    }
    value[static_cast<std::size_t>(i)] = sum;
    weight[static_cast<std::size_t>(i)] = total;
  }
  for (int i = 0; i < count; ++i) {
    const std::size_t at = first + static_cast<std::size_t>(i) * stride;
    values[at] = value[static_cast<std::size_t>(i)];
    weights[at] = weight[static_cast<std::size_t>(i)];
  }
}

FootageLight LightOfBlocks(const LightGrid& grid, const std::vector<std::size_t>& blocks) {
  FootageLight light;
  std::vector<std::size_t> order = blocks;
  const auto colour = [&](std::size_t i) {
    return glm::dvec3(grid.blocks[i].mean * grid.blocks[i].gain);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const double la = Luma(colour(a)), lb = Luma(colour(b));
    return la != lb ? la > lb : a < b;
  });
  double total = 0, bright = 0, metered = 0;
  glm::dvec3 sum{0.0}, bright_sum{0.0};
  for (const std::size_t i : order) {
    total += grid.blocks[i].share;
    sum += double(grid.blocks[i].share) * colour(i);
    metered += grid.blocks[i].share * Luma(colour(i)) * Luma(colour(i));
  }
  if (!(total > 0)) return light;
  for (const std::size_t i : order) {
    if (bright >= 0.2 * total) break;
    bright += grid.blocks[i].share;
    bright_sum += double(grid.blocks[i].share) * colour(i);
  }
  light.mean = sum / total;
  light.bright = bright_sum / bright;
  light.metered = std::sqrt(metered / total);
  return light;
}

std::vector<std::size_t> AllImaged(const LightGrid& grid) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < grid.blocks.size(); ++i)
    if (grid.blocks[i].share > 0) all.push_back(i);
  return all;
}

// Returns the place of a panorama pixel, in blocks.
glm::dvec2 InBlocks(const LightGrid& grid, const glm::dvec2& pixel) {
  return (pixel + 0.5) / grid.block_px - 0.5;
}

// Calls take(block, weight) for the four blocks around a panorama pixel.
template <class Take>
void BetweenBlocks(const LightGrid& grid, const glm::dvec2& pixel, Take&& take) {
  const glm::dvec2 place = glm::clamp(InBlocks(grid, pixel), glm::dvec2(0.0),
                                      glm::dvec2(grid.width - 1, grid.height - 1));
  const int x = static_cast<int>(place.x), y = static_cast<int>(place.y);
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i)
      take(grid.at(std::min(x + i, grid.width - 1), std::min(y + j, grid.height - 1)),
           std::abs(1 - i - (place.x - x)) * std::abs(1 - j - (place.y - y)));
}

}  // namespace

Backdrop WithKnownLight(Backdrop backdrop, const DepthMap& depth) {
  if (depth.empty()) backdrop.relight = 0;
  return backdrop;
}

LightGrid MakeLightGrid(const ColourImage& panorama, const DepthMap& depth) {
  LightGrid grid;
  if (panorama.empty()) return grid;
  const int block =
      std::max(1, (std::max(panorama.width, panorama.height) + kBlocks - 1) / kBlocks);
  grid.width = (panorama.width + block - 1) / block;
  grid.height = (panorama.height + block - 1) / block;
  grid.block_px = glm::dvec2(block);
  grid.blocks.resize(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
  std::array<float, 256> linear;
  for (int i = 0; i < 256; ++i)
    linear[static_cast<std::size_t>(i)] =
        static_cast<float>(LinearFromSrgb(static_cast<std::uint8_t>(i)));
  const int step = std::max(1, block / 8);  // enough for a mean
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x) {
      LightGrid::Block& of =
          grid.blocks[static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) +
                      static_cast<std::size_t>(x)];
      int all = 0, imaged = 0;
      for (int v = y * block; v < std::min((y + 1) * block, panorama.height); v += step)
        for (int u = x * block; u < std::min((x + 1) * block, panorama.width); u += step) {
          ++all;
          const float h = depth.empty() ? 0.0f : depth.at(u, v);
          if (std::isnan(h)) continue;
          ++imaged;
          const std::uint8_t* p = panorama.at(u, v);
          of.mean += glm::vec3(linear[p[0]], linear[p[1]], linear[p[2]]);
        }
      if (imaged == 0) continue;
      of.mean /= static_cast<float>(imaged);
      of.share = static_cast<float>(imaged) / static_cast<float>(all);
    }
  SetRelief(grid, depth);
  return grid;
}

void SetRelief(LightGrid& grid, const DepthMap& depth) {
  const int block = static_cast<int>(grid.block_px.x), step = std::max(1, block / 8);
  grid.has_relief = false;
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x) {
      float sum = 0;
      int count = 0;
      for (int v = y * block; v < std::min((y + 1) * block, depth.height); v += step)
        for (int u = x * block; u < std::min((x + 1) * block, depth.width); u += step)
          if (const float h = depth.at(u, v); std::isfinite(h)) sum += h, ++count;
      const float relief = count > 0 ? sum / static_cast<float>(count) : 0.0f;
      grid.blocks[static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) +
                  static_cast<std::size_t>(x)]
          .relief = relief;
      grid.has_relief = grid.has_relief || relief != 0;
    }
}

double ReliefAt(const LightGrid& grid, const glm::dvec2& pixel) {
  double relief = 0;
  BetweenBlocks(grid, pixel, [&](const LightGrid::Block& block, double weight) {
    relief += weight * block.relief;
  });
  return relief;
}

GridLook Look(const LightGrid& grid, const glm::dvec2& pixel) {
  GridLook seen;
  BetweenBlocks(grid, pixel, [&](const LightGrid::Block& block, double weight) {
    seen.luma += weight * block.share * Luma(glm::dvec3(block.mean * block.gain));
    seen.share += weight * block.share;
  });
  return seen;
}

void EvenLight(LightGrid& grid, double share) {
  grid.even = share;
  if (grid.blocks.empty()) return;
  std::vector<double> values(grid.blocks.size()), weights(grid.blocks.size());
  double sum = 0, total = 0;
  for (std::size_t i = 0; i < grid.blocks.size(); ++i) {
    weights[i] = grid.blocks[i].share;
    values[i] = weights[i] * Luma(grid.blocks[i].mean);
    sum += values[i];
    total += weights[i];
  }
  const double mean = total > 0 ? sum / total : 0.0;
  const double sigma = kWidth * std::max(grid.width, grid.height);
  const auto width = static_cast<std::size_t>(grid.width);
  for (int y = 0; y < grid.height; ++y)
    Smooth(values, weights, static_cast<std::size_t>(y) * width, 1, grid.width, sigma);
  for (int x = 0; x < grid.width; ++x)
    Smooth(values, weights, static_cast<std::size_t>(x), width, grid.height, sigma);
  for (std::size_t i = 0; i < grid.blocks.size(); ++i) {
    const double light = weights[i] > 0 ? values[i] / weights[i] : mean;
    const double gain = light > 0 && mean > 0 ? std::pow(mean / light, share) : 1.0;
    grid.blocks[i].gain = static_cast<float>(std::clamp(gain, 1 / kMostLight, kMostLight));
  }
}

ColourImage Evened(const ColourImage& panorama, const LightGrid& grid) {
  ColourImage even = panorama;
  // Gains of stored bytes for one row of pixels, bilinear between blocks.
  std::vector<float> gains(static_cast<std::size_t>(grid.width));
  for (int y = 0; y < panorama.height; ++y) {
    const double row = std::clamp(InBlocks(grid, {0, y}).y, 0.0, grid.height - 1.0);
    const int above = static_cast<int>(row), below = std::min(above + 1, grid.height - 1);
    for (int i = 0; i < grid.width; ++i)
      gains[static_cast<std::size_t>(i)] = static_cast<float>(std::pow(
          (1 - (row - above)) * grid.at(i, above).gain + (row - above) * grid.at(i, below).gain,
          1 / 2.2));
    for (int x = 0; x < panorama.width; ++x) {
      const double column = std::clamp(InBlocks(grid, {x, 0}).x, 0.0, grid.width - 1.0);
      const auto left = static_cast<std::size_t>(column);
      const std::size_t right = std::min(left + 1, gains.size() - 1);
      const auto f = static_cast<float>(column - static_cast<double>(left));
      const float gain = (1 - f) * gains[left] + f * gains[right];
      std::uint8_t* p = even.at(x, y);
      for (int c = 0; c < 3; ++c)
        p[c] = static_cast<std::uint8_t>(std::min(gain * static_cast<float>(p[c]) + 0.5f, 255.0f));
    }
  }
  return even;
}

FootageLight MeasureLight(const LightGrid& grid) { return LightOfBlocks(grid, AllImaged(grid)); }

FootageLight MeasureLight(const LightGrid& grid, const Projection& projection,
                          const glm::dvec3& direction, double angle) {
  std::vector<std::size_t> near;
  const double least = std::cos(angle);
  for (const std::size_t i : AllImaged(grid)) {
    const int column = static_cast<int>(i) % grid.width, row = static_cast<int>(i) / grid.width;
    const glm::dvec2 block(column, row);
    const glm::dvec3 d = DirectionFromPixel(projection, (block + 0.5) * grid.block_px - 0.5);
    if (glm::dot(d, direction) >= least) near.push_back(i);
  }
  return near.empty() ? MeasureLight(grid) : LightOfBlocks(grid, near);
}

}  // namespace arthro::app
