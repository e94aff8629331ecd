#include "simulation/tissue/body/elastic_layer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "simulation/core/error.h"

namespace arthro::simulation {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSmallest = 0.01, kLargest = 10.0;  // contact radius / thickness

// Returns the compliance of a bonded layer relative to a half space under pressure of wave number
// k/h, frictionless on top: w = (1−ν)/μ · M(k) h/k · p [Jaffar 1989, eq. 6], κ = 3 − 4ν. Multiplied
// through by exp(−2k) to avoid overflow. k → 0: foundation; k → ∞: 1.
double LayerFactor(double k, double nu) {
  const double kappa = 3 - 4 * nu, e = std::exp(-2 * k);
  return (kappa * (1 - e * e) - 4 * k * e) /
         (kappa * (1 + e * e) + (kappa * kappa + 1 + 4 * k * k) * e);
}

// ∫₀^∞ (1 − M(k)) cos(k y) dk by Simpson's rule. 1 − M falls as k² exp(−2k): below 1e-14 at k = 20.
class LayerKernel {
 public:
  explicit LayerKernel(double nu) {
    for (int i = 0; i <= kPoints; ++i) {
      const double weight = i == 0 || i == kPoints ? 1 : i % 2 == 1 ? 4 : 2;
      share_.push_back(weight * kStep / 3 * (1 - LayerFactor(i * kStep, nu)));
    }
  }
  double At(double y) const {
    double sum = 0;
    for (int i = 0; i <= kPoints; ++i)
      sum += share_[static_cast<std::size_t>(i)] * std::cos(i * kStep * y);
    return sum;
  }

 private:
  // Simpson's error is step⁴ / 180 times the third derivative at 0, about y²: 8e-7 at y = 20.
  static constexpr int kPoints = 800;
  static constexpr double kStep = 20.0 / kPoints;
  std::vector<double> share_;
};

// Contact of radius x (lengths over the thickness): force per depth of a flat end; depth and force
// of a ball.
struct Contact {
  double kappa, depth, force;
};

// Solves Lebedev & Ufliand's equation φ(s) − 1/π ∫₋ₓˣ H(s−t) φ(t) dt = G(s), φ even, by Simpson's
// rule. G = 1 is a flat end, G = s² the addition of a paraboloid. The pressure of a ball ends at
// zero, φ(x) = 0, which determines the depth for this contact radius.
Contact Solve(const LayerKernel& kernel, double x) {
  constexpr int kCells = 40;
  const double step = x / kCells;
  std::array<double, 2 * kCells + 1> h{};
  for (int i = 0; i <= 2 * kCells; ++i) h[static_cast<std::size_t>(i)] = kernel.At(i * step);
  Eigen::VectorXd weight(kCells + 1);
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(kCells + 1, kCells + 1), g(kCells + 1, 2);
  for (int j = 0; j <= kCells; ++j)
    weight[j] = step / 3 * (j == 0 || j == kCells ? 1 : j % 2 == 1 ? 4 : 2);
  for (int i = 0; i <= kCells; ++i) {
    for (int j = 0; j <= kCells; ++j)
      a(i, j) -= weight[j] / kPi *
                 (h[static_cast<std::size_t>(std::abs(i - j))] +
                  h[static_cast<std::size_t>(i) + static_cast<std::size_t>(j)]);
    g(i, 0) = 1;
    g(i, 1) = i * step * i * step;
  }
  const Eigen::MatrixXd phi = a.partialPivLu().solve(g);
  const double flat = weight.dot(phi.col(0)), depth = phi(kCells, 1) / phi(kCells, 0);
  return {flat / x, depth, depth * flat - weight.dot(phi.col(1))};
}

// Depth under a line load, relative to −ln|y| of a half plane: ½ ln(1 + y²) + ∫₀^∞ (M(k) − 1 +
// exp(−k))/k cos(k y) dk, lengths over the thickness. Sampled, with cubic interpolation.
class LineKernel {
 public:
  explicit LineKernel(double nu) {
    std::vector<double> share;
    for (int i = 0; i <= kPoints; ++i) {
      const double weight = i == 0 || i == kPoints ? 1 : i % 2 == 1 ? 4 : 2;
      const double k = std::max(i * kStep, 1e-3);  // finite limit at 0, but cancellation
      share.push_back(weight * kStep / 3 * (LayerFactor(k, nu) - 1 + std::exp(-k)) / k);
    }
    for (int j = 0; j <= kSpan * kPerUnit + 1; ++j) {
      const double y = static_cast<double>(j) / kPerUnit;
      double sum = 0.5 * std::log1p(y * y);
      for (int i = 0; i <= kPoints; ++i)
        sum += share[static_cast<std::size_t>(i)] * std::cos(i * kStep * y);
      at_.push_back(sum);
    }
  }
  double At(double y) const {
    const double place = std::abs(y) * kPerUnit;
    const auto j = std::min(static_cast<std::size_t>(place), at_.size() - 2);
    const double t = place - static_cast<double>(j);
    // Even in y: the sample before the first equals the second.
    const double before = at_[j == 0 ? 1 : j - 1], a = at_[j], b = at_[j + 1];
    const double after = j + 2 < at_.size() ? at_[j + 2] : 2 * b - a;
    return a + 0.5 * t *
                   (b - before +
                    t * (2 * before - 5 * a + 4 * b - after + t * (3 * (a - b) + after - before)));
  }

