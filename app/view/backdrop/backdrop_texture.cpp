#include "app/view/backdrop/backdrop_texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>
#include <utility>

#include "app/view/backdrop/relief_filling.h"
#include "app/view/backdrop/relief_outlines.h"
#include "simulation/haptics/relief/plane_filters.h"

namespace arthro::app {
namespace {

// Width of the soft border on its inner side, as a share of the panorama's longer edge.
constexpr double kSoftEnd = 1.0 / 40.0;
// Longer edge of the mask, px: fine enough for a soft border of 13 px.
constexpr int kMaskSide = 512, kLeastMaskSide = 40;

// Values beyond the ends of a line.
enum class Beyond { kPeriodic, kZero, kLast };

// Blurs one line in place by a running sum.
void BlurLine(float* line, int count, int stride, int radius, Beyond beyond,
              std::vector<float>& copy) {
  copy.resize(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    copy[static_cast<std::size_t>(i)] = line[static_cast<std::ptrdiff_t>(i) * stride];
  const auto at = [&](int i) {
    if (beyond == Beyond::kPeriodic)
      return copy[static_cast<std::size_t>((i % count + count) % count)];
    if (beyond == Beyond::kLast) return copy[static_cast<std::size_t>(std::clamp(i, 0, count - 1))];
    return i < 0 || i >= count ? 0.0f : copy[static_cast<std::size_t>(i)];
  };
  double sum = 0;
  for (int i = -radius; i <= radius; ++i) sum += at(i);
  for (int i = 0; i < count; ++i) {
    line[static_cast<std::ptrdiff_t>(i) * stride] = static_cast<float>(sum / (2 * radius + 1));
    sum += at(i + radius + 1) - at(i - radius);
  }
}

// Blurs `channels` interleaved planes in place by two means over 2 radius + 1 values in each
// direction. A whole turn is periodic along its rows.
void BlurTwice(std::vector<float>& planes, int width, int height, int channels, int radius,
               bool whole_turn, Beyond beyond) {
  std::vector<float> copy;
  for (int pass = 0; pass < 2; ++pass)
    for (int c = 0; c < channels; ++c) {
      for (int y = 0; y < height; ++y)
        BlurLine(&planes[static_cast<std::size_t>(y) * static_cast<std::size_t>(width * channels) +
                         static_cast<std::size_t>(c)],
                 width, channels, radius, whole_turn ? Beyond::kPeriodic : beyond, copy);
      for (int x = 0; x < width; ++x)
        BlurLine(&planes[static_cast<std::size_t>(x) * static_cast<std::size_t>(channels) +
                         static_cast<std::size_t>(c)],
                 height, width * channels, radius, beyond, copy);
    }
}

// Radius of BlurTwice that has a standard deviation in all: a mean over 2 r + 1 values has the
// variance ((2 r + 1)² − 1) / 12.
int BlurRadius(double deviation) {
  return static_cast<int>(std::lround(0.5 * (std::sqrt(1 + 6 * deviation * deviation) - 1)));
}

// Weight of the imaged part, as in ReliefTexture. Coarser than the panorama, because it is smooth.
struct ImagedMask {
  int width = 0, height = 0;
  std::vector<float> share;
};
ImagedMask MakeImagedMask(int width, int height, const DepthMap& depth, bool whole_turn) {
  ImagedMask mask;
  // A tiny panorama has a finer mask than pixels, or its soft end would be all of it.
  const double longer = std::max(width, height);
  const double scale = std::max(std::min(1.0, kMaskSide / longer), kLeastMaskSide / longer);
  mask.width = std::max(1, static_cast<int>(std::lround(width * scale)));
  mask.height = std::max(1, static_cast<int>(std::lround(height * scale)));
  std::vector<float> share(
      static_cast<std::size_t>(mask.width) * static_cast<std::size_t>(mask.height), 1.0f);
  if (!depth.empty())
    for (int y = 0; y < mask.height; ++y)
      for (int x = 0; x < mask.width; ++x) {
        const int u = static_cast<int>((x + 0.5) * width / mask.width);
        const int v = static_cast<int>((y + 0.5) * height / mask.height);
        if (std::isnan(depth.at(u, v)))
          share[static_cast<std::size_t>(y) * static_cast<std::size_t>(mask.width) +
                static_cast<std::size_t>(x)] = 0.0f;
      }
  const auto radius = [&](double width_share) {
    return std::max(1, static_cast<int>(std::max(mask.width, mask.height) * width_share / 2));
  };
  std::vector<float> wide = share;
  BlurTwice(share, mask.width, mask.height, 1, radius(kSoftEnd), whole_turn, Beyond::kLast);
  BlurTwice(wide, mask.width, mask.height, 1, radius(kEndShare), whole_turn, Beyond::kLast);
  for (std::size_t i = 0; i < share.size(); ++i)
    share[i] = std::clamp(2 * share[i] - 1, 0.0f, 1.0f) + std::clamp(2 * wide[i] - 1, -1.0f, 0.0f);
  mask.share = std::move(share);
  return mask;
}

// Places of a mask between which the middle of each of `texels` texels lies.
struct Between {
  int first = 0, second = 0;
  float share = 0;  // weight of `second`
};
std::vector<Between> PlacesIn(int places, int texels) {
  std::vector<Between> all(static_cast<std::size_t>(texels));
  for (int i = 0; i < texels; ++i) {
    const double at = std::clamp((i + 0.5) / texels * places - 0.5, 0.0, places - 1.0);
    const int first = static_cast<int>(at);
    all[static_cast<std::size_t>(i)] = {first, std::min(first + 1, places - 1),
                                        static_cast<float>(at - first)};
  }
  return all;
}

float Bilinear(const ImagedMask& mask, const Between& x, const Between& y) {
  const auto at = [&](int column, int row) {
    return mask.share[static_cast<std::size_t>(row) * static_cast<std::size_t>(mask.width) +
                      static_cast<std::size_t>(column)];
  };
  return (1 - y.share) * ((1 - x.share) * at(x.first, y.first) + x.share * at(x.second, y.first)) +
         y.share * ((1 - x.share) * at(x.first, y.second) + x.share * at(x.second, y.second));
}

}  // namespace

int TextureReduction(int width, int height, int max_size) {
  return (std::max(width, height) + max_size - 1) / max_size;
}

ColourImage ReducedPanorama(const ColourImage& image, int reduction) {
  ColourImage small((image.width + reduction - 1) / reduction,
                    (image.height + reduction - 1) / reduction);
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      std::array<int, 3> sum{};
      int count = 0;
      for (int v = y * reduction; v < std::min((y + 1) * reduction, image.height); ++v)
        for (int u = x * reduction; u < std::min((x + 1) * reduction, image.width); ++u, ++count)
          for (int c = 0; c < 3; ++c) sum[static_cast<std::size_t>(c)] += image.at(u, v)[c];
      for (int c = 0; c < 3; ++c)
        small.at(x, y)[c] =
            static_cast<std::uint8_t>((sum[static_cast<std::size_t>(c)] + count / 2) / count);
    }
  return small;
}

namespace {

// Texels of a relief along both axes: one per pixel when that is not too many.
glm::ivec2 TexelsOf(int width, int height) {
  const double shrink = std::max(1.0, double(std::max(width, height)) / kReliefSide);
  return {std::max(1, static_cast<int>(std::lround(width / shrink))),
          std::max(1, static_cast<int>(std::lround(height / shrink)))};
}

// Pixel of a map that a texel takes its value from.
int PixelOf(int texel, int pixels, int texels) {
  return std::min(static_cast<int>((texel + 0.5) * pixels / texels), pixels - 1);
}

}  // namespace

DepthMap SampledRelief(const DepthMap& map) {
  if (map.empty()) return {};
  const glm::ivec2 size = TexelsOf(map.width, map.height);
  DepthMap sampled(size.x, size.y);
  PutSampled(map, {0, 0, map.width, map.height}, {map.width, map.height}, sampled);
  return sampled;
}

void PutSampled(const DepthMap& part, const PixelBounds& box, const glm::ivec2& whole,
                DepthMap& sampled) {
  for (int y = 0; y < sampled.height; ++y) {
    const int v = PixelOf(y, whole.y, sampled.height);
    if (v < box.top || v >= box.bottom) continue;
    for (int x = 0; x < sampled.width; ++x)
      if (const int u = PixelOf(x, whole.x, sampled.width); u >= box.left && u < box.right)
        sampled.at(x, y) = part.at(u - box.left, v - box.top);
  }
}

void ShiftSampled(const DepthMap& before, const DepthMap& after, const PixelBounds& changed,
                  DepthMap& sampled) {
  constexpr int kReach = 4;  // px
  const PixelBounds box = Grown(changed, kReach, after.width, after.height);
  // Mean difference over the square about a pixel, by sums over rows and columns of the box.
  const auto w = static_cast<std::size_t>(box.width()) + 1;
  std::vector<double> sum(w * (static_cast<std::size_t>(box.height()) + 1), 0.0);
  for (int y = box.top; y < box.bottom; ++y)
    for (int x = box.left; x < box.right; ++x) {
      const double step = static_cast<double>(after.at(x, y)) - before.at(x, y);
      const std::size_t i = static_cast<std::size_t>(y - box.top + 1) * w +
                            static_cast<std::size_t>(x - box.left + 1);
      sum[i] = sum[i - 1] + sum[i - w] - sum[i - w - 1] + (std::isfinite(step) ? step : 0.0);
    }
  const auto mean = [&](int x, int y) {
    const PixelBounds part{std::max(x - kReach, box.left), std::max(y - kReach, box.top),
                           std::min(x + kReach + 1, box.right),
                           std::min(y + kReach + 1, box.bottom)};
    const auto at = [&](int column, int row) {
      return sum[static_cast<std::size_t>(row - box.top) * w +
                 static_cast<std::size_t>(column - box.left)];
    };
    return (at(part.right, part.bottom) - at(part.left, part.bottom) - at(part.right, part.top) +
            at(part.left, part.top)) /
           (static_cast<double>(part.width()) * part.height());
  };
  for (int y = 0; y < sampled.height; ++y) {
    const int v = PixelOf(y, after.height, sampled.height);
    if (v < box.top || v >= box.bottom) continue;
    for (int x = 0; x < sampled.width; ++x) {
      const int u = PixelOf(x, after.width, sampled.width);
      if (u < box.left || u >= box.right) continue;
      float& height = sampled.at(x, y);
      if (std::isnan(height) || std::isnan(after.at(u, v)))
        height = after.at(u, v);
      else
        height += static_cast<float>(mean(u, v));
    }
  }
}

ReliefTexture MakeReliefTexture(const glm::ivec2& panorama_size, const DepthMap& depth,
                                bool whole_turn, const DepthMap& sigma) {
  return MakeReliefTexture(panorama_size, depth, SampledRelief(depth), whole_turn,
                           SampledRelief(sigma));
}

ReliefTexture MakeReliefTexture(const glm::ivec2& panorama_size, const DepthMap& depth,
                                DepthMap drawn, bool whole_turn, const DepthMap& sampled_sigma) {
  ImagedMask mask;
  const auto make_mask = [&] {
    mask = MakeImagedMask(panorama_size.x, panorama_size.y, depth, whole_turn);
  };
  ReliefTexture relief;
  if (depth.empty()) {
    make_mask();
    relief.width = mask.width;
    relief.height = mask.height;
    for (const float share : mask.share)
      relief.texels.insert(relief.texels.end(), {0, 0, 0, share});
    return relief;
  }
  relief.width = drawn.width;
  relief.height = drawn.height;
  relief.texels.resize(4 * static_cast<std::size_t>(relief.width) *
                       static_cast<std::size_t>(relief.height));
  const auto texel = [&](int x, int y) {
    return &relief
                .texels[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(relief.width) +
                             static_cast<std::size_t>(x))];
  };
  {
    const std::jthread other(make_mask);
    SmoothOutlines(drawn, whole_turn, sampled_sigma);
    FillUnknown(drawn);
  }
  const std::vector<Between> columns = PlacesIn(mask.width, relief.width),
                             rows = PlacesIn(mask.height, relief.height);
  simulation::ForRowsOnTwoThreads(0, relief.height, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      const int above = std::max(y - 1, 0), below = std::min(y + 1, relief.height - 1);
      for (int x = 0; x < relief.width; ++x) {
        int left = x - 1, right = x + 1;
        if (whole_turn) {
          left = (left + relief.width) % relief.width;
          right %= relief.width;
        } else {
          left = std::max(left, 0);
          right = std::min(right, relief.width - 1);
        }
        const int across = whole_turn ? 2 : std::max(right - left, 1);
        float* at = texel(x, y);
        at[0] = drawn.at(x, y);
        at[1] = (drawn.at(right, y) - drawn.at(left, y)) * static_cast<float>(relief.width) /
                static_cast<float>(across);
        at[2] = (drawn.at(x, below) - drawn.at(x, above)) * static_cast<float>(relief.height) /
                static_cast<float>(std::max(below - above, 1));
        at[3] =
            Bilinear(mask, columns[static_cast<std::size_t>(x)], rows[static_cast<std::size_t>(y)]);
      }
    }
  });
  return relief;
}

