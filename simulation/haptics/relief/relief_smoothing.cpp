#include "simulation/haptics/relief/relief_smoothing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "simulation/core/error.h"
#include "simulation/haptics/relief/growing_kernel.h"
#include "simulation/haptics/relief/plane_filters.h"
#include "simulation/haptics/relief/plane_moments.h"
#include "simulation/haptics/relief/relief_steps.h"

namespace arthro::simulation {
namespace {

// Difference of two heights, in standard errors, from which on a tap counts less, and not at all.
constexpr float kSameSide = 2.0f, kOtherSide = 4.0f;

// `near`: how near each pixel is to a step; empty: there is none. `taps` is empty, or of the growth
// before.
void FindTaps(const FloatPlane& near, const FloatPlane& heights, const FloatPlane& sigma, int width,
              int height, int gap, const PixelBounds& window, OuterTaps& taps) {
  if (near.empty()) return;
  const auto w = static_cast<std::size_t>(width), g = static_cast<std::size_t>(gap);
  taps.right.resize(near.size());
  taps.below.resize(near.size());
  const auto tap = [&](std::size_t a, std::size_t b) {
    const float beside = std::max(near[a], near[b]), error = std::max(sigma[a], sigma[b]);
    if (!(beside > 0.0f) || !(error > 0.0f)) return 0.25f;
    const float off = std::abs(heights[a] - heights[b]) / error;
    const float s = std::clamp((off - kSameSide) / (kOtherSide - kSameSide), 0.0f, 1.0f);
    return 0.25f * (1.0f - beside * s * s * (3.0f - 2.0f * s));
  };
  const PixelBounds around = Grown(window, gap, width, height);
  ForRowsOnTwoThreads(around.top, around.bottom, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      const std::size_t row = static_cast<std::size_t>(y) * w,
                        begin = row + static_cast<std::size_t>(around.left),
                        end = row + static_cast<std::size_t>(around.right);
      for (std::size_t i = begin; i < end; ++i)
        taps.right[i] = i + g < row + w ? tap(i, i + g) : 0.25f;
      for (std::size_t i = begin; i < end; ++i)
        taps.below[i] = y + gap < height ? tap(i, i + g * w) : 0.25f;
    }
  });
}

MapFrame WholeOf(const DepthMap& map) { return {0, 0, map.width, map.height}; }
PixelBounds AllOf(const DepthMap& map) { return {0, 0, map.width, map.height}; }

// Sums of a normalised convolution.
struct Sums {
  FloatPlane value, mass;
};

Sums SumsOf(const DepthMap& depth, int passes) {
  Sums sums{depth.relief, FloatPlane(depth.relief.size())};
  ForPixelsOnTwoThreads(depth.relief.size(), [&](std::size_t i) {
    const bool is_imaged = std::isfinite(depth.relief[i]);
    sums.mass[i] = is_imaged ? 1.0f : 0.0f;
    if (!is_imaged) sums.value[i] = 0.0f;
  });
  for (FloatPlane* plane : {&sums.value, &sums.mass})
    FilterBinomial(*plane, depth.width, depth.height, passes);
  return sums;
}

void WidenSums(Sums& sums, int width, int height, std::initializer_list<int> gaps) {
  for (const int gap : gaps)
    WidenAll(std::array{&sums.value, &sums.mass}, width, height, gap, {}, {0, 0, width, height});
}

FloatPlane Ratio(const Sums& sums) {
  FloatPlane ratio(sums.value.size());
  ForPixelsOnTwoThreads(ratio.size(), [&](std::size_t i) {
    ratio[i] = sums.mass[i] > 0.0f ? sums.value[i] / sums.mass[i] : 0.0f;
  });
  return ratio;
}

// Smooths the variance over about four pixels, so that the force changes gradually where the
// standard error does. Zero where nothing was imaged. Empty where no error is known.
FloatPlane SmoothSigma(const DepthMap& depth, const DepthMap& sigma) {
  float largest = 0.0f;
  bool is_known = false;
  for (const float s : sigma.relief)
    if (std::isfinite(s)) largest = std::max(largest, s), is_known = true;
  if (!is_known || sigma.relief.size() != depth.relief.size()) return {};
  Sums sums{FloatPlane(depth.relief.size(), 0.0f), FloatPlane(depth.relief.size(), 0.0f)};
  ForPixelsOnTwoThreads(depth.relief.size(), [&](std::size_t i) {
    if (!std::isfinite(depth.relief[i])) return;
    const float s = std::isfinite(sigma.relief[i]) ? sigma.relief[i] : largest;
    sums.value[i] = s * s;
    sums.mass[i] = 1.0f;
  });
  WidenSums(sums, depth.width, depth.height, {1, 1, 2, 2, 4});
  FloatPlane smooth = Ratio(sums);
  ForPixelsOnTwoThreads(smooth.size(), [&](std::size_t i) { smooth[i] = std::sqrt(smooth[i]); });
  return smooth;
}