 private:
  static constexpr int kPoints = 1200, kSpan = 20, kPerUnit = 20;
  static constexpr double kStep = 30.0 / kPoints;
  std::vector<double> at_;
};

// Solves a contact of half width x: force per depth of a flat strip, depth and force of a parabola.
// Pressure Σ cₙ T₂ₙ(t)/√(1−t²), t over the half width: −ln|t − s| maps T₂ₙ to π/2n T₂ₙ. The rest of
// the kernel is smooth and uses Gauss-Chebyshev quadrature.
Contact SolveLine(const LineKernel& kernel, double x) {
  constexpr int kTerms = 16, kNodes = 48;
  const auto chebyshev = [](int n, double angle) { return std::cos(2 * n * angle); };
  Eigen::MatrixXd a(kTerms, kTerms), g(kTerms, 2);
  for (int i = 0; i < kTerms; ++i) {
    const double angle = (2 * i + 1) * kPi / (4 * kTerms), s = std::cos(angle);
    for (int n = 0; n < kTerms; ++n)
      a(i, n) = x * kPi * (n == 0 ? std::log(2.0) - std::log(x) : chebyshev(n, angle) / (2 * n));
    for (int j = 0; j < kNodes; ++j) {
      const double at = (2 * j + 1) * kPi / (2 * kNodes);
      const double smooth = x * kPi / kNodes * kernel.At(x * (s - std::cos(at)));
      for (int n = 0; n < kTerms; ++n) a(i, n) += smooth * chebyshev(n, at);
    }
    g(i, 0) = 1;
    g(i, 1) = 0.5 * x * x * s * s;
  }
  const Eigen::MatrixXd c = a.partialPivLu().solve(g);
  // No pressure at the edge: Σ cₙ = 0.
  const double depth = c.col(1).sum() / c.col(0).sum(), flat = x * kPi * c(0, 0);
  return {flat, depth, depth * flat - x * kPi * c(0, 1)};
}

struct Value {
  double y, slope;
};

// Evaluates the cubic through two samples with their slopes.
Value Hermite(double x0, double x1, double y0, double y1, double s0, double s1, double x) {
  const double width = x1 - x0, t = (x - x0) / width, rise = (y1 - y0) / width;
  const double a = s0 + s1 - 2 * rise, b = 3 * rise - 2 * s0 - s1;
  return {y0 + width * t * (s0 + t * (b + t * a)), s0 + t * (2 * b + t * 3 * a)};
}

// Evaluates the curve at x; outside its samples a straight line with slope `before` or the last
// slope.
template <class Curve>
Value At(const Curve& xs, const Curve& ys, const Curve& slopes, double before, double x) {
  if (x <= xs.front()) return {ys.front() + before * (x - xs.front()), before};
  if (x >= xs.back()) return {ys.back() + slopes.back() * (x - xs.back()), slopes.back()};
  const auto i = static_cast<std::size_t>(std::upper_bound(xs.begin(), xs.end(), x) - xs.begin());
  return Hermite(xs[i - 1], xs[i], ys[i - 1], ys[i], slopes[i - 1], slopes[i], x);
}

// Estimates unknown slopes of samples from the parabola through the neighbours.
template <class Curve>
Curve EstimateSlopes(const Curve& xs, const Curve& ys) {
  Curve slopes{};
  for (std::size_t i = 0; i < xs.size(); ++i) {
    const std::size_t m = std::clamp<std::size_t>(i, 1, xs.size() - 2);
    const double left = (ys[m] - ys[m - 1]) / (xs[m] - xs[m - 1]);
    const double right = (ys[m + 1] - ys[m]) / (xs[m + 1] - xs[m]);
    const double bend = (right - left) / (xs[m + 1] - xs[m - 1]);
    slopes[i] = left + bend * (2 * xs[i] - xs[m - 1] - xs[m]);
  }
  return slopes;
}

// Ball on a half space at depth d (over its radius), compared with the paraboloid of the same
// curvature: force over Hertz's with its derivative by d, and contact radius over Hertz's. [Sneddon
// 1965]: d = e atanh e, F ~ (1 + e²) atanh e − e, e the contact's radius over the ball's; Hertz: e²
// = d, F ~ 4/3 d^1.5.
struct Roundness {
  double force = 1, slope = -0.1, radius = 1;
};
Roundness RoundnessAt(double d) {
  if (d < 1e-4) return {1 - 0.1 * d, -0.1, 1 - d / 6};  // the next terms are d²
  const double hertz = 4.0 / 3 * d * std::sqrt(d);
  if (d > 8)  // the contact has the ball's full width to 1e-7: e = 1
    return {(2 * d - 1) / hertz, (2 - (2 * d - 1) * 1.5 / d) / hertz, 1 / std::sqrt(d)};
  // Newton's method from above, where the function is convex: eight steps reach rounding.
  double e = std::min(std::sqrt(d), std::tanh(d / std::tanh(d)));
  for (int i = 0; i < 8; ++i) {
    const double turn = std::atanh(e);
    e -= (e * turn - d) / (turn + e / (1 - e * e));
  }
  const double ball = (1 + e * e) * std::atanh(e) - e;
  return {ball / hertz, (2 * e - ball * 1.5 / d) / hertz, e / std::sqrt(d)};
}

bool IsPressed(double radius, double amount) {
  return std::isfinite(radius) && std::isfinite(amount) && radius > 0 && amount > 0;
}

}  // namespace

