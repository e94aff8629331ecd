#include "simulation/haptics/relief/depth_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/haptics/relief/relief_smoothing.h"

namespace arthro::simulation {
namespace {

// A step of this height changes the force by 1 mN at 500 N/m and turns the normal by 2° on a 0.05
// mm pixel.
constexpr double kFeltStep = 2e-6;  // m

// Chamfer distance in pixels to the nearest pixel that is not imaged; the border counts as such.
std::vector<float> DistanceToUnknown(const DepthMap& depth) {
  const int w = depth.width, h = depth.height;
  constexpr float kDiagonal = 1.41421356f;
  std::vector<float> distance(depth.relief.size());
  const auto at = [&](int x, int y) -> float& {
    return distance[static_cast<std::size_t>(y) * static_cast<std::size_t>(w) +
                    static_cast<std::size_t>(x)];
  };
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      at(x, y) = !std::isfinite(depth.at(x, y))
                     ? 0.0f
                     : static_cast<float>(1 + std::min({x, y, w - 1 - x, h - 1 - y}));
  const auto lower = [&](int x, int y, int nx, int ny, float cost) {
    if (nx >= 0 && ny >= 0 && nx < w && ny < h) at(x, y) = std::min(at(x, y), at(nx, ny) + cost);
  };
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      lower(x, y, x - 1, y, 1), lower(x, y, x, y - 1, 1);
      lower(x, y, x - 1, y - 1, kDiagonal), lower(x, y, x + 1, y - 1, kDiagonal);
    }
  for (int y = h - 1; y >= 0; --y)
    for (int x = w - 1; x >= 0; --x) {
      lower(x, y, x + 1, y, 1), lower(x, y, x, y + 1, 1);
      lower(x, y, x + 1, y + 1, kDiagonal), lower(x, y, x - 1, y + 1, kDiagonal);
    }
  return distance;
}

// Gives pixels next to an unknown one no weight, so that no query with weight reads an invented
// relief.
double FadeWeight(double distance_px, double fade_px) noexcept {
  const double s = std::clamp((distance_px - 1.0) / fade_px, 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s);
}

}  // namespace

double QuantumOf(const DepthMap& depth) {
  // In a quantised map many neighbours are equal and the others differ by a step or more. In a
  // smooth map some neighbours differ by almost nothing.
  std::vector<float> steps;
  std::size_t pairs = 0;
  for (int y = 0; y < depth.height; ++y)
    for (int x = 1; x < depth.width; ++x) {
      const float step = std::abs(depth.at(x, y) - depth.at(x - 1, y));
      if (!std::isfinite(step)) continue;
      ++pairs;
      if (step > 0.0f) steps.push_back(step);
    }
  if (steps.empty() || pairs - steps.size() < pairs / 10) return 0.0;
  const auto low = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 100);
  std::nth_element(steps.begin(), low, steps.end());
  return static_cast<double>(*low);
}

DepthField::DepthField(const Backdrop& backdrop, int width, int height,
                       const DepthFieldOptions& options)
    : projection_(backdrop.projection),
      radius_(backdrop.radius),
      free_radius_(backdrop.radius),
      fade_px_(options.fade_px),
      width_(width),
      height_(height) {
  if (width < 2 || height < 2) {
    *this = DepthField();
    return;
  }
  pixel_size_ = projection_.type == ProjectionType::kGnomonic
                    ? radius_ / projection_.focal_px
                    : radius_ * RadiansFromDegrees(1.0 / projection_.px_per_deg);
}

DepthField::DepthField(const Backdrop& backdrop, const DepthMap& depth,
                       const DepthFieldOptions& options, const DepthMap& sigma)
    : DepthField(backdrop, depth.width, depth.height, options) {
  if (empty()) return;
  const bool is_quantised = QuantumOf(depth) > kFeltStep;
  const int passes = is_quantised ? std::max(options.quantised_passes, options.smoothing_passes)
                                  : options.smoothing_passes;
  const TouchedRelief touched = sigma.empty()
                                    ? SmoothRelief(depth, passes)
                                    : SmoothRelief(depth, passes, sigma, backdrop,
                                                   {options.noise_slope, options.widest_smoothing});
  const std::vector<float>& height = touched.height;
  const std::vector<float> distance = DistanceToUnknown(depth);
  texels_.resize(depth.relief.size());
  float highest = 0.0f;
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                            static_cast<std::size_t>(x);
      const std::size_t left = x > 0 ? i - 1 : i, right = x + 1 < width_ ? i + 1 : i;
      const std::size_t above = y > 0 ? i - static_cast<std::size_t>(width_) : i;
      const std::size_t below = y + 1 < height_ ? i + static_cast<std::size_t>(width_) : i;
      texels_[i] = {height[i], 0.5f * (height[right] - height[left]),
                    0.5f * (height[below] - height[above]),
                    static_cast<float>(FadeWeight(distance[i], options.fade_px))};
      if (!touched.sigma.empty())
        texels_[i].weight /= 1.0f + touched.sigma[i] / static_cast<float>(options.soft_error);
      if (texels_[i].weight > 0.0f) highest = std::max(highest, height[i]);
    }
  free_radius_ = std::max(0.0, radius_ - static_cast<double>(highest));
}

DepthField::Texel DepthField::Sample(double u, double v) const noexcept {
  const int x = std::min(static_cast<int>(u), width_ - 2);
  const int y = std::min(static_cast<int>(v), height_ - 2);
  const float fu = static_cast<float>(u - x), fv = static_cast<float>(v - y);
  const Texel* row = &texels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                              static_cast<std::size_t>(x)];
  const Texel &a = row[0], &b = row[1], &c = row[width_], &d = row[width_ + 1];
  const float wa = (1 - fu) * (1 - fv), wb = fu * (1 - fv), wc = (1 - fu) * fv, wd = fu * fv;
  return {wa * a.h + wb * b.h + wc * c.h + wd * d.h, wa * a.hu + wb * b.hu + wc * c.hu + wd * d.hu,
          wa * a.hv + wb * b.hv + wc * c.hv + wd * d.hv,
          wa * a.weight + wb * b.weight + wc * c.weight + wd * d.weight};
}

FieldQuery DepthField::Query(const glm::dvec3& x) const noexcept {
  FieldQuery query;
  const double length = glm::length(x);
  if (width_ == 0 || !(length > 0.0)) return query;
  const auto pixel = PixelFromDirection(projection_, x);
  if (!pixel) return query;
  const double u = pixel->x, v = pixel->y;
  const glm::dmat2x3 gradients = PixelGradients(projection_, x);
  query.px_per_m = std::sqrt(
      std::max(glm::dot(gradients[0], gradients[0]), glm::dot(gradients[1], gradients[1])));
  if (!(u >= 0.0 && v >= 0.0 && u <= width_ - 1 && v <= height_ - 1)) return query;
  const glm::dvec3 inward = x / -length;
  if (texels_.empty()) {
    const double border = 1.0 + std::min({u, v, width_ - 1 - u, height_ - 1 - v});
    query.weight = FadeWeight(border, fade_px_);
    query.clearance = radius_ - length;
    query.normal = inward;
    return query;
  }
  const Texel texel = Sample(u, v);
  const glm::dvec3 gradient = inward - static_cast<double>(texel.hu) * gradients[0] -
                              static_cast<double>(texel.hv) * gradients[1];
  const double slope = glm::length(gradient);
  query.weight = texel.weight;
  query.clearance = (radius_ - static_cast<double>(texel.h) - length) / slope;
  query.normal = gradient / slope;
  return query;
}

}  // namespace arthro::simulation