ReliefCeiling MakeReliefCeiling(const ReliefTexture& relief, bool whole_turn) {
  constexpr int kBlocks = 128, kLeast = 8;
  const int width = relief.width, height = relief.height;
  ReliefCeiling ceiling;
  ceiling.block = std::max(kLeast, (std::max(width, height) + kBlocks - 1) / kBlocks);
  ceiling.width = (width + ceiling.block - 1) / ceiling.block;
  ceiling.height = (height + ceiling.block - 1) / ceiling.block;
  const auto index = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(ceiling.width) +
           static_cast<std::size_t>(x);
  };
  // Rows of a block first, all columns at once: the live preview of a depth map waits for this.
  std::vector<float> own(index(0, ceiling.height), 0.0f);
  std::vector<float> highest(static_cast<std::size_t>(width));
  for (int top = 0; top < height; top += ceiling.block) {
    std::fill(highest.begin(), highest.end(), 0.0f);
    for (int y = top; y < std::min(top + ceiling.block, height); ++y) {
      const float* row = &relief.texels[4 * static_cast<std::size_t>(y) * highest.size()];
      for (std::size_t x = 0; x < highest.size(); ++x)
        highest[x] = highest[x] < row[4 * x] ? row[4 * x] : highest[x];
    }
    for (int x = 0; x < width; ++x) {
      float& of_block = own[index(x / ceiling.block, top / ceiling.block)];
      of_block = std::max(of_block, highest[static_cast<std::size_t>(x)]);
    }
  }
  ceiling.relief = own;
  for (int y = 0; y < ceiling.height; ++y)
    for (int x = 0; x < ceiling.width; ++x)
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
          const int row = y + j;
          const int column = whole_turn ? (x + i + ceiling.width) % ceiling.width : x + i;
          if (row < 0 || row >= ceiling.height || column < 0 || column >= ceiling.width) continue;
          ceiling.relief[index(x, y)] =
              std::max(ceiling.relief[index(x, y)], own[index(column, row)]);
        }
  return ceiling;
}