ElasticLayer::ElasticLayer(const Material& material, double thickness) : thickness_(thickness) {
  const double e = material.young_modulus, nu = material.poisson_ratio;
  if (!std::isfinite(thickness) || thickness <= 0)
    throw Error(
        Code::kBadArgument,
        fmt::format("an elastic layer is {} m thick; give it a thickness above 0", thickness));
  if (!std::isfinite(e) || e <= 0 || !(nu > -1 && nu < 0.5))
    throw Error(
        Code::kBadArgument,
        fmt::format("an elastic layer has Young's modulus {} Pa and Poisson's ratio {}; the "
                    "modulus is above 0 and the ratio from -1 to below 0.5",
                    e, nu));
  const auto [mu, lambda] = LameOf(material);
  foundation_ = (lambda + 2 * mu) / thickness;
  flat_unit_ = 4 * mu * thickness / (1 - nu);

  const LayerKernel kernel(nu);
  for (std::size_t i = 0; i < kSamples; ++i) {
    const double share = static_cast<double>(i) / (kSamples - 1);
    const double x = kSmallest * std::pow(kLargest / kSmallest, share);
    const Contact contact = Solve(kernel, x);
    log_radius_[i] = std::log(x);
    log_kappa_[i] = std::log(contact.kappa);
    log_depth_[i] = std::log(contact.depth);
    log_force_[i] = std::log(contact.force);
    // For a small increase of depth, a ball acts like a flat end of the contact's size.
    force_slope_[i] = x * contact.kappa * contact.depth / contact.force;
  }
  line_unit_ = kPi * mu / (1 - nu);
  const LineKernel line_kernel(nu);
  for (std::size_t i = 0; i < kSamples; ++i) {
    const Contact line = SolveLine(line_kernel, std::exp(log_radius_[i]));
    log_line_depth_[i] = std::log(line.depth);
    log_line_force_[i] = std::log(line.force);
    line_force_slope_[i] = line.kappa * line.depth / line.force;
  }
  line_radius_slope_ = EstimateSlopes(log_line_depth_, log_radius_);
  kappa_slope_ = EstimateSlopes(log_radius_, log_kappa_);
  radius_slope_ = EstimateSlopes(log_depth_, log_radius_);
}

