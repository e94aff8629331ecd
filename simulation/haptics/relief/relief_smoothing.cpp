#include "simulation/haptics/relief/relief_smoothing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "simulation/core/error.h"
#include "simulation/haptics/relief/plane_filters.h"
#include "simulation/haptics/relief/relief_steps.h"

namespace arthro::simulation {
namespace {

// Difference of two heights, in standard errors, from which on a tap counts less, and not at all.
constexpr float kSameSide = 2.0f, kOtherSide = 4.0f;

// `near`: how near each pixel is to a step; empty: there is none.
OuterTaps TapsBetween(const Plane& near, const Plane& heights, const Plane& sigma, int width,
                      int height, int gap) {
  OuterTaps taps;
  if (near.empty()) return taps;
  const auto w = static_cast<std::size_t>(width), g = static_cast<std::size_t>(gap);
  const std::size_t all = near.size();
  for (Plane* plane : {&taps.left, &taps.right, &taps.above, &taps.below})
    plane->assign(all, 0.25f);
  const auto tap = [&](std::size_t a, std::size_t b) {
    const float beside = std::max(near[a], near[b]), error = std::max(sigma[a], sigma[b]);
    if (!(beside > 0.0f) || !(error > 0.0f)) return 0.25f;
    const float off = std::abs(heights[a] - heights[b]) / error;
    const float s = std::clamp((off - kSameSide) / (kOtherSide - kSameSide), 0.0f, 1.0f);
    return 0.25f * (1.0f - beside * s * s * (3.0f - 2.0f * s));
  };
  for (int y = 0; y < height; ++y) {
    const std::size_t row = static_cast<std::size_t>(y) * w;
    for (std::size_t i = row; i + g < row + w; ++i)
      taps.right[i] = taps.left[i + g] = tap(i, i + g);
  }
  for (std::size_t i = 0; i + g * w < all; ++i)
    taps.below[i] = taps.above[i + g * w] = tap(i, i + g * w);
  return taps;
}

// Place of a map within a larger one, px. Filters of a part give the bytes that they give in the
// whole, away from the edges of the part.
struct Frame {
  int left = 0, top = 0;
  int width = 0, height = 0;  // size of the whole
};
Frame WholeOf(const DepthMap& map) { return {0, 0, map.width, map.height}; }

// Sums of a normalised convolution.
struct Sums {
  Plane value, mass;
};

Sums SumsOf(const DepthMap& depth, int passes) {
  Sums sums{depth.relief, Plane(depth.relief.size())};
  for (std::size_t i = 0; i < depth.relief.size(); ++i) {
    const bool is_imaged = std::isfinite(depth.relief[i]);
    sums.mass[i] = is_imaged ? 1.0f : 0.0f;
    if (!is_imaged) sums.value[i] = 0.0f;
  }
  for (Plane* plane : {&sums.value, &sums.mass})
    FilterBinomial(*plane, depth.width, depth.height, passes);
  return sums;
}

Plane Ratio(const Sums& sums) {
  Plane ratio(sums.value.size());
  for (std::size_t i = 0; i < ratio.size(); ++i)
    ratio[i] = sums.mass[i] > 0.0f ? sums.value[i] / sums.mass[i] : 0.0f;
  return ratio;
}

// Weighted sums over a kernel about each pixel, for the plane that fits its heights best. Beside a
// hole the kernel lies to one side, and the plane leads back from its centre of mass.
class Moments {
 public:
  // `sums`: heights times masses, and masses, of which the first kernel is one pixel wide.
  Moments(Sums sums, int width, int height, const Frame& frame)
      : width_(width),
        frame_(frame),
        centre_x_(0.5f * static_cast<float>(frame.width)),
        centre_y_(0.5f * static_cast<float>(frame.height)),
        m_(std::move(sums.mass)),
        h_(std::move(sums.value)),
        x_(m_),
        y_(m_),
        xx_(m_),
        xy_(m_),
        yy_(m_),
        hx_(h_),
        hy_(h_) {
    for (int row = 0; row < height; ++row)
      for (int column = 0; column < width; ++column) {
        const std::size_t i = At(column, row);
        const float x = static_cast<float>(frame_.left + column) - centre_x_,
                    y = static_cast<float>(frame_.top + row) - centre_y_;
        x_[i] *= x, y_[i] *= y, hx_[i] *= x, hy_[i] *= y;
        xx_[i] *= x * x, xy_[i] *= x * y, yy_[i] *= y * y;
      }
  }
  std::array<Plane*, 9> All() { return {&m_, &h_, &x_, &y_, &xx_, &xy_, &yy_, &hx_, &hy_}; }