// Pixels per metre across the line of sight, the larger of both directions; 0 at the portal.
double PixelsPerMetre(const Backdrop& backdrop, float height, int x, int y) {
  const double radius = backdrop.radius - static_cast<double>(height);
  return radius > 0.0 ? LongerPixelGradient(backdrop.projection, {x, y}) / radius : 0.0;
}

// Standard deviation of the smoothing that a standard error asks for, m.
double SmoothingOf(float sigma, const NoiseLimits& limits) {
  return std::min(limits.widest,
                  static_cast<double>(sigma) / (2.0 * std::numbers::sqrt2 * limits.slope));
}

// Smoothing that each pixel asks for beyond the usual one: its standard deviation, px; and the size
// of a pixel, m. Zero where no error or no relief is known.
struct WantedSmoothing {
  FloatPlane deviation, pixel_size;
};

WantedSmoothing SmoothingFor(const DepthMap& depth, const FloatPlane& height,
                             const FloatPlane& sigma, const Backdrop& backdrop,
                             const NoiseLimits& limits, const MapFrame& frame) {
  WantedSmoothing wanted{FloatPlane(height.size(), 0.0f), FloatPlane(height.size(), 0.0f)};
  ForRowsOnTwoThreads(0, depth.height, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < depth.width; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(depth.width) +
                              static_cast<std::size_t>(x);
        if (!(sigma[i] > 0.0f) || !std::isfinite(depth.relief[i])) continue;
        const double px_per_m = PixelsPerMetre(backdrop, height[i], frame.left + x, frame.top + y);
        if (!(px_per_m > 0.0)) continue;
        wanted.deviation[i] = static_cast<float>(SmoothingOf(sigma[i], limits) * px_per_m);
        wanted.pixel_size[i] = static_cast<float>(1.0 / px_per_m);
      }
  });
  return wanted;
}

// How near each pixel is to a step; empty: there is none.
FloatPlane NearStepsOf(const DepthMap& depth, const FloatPlane& sigma,
                       const WantedSmoothing& wanted) {
  Sums sums = SumsOf(depth, 0);
  WidenSums(sums, depth.width, depth.height, {1, 1, 2, 2});  // a standard deviation of 2.2 px
  FloatPlane smooth = Ratio(sums);
  ForPixelsOnTwoThreads(smooth.size(), [&](std::size_t i) {
    if (!std::isfinite(depth.relief[i])) smooth[i] = depth.relief[i];
  });
  FloatPlane near =
      NearSteps(depth.width, depth.height, smooth, sigma, wanted.deviation, wanted.pixel_size);
  if (near.empty()) return near;
  // Fades over some 10 px; pixels beyond the border count as those beside it.
  Sums fading{std::move(near), FloatPlane(depth.relief.size(), 1.0f)};
  WidenSums(fading, depth.width, depth.height, {1, 2, 4, 8});
  return Ratio(fading);
}

struct SmoothedPart {
  TouchedRelief touched;
  float widest = 0;  // px, of the smoothing
};