BroadSlopes MakeBroadSlopes(const ReliefTexture& relief, bool whole_turn, double blur) {
  constexpr int kBlocks = 512;
  constexpr float kStep = 3e-4f;     // m per texel; a slope of this size has half the weight
  constexpr float kSteep = 1.5e-4f;  // m per texel; an outline, as relief_outlines.cpp finds them
  const int block = (std::max(relief.width, relief.height) + kBlocks - 1) / kBlocks;
  BroadSlopes broad;
  broad.width = (relief.width + block - 1) / block;
  broad.height = (relief.height + block - 1) / block;
  const auto of = [&](int x, int y) {
    return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(broad.width) +
                static_cast<std::size_t>(x));
  };
  std::vector<float> sums(of(0, broad.height), 0.0f);  // along u, along v, weight
  std::vector<std::uint8_t> has_step(sums.size() / 3, 0);
  simulation::ForRowsOnTwoThreads(0, broad.height, [&](int first, int last) {
    for (int y = first * block; y < std::min(last * block, relief.height); ++y)
      for (int x = 0; x < relief.width; ++x) {
        const float* at =
            &relief
                 .texels[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(relief.width) +
                              static_cast<std::size_t>(x))];
        const float u = at[1] / static_cast<float>(relief.width),
                    v = at[2] / static_cast<float>(relief.height);
        const float weight = 1 / (1 + (u * u + v * v) / (kStep * kStep));
        float* to = &sums[of(x / block, y / block)];
        to[0] += weight * at[1], to[1] += weight * at[2], to[2] += weight;
        if (u * u + v * v > kSteep * kSteep) has_step[of(x / block, y / block) / 3] = 1;
      }
  });
  if (const int radius = BlurRadius(blur / block); radius > 0)
    BlurTwice(sums, broad.width, broad.height, 3, radius, whole_turn, Beyond::kZero);
  broad.slopes.resize(sums.size());
  for (int y = 0; y < broad.height; ++y)
    for (int x = 0; x < broad.width; ++x) {
      float sum[3] = {};
      bool is_beside_step = false;
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
          const int column = whole_turn ? (x + i + broad.width) % broad.width
                                        : std::clamp(x + i, 0, broad.width - 1);
          const std::size_t at = of(column, std::clamp(y + j, 0, broad.height - 1));
          is_beside_step = is_beside_step || has_step[at / 3] != 0;
          const float* from = &sums[at];
          const auto share = static_cast<float>((2 - std::abs(i)) * (2 - std::abs(j)));
          for (int c = 0; c < 3; ++c) sum[c] += share * from[c];
        }
      float* to = &broad.slopes[of(x, y)];
      to[0] = sum[0] / sum[2], to[1] = sum[1] / sum[2], to[2] = is_beside_step ? 0.0f : 1.0f;
    }
  return broad;
}

bool IsWholeTurn(const Projection& projection, int width) {
  return projection.type == ProjectionType::kEquirectangular &&
         std::abs(360.0 * projection.px_per_deg - width) < 1.0;
}

}  // namespace arthro::app