  // Height of the plane at the pixel, which has mass.
  float PlaneAt(int column, int row) const {
    const std::size_t i = At(column, row);
    const float per_mass = 1.0f / m_[i];
    const float x = x_[i] * per_mass, y = y_[i] * per_mass, h = h_[i] * per_mass;
    // A pixel is as wide as a variance of 1/12; this also keeps a single row from being singular.
    constexpr float kOfPixel = 1.0f / 12.0f;
    const float xx = xx_[i] * per_mass - x * x + kOfPixel, xy = xy_[i] * per_mass - x * y,
                yy = yy_[i] * per_mass - y * y + kOfPixel;
    const float hx = hx_[i] * per_mass - h * x, hy = hy_[i] * per_mass - h * y;
    const float det = xx * yy - xy * xy;
    const float du = static_cast<float>(frame_.left + column) - centre_x_ - x,
                dv = static_cast<float>(frame_.top + row) - centre_y_ - y;
    if (!(det > 0.0f)) return h;
    return h + ((yy * hx - xy * hy) * du + (xx * hy - xy * hx) * dv) / det;
  }

 private:
  std::size_t At(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }
  int width_;
  Frame frame_;
  float centre_x_, centre_y_;
  Plane m_, h_, x_, y_, xx_, xy_, yy_, hx_, hy_;
};

// Smooths the variance over about four pixels, so that the force changes gradually where the
// standard error does. Zero where nothing was imaged. Empty where no error is known.
Plane SmoothSigma(const DepthMap& depth, const DepthMap& sigma) {
  float largest = 0.0f;
  bool is_known = false;
  for (const float s : sigma.relief)
    if (std::isfinite(s)) largest = std::max(largest, s), is_known = true;
  if (!is_known || sigma.relief.size() != depth.relief.size()) return {};
  Sums sums{Plane(depth.relief.size(), 0.0f), Plane(depth.relief.size(), 0.0f)};
  for (std::size_t i = 0; i < depth.relief.size(); ++i) {
    if (!std::isfinite(depth.relief[i])) continue;
    const float s = std::isfinite(sigma.relief[i]) ? sigma.relief[i] : largest;
    sums.value[i] = s * s;
    sums.mass[i] = 1.0f;
  }
  Plane scratch;
  for (Plane* plane : {&sums.value, &sums.mass})
    for (const int gap : {1, 1, 2, 2, 4})
      Widen(*plane, depth.width, depth.height, gap, {}, scratch);
  Plane smooth = Ratio(sums);
  for (float& variance : smooth) variance = std::sqrt(variance);
  return smooth;
}

// Pixels per metre across the line of sight, the larger of both directions; 0 at the portal.
double PixelsPerMetre(const Backdrop& backdrop, float height, int x, int y) {
  const double radius = backdrop.radius - static_cast<double>(height);
  if (!(radius > 0.0)) return 0.0;
  const glm::dmat2x3 gradients =
      PixelGradients(backdrop.projection, radius * DirectionFromPixel(backdrop.projection, {x, y}));
  return std::sqrt(
      std::max(glm::dot(gradients[0], gradients[0]), glm::dot(gradients[1], gradients[1])));
}

// Standard deviation of the smoothing that a standard error asks for, m.
double SmoothingOf(float sigma, const NoiseLimits& limits) {
  return std::min(limits.widest,
                  static_cast<double>(sigma) / (2.0 * std::numbers::sqrt2 * limits.slope));
}

// Smoothing that each pixel asks for beyond the usual one: its standard deviation, px; and the size
// of a pixel, m. Zero where no error or no relief is known.
struct WantedSmoothing {
  Plane deviation, pixel_size;
};

WantedSmoothing SmoothingFor(const DepthMap& depth, const Plane& height, const Plane& sigma,
                             const Backdrop& backdrop, const NoiseLimits& limits,
                             const Frame& frame) {
  WantedSmoothing wanted{Plane(height.size(), 0.0f), Plane(height.size(), 0.0f)};
  for (int y = 0; y < depth.height; ++y)
    for (int x = 0; x < depth.width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(depth.width) +
                            static_cast<std::size_t>(x);
      if (!(sigma[i] > 0.0f) || !std::isfinite(depth.relief[i])) continue;
      const double px_per_m = PixelsPerMetre(backdrop, height[i], frame.left + x, frame.top + y);
      if (!(px_per_m > 0.0)) continue;
      wanted.deviation[i] = static_cast<float>(SmoothingOf(sigma[i], limits) * px_per_m);
      wanted.pixel_size[i] = static_cast<float>(1.0 / px_per_m);
    }
  return wanted;
}

// How near each pixel is to a step; empty: there is none.
Plane NearStepsOf(const DepthMap& depth, const Plane& sigma, const WantedSmoothing& wanted) {
  Sums sums = SumsOf(depth, 0);
  Plane scratch;
  for (Plane* plane : {&sums.value, &sums.mass})
    for (const int gap : {1, 1, 2, 2})  // a standard deviation of 2.2 px
      Widen(*plane, depth.width, depth.height, gap, {}, scratch);
  Plane smooth = Ratio(sums);
  for (std::size_t i = 0; i < smooth.size(); ++i)
    if (!std::isfinite(depth.relief[i])) smooth[i] = depth.relief[i];
  Plane near =
      NearSteps(depth.width, depth.height, smooth, sigma, wanted.deviation, wanted.pixel_size);
  if (near.empty()) return near;
  // Fades over some 10 px; pixels beyond the border count as those beside it.
  Sums fading{std::move(near), Plane(depth.relief.size(), 1.0f)};
  for (Plane* plane : {&fading.value, &fading.mass})
    for (const int gap : {1, 2, 4, 8}) Widen(*plane, depth.width, depth.height, gap, {}, scratch);
  return Ratio(fading);
}

// `widest`: of the smoothing, px, where it is asked for.
TouchedRelief SmoothPart(const DepthMap& depth, int passes, const DepthMap& sigma,
                         const Backdrop& backdrop, const NoiseLimits& limits, const Frame& frame,
                         float* widest_px = nullptr, const std::atomic<bool>* stop = nullptr) {
  Sums sums = SumsOf(depth, passes);
  TouchedRelief touched{Ratio(sums), SmoothSigma(depth, sigma)};
  if (touched.sigma.empty()) return touched;
  const int w = depth.width, h = depth.height;
  const WantedSmoothing wanted =
      SmoothingFor(depth, touched.height, touched.sigma, backdrop, limits, frame);
  const float widest = *std::max_element(wanted.deviation.begin(), wanted.deviation.end());
  if (widest_px != nullptr) *widest_px = widest;
  const Plane near = widest > 0.0f ? NearStepsOf(depth, touched.sigma, wanted) : Plane();

  Moments moments(std::move(sums), w, h, frame);
  Plane before = touched.height;
  float variance = 0.0f;  // beyond the usual one, px²
  for (int growth = 0; variance < widest * widest; ++growth) {
    const int gap = 1 << (growth / 2);
    if (gap >= std::max(w, h)) break;
    if (stop != nullptr && stop->load(std::memory_order_relaxed))
      throw Error(Code::kCancelled, "stopped");
    const float added = 0.5f * static_cast<float>(gap) * static_cast<float>(gap);
    const OuterTaps taps = TapsBetween(near, before, touched.sigma, w, h, gap);
    WidenAll(moments.All(), w, h, gap, taps);
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        const std::size_t i =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x);
        const float rest = wanted.deviation[i] * wanted.deviation[i] - variance;
        if (!(rest > 0.0f)) continue;
        const float after = moments.PlaneAt(x, y);
        touched.height[i] += std::min(1.0f, rest / added) * (after - before[i]);
        before[i] = after;
      }
    variance += added;
  }
  return touched;
}

