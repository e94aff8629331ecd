#include "simulation/scene/lens.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace arthro {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRightAngleMargin = 1e-9;  // rad; a pinhole's tan θ has no meaning nearer to 90°

// r/f of Kannala-Brandt and its derivative by θ.
struct Profile {
  double value, slope;
};

Profile KannalaBrandt(const std::array<double, 4>& k, double theta) {
  const double t = theta * theta;
  return {theta * (1 + t * (k[0] + t * (k[1] + t * (k[2] + t * k[3])))),
          1 + t * (3 * k[0] + t * (5 * k[1] + t * (7 * k[2] + t * 9 * k[3])))};
}

// Whether the profile still rises at every step up to θ. Beyond its first summit two rays would
// share a pixel, and a fit says nothing there.
bool RisesUpTo(const std::array<double, 4>& k, double theta) {
  if (k[0] >= 0 && k[1] >= 0 && k[2] >= 0 && k[3] >= 0) return true;
  constexpr double kStep = kPi / 256;
  for (double at = kStep; at < theta; at += kStep)
    if (!(KannalaBrandt(k, at).slope > 0)) return false;
  return KannalaBrandt(k, theta).slope > 0;
}

// Newton's method held inside a bracket in which the profile rises, so that it always converges.
std::optional<double> KannalaBrandtAngle(const std::array<double, 4>& k, double wanted) {
  constexpr double kStep = kPi / 64;
  double low = 0, high = 0;
  do {
    low = high;
    if (low >= kPi) return std::nullopt;
    high = std::min(high + kStep, kPi);
    // The summit lies in this step: look no further than there.
    if (!(KannalaBrandt(k, high).slope > 0)) {
      double rising = low, falling = high;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (rising + falling);
        (KannalaBrandt(k, middle).slope > 0 ? rising : falling) = middle;
      }
      if (!(KannalaBrandt(k, rising).value >= wanted)) return std::nullopt;
      high = rising;
      break;
    }
  } while (KannalaBrandt(k, high).value < wanted);
  double theta = std::clamp(wanted, low, high);
  for (int i = 0; i < 60; ++i) {
    const auto [value, slope] = KannalaBrandt(k, theta);
    (value < wanted ? low : high) = theta;
    double next = theta - (value - wanted) / slope;
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    if (std::abs(next - theta) <= 1e-15 * (1 + theta)) return next;
    theta = next;
  }
  return theta;
}

bool IsDoubleSphere(const Lens& lens) {
  return lens.k[0] > -1 && lens.k[0] <= 1 && lens.k[1] >= 0 && lens.k[1] <= 1;
}

// [Usenko et al. 2018, eq. 40–45], for a unit ray at θ.
std::optional<double> DoubleSphereRadius(const Lens& lens, double theta) {
  if (!IsDoubleSphere(lens)) return std::nullopt;
  const double xi = lens.k[0], alpha = lens.k[1], x = std::sin(theta), z = std::cos(theta);
  const double w1 = alpha > 0.5 ? (1 - alpha) / alpha : alpha / (1 - alpha);
  const double w2 = (w1 + xi) / std::sqrt(2 * w1 * xi + xi * xi + 1);
  if (!(z > -w2)) return std::nullopt;
  const double below = alpha * std::hypot(x, z + xi) + (1 - alpha) * (z + xi);
  if (!(below > 0)) return std::nullopt;
  return lens.focal_px * x / below;
}

// [Usenko et al. 2018, eq. 46–52].
std::optional<double> DoubleSphereAngle(const Lens& lens, double radius) {
  if (!IsDoubleSphere(lens)) return std::nullopt;
  const double xi = lens.k[0], alpha = lens.k[1], m = radius / lens.focal_px, m2 = m * m;
  const double inside = 1 - (2 * alpha - 1) * m2;
  if (!(inside >= 0)) return std::nullopt;
  const double mz = (1 - alpha * alpha * m2) / (alpha * std::sqrt(inside) + 1 - alpha);
  const double root = mz * mz + (1 - xi * xi) * m2;
  if (!(root >= 0)) return std::nullopt;
  const double scale = (mz * xi + std::sqrt(root)) / (mz * mz + m2);
  return std::atan2(scale * m, scale * mz - xi);
}