LayerTouch ElasticLayer::PressFlat(double radius, double depth) const noexcept {
  if (!IsPressed(radius, depth)) return {};
  const double x = radius / thickness_;
  const double kappa = std::exp(At(log_radius_, log_kappa_, kappa_slope_, 0, std::log(x)).y);
  const double stiffness = flat_unit_ * x * kappa;
  return {stiffness * depth, stiffness, radius, depth > kDeepShare * thickness_};
}

double ElasticLayer::FlatDepth(double radius, double force) const noexcept {
  if (!IsPressed(radius, force)) return 0;
  return force / PressFlat(radius, thickness_).stiffness;
}

LayerTouch ElasticLayer::PressBall(double radius, double depth) const noexcept {
  if (!IsPressed(radius, depth)) return {};
  const double log_depth = std::log(depth / thickness_ * (radius / thickness_));
  // Before the first sample: Hertz, F ~ δ^1.5 and a ~ δ^0.5.
  const Value force = At(log_depth_, log_force_, force_slope_, 1.5, log_depth);
  const Value touch = At(log_depth_, log_radius_, radius_slope_, 0.5, log_depth);
  const Roundness round = RoundnessAt(depth / radius);
  const double paraboloid = flat_unit_ * thickness_ * (thickness_ / radius) * std::exp(force.y);
  return {paraboloid * round.force,
          paraboloid * (force.slope / depth * round.force + round.slope / radius),
          thickness_ * std::exp(touch.y) * round.radius,
          depth > kDeepShare * thickness_ || depth > kDeepBallShare * radius};
}

LayerTouch ElasticLayer::PressLine(double radius, double depth) const noexcept {
  if (!IsPressed(radius, depth)) return {};
  const double log_depth = std::log(depth / thickness_ * (radius / thickness_));
  const Value force =
      At(log_line_depth_, log_line_force_, line_force_slope_, line_force_slope_.front(), log_depth);
  const Value touch =
      At(log_line_depth_, log_radius_, line_radius_slope_, line_radius_slope_.front(), log_depth);
  const double per_length = line_unit_ * thickness_ * (thickness_ / radius) * std::exp(force.y);
  return {per_length, per_length * force.slope / depth, thickness_ * std::exp(touch.y),
          depth > kDeepShare * thickness_ || depth > kDeepBallShare * radius};
}

double ElasticLayer::BallDepth(double radius, double force) const noexcept {
  if (!IsPressed(radius, force)) return 0;
  // Bisects, because the force rises everywhere; 70 halvings of a span of 80 (in the logarithm)
  // reach rounding.
  double low = std::log(thickness_) - 70, high = std::log(thickness_) + 10;
  for (int i = 0; i < 70; ++i) {
    const double middle = 0.5 * (low + high);
    (PressBall(radius, std::exp(middle)).force < force ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

}  // namespace arthro::simulation