// Medians of 3 x 3 pixels: they remove the outliers of white noise, and keep steps sharp.
DepthMap MediansOf(const DepthMap& depth, const DepthMap& sigma) {
  DepthMap quiet = depth;
  if (sigma.relief.size() == depth.relief.size())
    for (int y = 0; y < depth.height; ++y)
      for (int x = 0; x < depth.width; ++x) {
        if (!std::isfinite(depth.at(x, y)) || !(sigma.at(x, y) > 0.0f)) continue;
        std::array<float, 9> around{};
        std::size_t known = 0;
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, depth.height - 1); ++v)
          for (int u = std::max(x - 1, 0); u <= std::min(x + 1, depth.width - 1); ++u)
            if (std::isfinite(depth.at(u, v))) around[known++] = depth.at(u, v);
        const auto middle = around.begin() + static_cast<std::ptrdiff_t>(known / 2);
        std::nth_element(around.begin(), middle,
                         around.begin() + static_cast<std::ptrdiff_t>(known));
        quiet.at(x, y) = *middle;
      }
  return quiet;
}

DepthMap WithoutNoiseIn(const DepthMap& depth, const DepthMap& sigma, const Backdrop& backdrop,
                        const Frame& frame, float* widest_px = nullptr,
                        const std::atomic<bool>* stop = nullptr) {
  DepthMap quiet = MediansOf(depth, sigma);
  const TouchedRelief touched = SmoothPart(quiet, 0, sigma, backdrop, {}, frame, widest_px, stop);
  for (std::size_t i = 0; i < quiet.relief.size(); ++i)
    if (std::isfinite(depth.relief[i])) quiet.relief[i] = touched.height[i];
  return quiet;
}