// `wanted`: pixels of `depth` whose heights are asked for.
SmoothedPart SmoothPart(const DepthMap& depth, int passes, const DepthMap& sigma,
                        const Backdrop& backdrop, const NoiseLimits& limits, const MapFrame& frame,
                        const PixelBounds& wanted, const std::atomic<bool>* stop = nullptr) {
  Sums sums = SumsOf(depth, passes);
  SmoothedPart part{{Ratio(sums), SmoothSigma(depth, sigma)}};
  TouchedRelief& touched = part.touched;
  if (touched.sigma.empty()) return part;
  const int w = depth.width, h = depth.height;
  const WantedSmoothing smoothing =
      SmoothingFor(depth, touched.height, touched.sigma, backdrop, limits, frame);
  part.widest = *std::max_element(smoothing.deviation.begin(), smoothing.deviation.end());
  const FloatPlane near =
      part.widest > 0.0f ? NearStepsOf(depth, touched.sigma, smoothing) : FloatPlane();

  std::vector<int> gaps = GapsOf(static_cast<double>(part.widest));
  while (!gaps.empty() && gaps.back() >= std::max(w, h)) gaps.pop_back();
  const FloatPlane& deviation = smoothing.deviation;
  const std::vector<Growth> growths =
      GrowthsOf(wanted, deviation, EvenBlocksOf(depth, near), passes, gaps, w, h);
  std::optional<PlaneMoments> moments;
  if (!growths.empty() && !growths.front().uneven.is_empty())
    moments.emplace(std::move(sums.mass), sums.value, w, h, frame);
  FloatPlane before = touched.height, spare;
  OuterTaps taps;
  for (const Growth& growth : growths) {
    if (stop != nullptr && stop->load(std::memory_order_relaxed))
      throw Error(Code::kCancelled, "stopped");
    const PixelBounds &window = growth.window, &uneven = growth.uneven;
    const float added = AddedVariance(growth.gap);
    FindTaps(near, before, touched.sigma, w, h, growth.gap, window, taps);
    WidenOnTwoThreads(sums.value, w, h, growth.gap, taps, window, spare);
    if (!uneven.is_empty()) WidenAll(moments->All(), w, h, growth.gap, taps, uneven);
    ForRowsOnTwoThreads(window.top, window.bottom, [&](int first, int last) {
      FloatPlane planes(static_cast<std::size_t>(window.width()));
      for (int y = first; y < last; ++y) {
        const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(w);
        // A kernel whose taps all count has the mass 1 and its centre at the pixel: the plane's
        // height there is the mean, to the bit, since whole pixels and halves have exact sums.
        std::copy_n(sums.value.data() + row + window.left, planes.size(), planes.data());
        if (uneven.top <= y && y < uneven.bottom)
          moments->PlanesAt(sums.value, y, uneven.left, uneven.right,
                            planes.data() + (uneven.left - window.left));
        const std::size_t begin = row + static_cast<std::size_t>(window.left);
        for (std::size_t x = 0; x < planes.size(); ++x) {
          const std::size_t i = begin + x;
          const float rest = deviation[i] * deviation[i] - growth.variance;
          if (!(rest > 0.0f)) continue;
          touched.height[i] += std::min(1.0f, rest / added) * (planes[x] - before[i]);
          before[i] = planes[x];
        }
      }
    });
  }
  return part;
}

void Sort(float& a, float& b) {
  const float low = std::min(a, b);
  b = std::max(a, b);
  a = low;
}

// Middle of nine values by 19 exchanges of two.
float MedianOfNine(std::array<float, 9> p) {
  Sort(p[1], p[2]), Sort(p[4], p[5]), Sort(p[7], p[8]), Sort(p[0], p[1]), Sort(p[3], p[4]);
  Sort(p[6], p[7]), Sort(p[1], p[2]), Sort(p[4], p[5]), Sort(p[7], p[8]), Sort(p[0], p[3]);
  Sort(p[5], p[8]), Sort(p[4], p[7]), Sort(p[3], p[6]), Sort(p[1], p[4]), Sort(p[2], p[5]);
  Sort(p[4], p[7]), Sort(p[4], p[2]), Sort(p[6], p[4]), Sort(p[4], p[2]);
  return p[4];
}

// Medians of 3 x 3 pixels: they remove the outliers of white noise, and keep steps sharp.
DepthMap MediansOf(const DepthMap& depth, const DepthMap& sigma) {
  DepthMap quiet = depth;
  if (sigma.relief.size() != depth.relief.size()) return quiet;
  ForRowsOnTwoThreads(0, depth.height, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < depth.width; ++x) {
        if (!std::isfinite(depth.at(x, y)) || !(sigma.at(x, y) > 0.0f)) continue;
        std::array<float, 9> around{};
        std::size_t known = 0;
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, depth.height - 1); ++v)
          for (int u = std::max(x - 1, 0); u <= std::min(x + 1, depth.width - 1); ++u)
            if (std::isfinite(depth.at(u, v))) around[known++] = depth.at(u, v);
        if (known == around.size()) {
          quiet.at(x, y) = MedianOfNine(around);
          continue;
        }
        const auto middle = around.begin() + static_cast<std::ptrdiff_t>(known / 2);
        std::nth_element(around.begin(), middle,
                         around.begin() + static_cast<std::ptrdiff_t>(known));
        quiet.at(x, y) = *middle;
      }
  });
  return quiet;
}

struct QuietMap {
  DepthMap relief;
  float widest = 0;  // px, of the smoothing
};