bool IsUsable(const Lens& lens) {
  return std::isfinite(lens.focal_px) && lens.focal_px > 0 && std::isfinite(lens.aspect) &&
         lens.aspect > 0;
}

}  // namespace

std::optional<double> RadiusFromAngle(const Lens& lens, double theta) noexcept {
  if (!IsUsable(lens) || !(theta >= 0 && theta <= kPi)) return std::nullopt;
  switch (lens.model) {
    case LensModel::kEquisolid:
      return 2 * lens.focal_px * std::sin(0.5 * theta);
    case LensModel::kKannalaBrandt: {
      if (!RisesUpTo(lens.k, theta)) return std::nullopt;
      const double r = lens.focal_px * KannalaBrandt(lens.k, theta).value;
      return std::isfinite(r) ? std::optional(r) : std::nullopt;
    }
    case LensModel::kDoubleSphere:
      return DoubleSphereRadius(lens, theta);
    case LensModel::kPinhole:
      if (theta > kPi / 2 - kRightAngleMargin) return std::nullopt;
      return lens.focal_px * std::tan(theta);
  }
  return std::nullopt;
}

std::optional<double> AngleFromRadius(const Lens& lens, double radius) noexcept {
  if (!IsUsable(lens) || !(radius >= 0 && std::isfinite(radius))) return std::nullopt;
  switch (lens.model) {
    case LensModel::kEquisolid:
      if (radius > 2 * lens.focal_px) return std::nullopt;
      return 2 * std::asin(radius / (2 * lens.focal_px));
    case LensModel::kKannalaBrandt:
      return KannalaBrandtAngle(lens.k, radius / lens.focal_px);
    case LensModel::kDoubleSphere:
      return DoubleSphereAngle(lens, radius);
    case LensModel::kPinhole:
      return std::atan2(radius, lens.focal_px);
  }
  return std::nullopt;
}

std::optional<glm::dvec2> PixelFromRay(const Lens& lens, const glm::dvec3& ray) noexcept {
  const double across = std::hypot(ray.x, ray.y), length = std::hypot(across, ray.z);
  if (!(length > 0 && std::isfinite(length))) return std::nullopt;
  const auto r = RadiusFromAngle(lens, std::atan2(across, ray.z));
  if (!r) return std::nullopt;
  // A ray on the axis has no direction across it, and needs none.
  const double scale = across > 0 ? *r / across : 0.0;
  return glm::dvec2(lens.cx + ray.x * scale, lens.cy + ray.y * scale / lens.aspect);
}

std::optional<glm::dvec3> RayFromPixel(const Lens& lens, const glm::dvec2& pixel) noexcept {
  const double dx = pixel.x - lens.cx, dy = (pixel.y - lens.cy) * lens.aspect;
  const double r = std::hypot(dx, dy);
  const auto theta = AngleFromRadius(lens, r);
  if (!theta) return std::nullopt;
  const double scale = r > 0 ? std::sin(*theta) / r : 0.0;
  return glm::dvec3(dx * scale, dy * scale, std::cos(*theta));
}

double FocalAtAxis(const Lens& lens) noexcept {
  return lens.model == LensModel::kDoubleSphere ? lens.focal_px / (1 + lens.k[0]) : lens.focal_px;
}

std::optional<double> FieldOfViewOf(const Lens& lens) noexcept {
  double reach = lens.circle.r;
  if (!(reach > 0)) {
    const double x = std::max(lens.cx + 0.5, lens.width - 0.5 - lens.cx);
    const double y = lens.aspect * std::max(lens.cy + 0.5, lens.height - 0.5 - lens.cy);
    reach = std::hypot(x, y);
  }
  const auto theta = AngleFromRadius(lens, reach);
  return theta ? std::optional(2 * *theta) : std::nullopt;
}

}  // namespace arthro