DepthMap CutOut(const DepthMap& map, const PixelBounds& box) {
  DepthMap part(box.width(), box.height());
  for (int y = 0; y < box.height(); ++y)
    std::copy_n(&map.relief[static_cast<std::size_t>(box.top + y) * map.width + box.left],
                box.width(), &part.relief[static_cast<std::size_t>(y) * box.width()]);
  return part;
}

// Pixels to each side that the smoothing of this standard deviation reads: gaps of its taps.
int ReachOf(double deviation_px) {
  int reach = 0;
  double variance = 0;
  for (int growth = 0; variance < deviation_px * deviation_px; ++growth) {
    const int gap = 1 << (growth / 2);
    reach += gap;
    variance += 0.5 * gap * gap;
  }
  return reach;
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
  return SmoothPart(depth, passes, sigma, backdrop, limits, WholeOf(depth));
}

DepthMap WithoutNoise(const DepthMap& depth, const DepthMap& sigma, const Backdrop& backdrop,
                      const std::atomic<bool>* stop) {
  return WithoutNoiseIn(depth, sigma, backdrop, WholeOf(depth), nullptr, stop);
}

QuietPart WithoutNoiseAround(const DepthMap& depth, const DepthMap& sigma, const Backdrop& backdrop,
                             const PixelBounds& changed, const std::atomic<bool>* stop) {
  const int width = depth.width, height = depth.height;
  const PixelBounds whole{0, 0, width, height};
  bool has_every_error = sigma.relief.size() == depth.relief.size();
  for (std::size_t i = 0; has_every_error && i < depth.relief.size(); ++i)
    has_every_error = !std::isfinite(depth.relief[i]) || std::isfinite(sigma.relief[i]);
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
    float widest = 0;
    const DepthMap quiet = WithoutNoiseIn(CutOut(depth, read), CutOut(sigma, read), backdrop,
                                          {read.left, read.top, width, height}, &widest, stop);
    if (const int wanted = ReachOf(static_cast<double>(widest)); wanted > reach) {
      reach = wanted;
      continue;
    }
    return {box,
            CutOut(quiet, {box.left - read.left, box.top - read.top, box.right - read.left,
                           box.bottom - read.top}),
            read.width() * read.height()};
  }
  return {whole, WithoutNoiseIn(depth, sigma, backdrop, WholeOf(depth), nullptr, stop),
          width * height};
}

}  // namespace arthro::simulation