QuietMap WithoutNoiseIn(const DepthMap& depth, const DepthMap& sigma, const Backdrop& backdrop,
                        const MapFrame& frame, const PixelBounds& wanted,
                        const std::atomic<bool>* stop) {
  QuietMap quiet{MediansOf(depth, sigma)};
  const SmoothedPart part = SmoothPart(quiet.relief, 0, sigma, backdrop, {}, frame, wanted, stop);
  quiet.widest = part.widest;
  ForPixelsOnTwoThreads(depth.relief.size(), [&](std::size_t i) {
    if (std::isfinite(depth.relief[i])) quiet.relief.relief[i] = part.touched.height[i];
  });
  return quiet;
}

DepthMap CutOut(const DepthMap& map, const PixelBounds& box) {
  DepthMap part(box.width(), box.height());
  for (int y = 0; y < box.height(); ++y)
    std::copy_n(&map.relief[static_cast<std::size_t>(box.top + y) * map.width + box.left],
                box.width(), &part.relief[static_cast<std::size_t>(y) * box.width()]);
  return part;
}

// Widest smoothing around a rectangle, px, from every eighth pixel and its standard error.
double WidestAround(const DepthMap& depth, const DepthMap& sigma, const Backdrop& backdrop,
                    const PixelBounds& box) {
  constexpr int kStep = 8;
  double widest = 0;
  for (int y = box.top; y < box.bottom; y += kStep)
    for (int x = box.left; x < box.right; x += kStep)
      if (std::isfinite(depth.at(x, y)) && sigma.at(x, y) > 0.0f)
        widest = std::max(widest, SmoothingOf(sigma.at(x, y), {}) *
                                      PixelsPerMetre(backdrop, depth.at(x, y), x, y));
  return widest;
}

}  // namespace

TouchedRelief SmoothRelief(const DepthMap& depth, int passes) {
  return {Ratio(SumsOf(depth, passes)), {}};
}

TouchedRelief SmoothRelief(const DepthMap& depth, int passes, const DepthMap& sigma,
                           const Backdrop& backdrop, const NoiseLimits& limits) {
  return SmoothPart(depth, passes, sigma, backdrop, limits, WholeOf(depth), AllOf(depth)).touched;
}

DepthMap WithoutNoise(const DepthMap& depth, const DepthMap& sigma, const Backdrop& backdrop,
                      const std::atomic<bool>* stop) {
  return WithoutNoiseIn(depth, sigma, backdrop, WholeOf(depth), AllOf(depth), stop).relief;
}

QuietPart WithoutNoiseAround(const DepthMap& depth, const DepthMap& sigma, const Backdrop& backdrop,
                             const PixelBounds& changed, const std::atomic<bool>* stop) {
  const int width = depth.width, height = depth.height;
  const PixelBounds whole{0, 0, width, height};
  std::atomic<bool> has_every_error = sigma.relief.size() == depth.relief.size();
  if (has_every_error)
    ForRowsOnTwoThreads(0, height, [&](int first, int last) {
      const auto w = static_cast<std::size_t>(width);
      for (auto i = static_cast<std::size_t>(first) * w; i < static_cast<std::size_t>(last) * w;
           ++i)
        if (std::isfinite(depth.relief[i]) && !std::isfinite(sigma.relief[i]))
          return has_every_error.store(false);
    });
  // The standard error is smoothed over 10 px, and steps are sought over some 15 more.
  constexpr int kOfSigma = 10, kOfSteps = 16;
  for (int reach = 16; has_every_error;) {
    const PixelBounds box = Grown(changed, reach + kOfSigma + kOfSteps, width, height),
                      read = Grown(box, reach + kOfSigma + kOfSteps, width, height);
    if (read == whole) break;
    // A first guess from few pixels saves a computation with too narrow a margin.
    if (const int guess = ReachOf(WidestAround(depth, sigma, backdrop, read)); guess > reach) {
      reach = guess;
      continue;
    }
    const PixelBounds inner{box.left - read.left, box.top - read.top, box.right - read.left,
                            box.bottom - read.top};
    const QuietMap quiet = WithoutNoiseIn(CutOut(depth, read), CutOut(sigma, read), backdrop,
                                          {read.left, read.top, width, height}, inner, stop);
    if (const int wanted = ReachOf(static_cast<double>(quiet.widest)); wanted > reach) {
      reach = wanted;
      continue;
    }
    return {box, CutOut(quiet.relief, inner), read.width() * read.height()};
  }
  return {whole, WithoutNoise(depth, sigma, backdrop, stop), width * height};
}

}  // namespace arthro::simulation
