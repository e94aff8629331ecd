#include "app/view/disturbances/drifting_bits.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <glm/geometric.hpp>

#include "simulation/core/random.h"

namespace arthro::app {
namespace {

constexpr double kBox = 14e-3;   // m, side of the periodic box of fluid
constexpr double kAhead = 6e-3;  // m from the lens to the middle of the box
constexpr double kTooNear =
    1.6e-3;  // m; nothing drifts nearer, since one bit would fill the window
constexpr double kDepthOfField = 8e-3;  // m; nearer bits are out of focus
constexpr int kLensEvery = 4;           // one bubble of so many sticks to the lens

// Random numbers of one bit, which do not depend on the number of the others.
Random NumbersOf(int seed, int kind, int index) {
  const auto mixed = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(seed)) << 20) ^
                     (static_cast<std::uint64_t>(kind) << 12) ^ static_cast<std::uint64_t>(index);
  return Random(mixed * 0x9E3779B97F4A7C15u + 1);
}

double Share(Random& own) { return own.Uniform(0.0, 1.0); }

glm::dvec3 SharesOfEach(Random& own) {
  glm::dvec3 shares;
  for (int c = 0; c < 3; ++c) shares[c] = Share(own);
  return shares;
}

double Wrapped(double x) { return x - kBox * std::floor(x / kBox + 0.5); }

// Returns the image of a point of the periodic fluid; it fades out towards the ends of the box.
std::optional<DriftingBit> Seen(const glm::dvec3& place, double radius,
                                const simulation::ScopeView& view, double field_of_view,
                                const simulation::WindowLens& lens) {
  const glm::dvec3 middle = view.tip + kAhead * view.view;
  glm::dvec3 from_middle = place - middle;
  double opacity = 1;
  for (int c = 0; c < 3; ++c) {
    from_middle[c] = Wrapped(from_middle[c]);
    opacity *= std::clamp((0.5 * kBox - std::abs(from_middle[c])) / 2e-3, 0.0, 1.0);
  }
  const glm::dvec3 ray = from_middle + kAhead * view.view;
  const double distance = glm::length(ray);
  opacity *= std::clamp((distance - kTooNear) / 1.5e-3, 0.0, 1.0);
  if (!(opacity > 0.0)) return std::nullopt;
  const double cosine = glm::dot(ray, view.view) / distance;
  if (cosine < -0.2) return std::nullopt;
  DriftingBit bit;
  const glm::dvec2 pixel = simulation::PixelFromRay({field_of_view, {0, 0}, 1.0}, view, ray);
  const double bend =
      simulation::LensFactor(lens.outward, std::min(glm::dot(pixel, pixel), lens.end));
  bit.centre = lens.axis + bend * glm::dvec2(pixel.x, -pixel.y);
  bit.radius = bend * radius / (2.0 * std::sin(field_of_view / 4.0) * distance);
  bit.distance = distance;
  bit.opacity = opacity;
  bit.softness = std::clamp(0.5 * (kDepthOfField / distance - 1.0), 0.0, 1.2);
  if (glm::length(bit.centre) > 1.0 + bit.radius * (1.0 + bit.softness)) return std::nullopt;
  return bit;
}

void SortFarthestFirst(std::vector<DriftingBit>& bits) {
  std::ranges::stable_sort(bits,
                           [](const auto& a, const auto& b) { return a.distance > b.distance; });
}

// A bubble on the lens, near the rim and mostly above, that slides slowly up in the picture's
// frame.
DriftingBit OnTheLens(Random& own, double time) {
  DriftingBit bit;
  const double side = Share(own), out = 0.5 + 0.42 * Share(own);
  const double angle = std::numbers::pi * (0.5 + 1.25 * (2.0 * side - 1.0) * (0.3 + 0.7 * side));
  bit.centre = out * glm::dvec2(std::cos(angle), std::sin(angle));
  const double size = Share(own);
  bit.radius = 0.05 + 0.15 * size * size;
  bit.centre +=
      0.012 * glm::dvec2(std::sin(0.23 * time + 9.0 * side), std::sin(0.31 * time + 5.0 * out));
  bit.distance = 1e-3;
  bit.softness = 0.16;
  return bit;
}

// A kind of bits that the inflow carries: number of the kind, lowest shape number (fibres have
// those below kFibreShare), smallest radius and range of the radii, m, and how soft and opaque they
// are.
struct BitKind {
  int number;
  double least_shape;
  double fibre, fibre_range, flake, flake_range;
  double least_softness, opacity;
};
constexpr BitKind kFlakes{2, 0.0, 0.5e-3, 1.1e-3, 0.12e-3, 0.7e-3, 0.0, 1.0};
// So small that light goes through them.
constexpr BitKind kFlecks{3, 0.37, 0.2e-3, 0.4e-3, 0.05e-3, 0.12e-3, 0.6, 0.6};

std::vector<DriftingBit> Drifting(const BitKind& kind, int count, const Disturbances& disturbances,
                                  const simulation::ScopeView& view, double field_of_view,
                                  const simulation::WindowLens& lens) {
  std::vector<DriftingBit> bits;
  const double t = disturbances.time;
  for (int i = 0; i < count; ++i) {
    Random own = NumbersOf(disturbances.seed, kind.number, i);
    const glm::dvec3 start = kBox * SharesOfEach(own);
    const glm::dvec3 way = SharesOfEach(own) - 0.5;
    const double phase = 6.28 * Share(own), size = Share(own),
                 shape = kind.least_shape + (1.0 - kind.least_shape) * Share(own);
    // The inflow carries all bits, each with a small deviation and the oscillation of the eddies.
    const glm::dvec3 drift = (glm::dvec3(0.9e-3, -0.25e-3, 0.5e-3) + 1.6e-3 * way) * t +
                             0.7e-3 * std::sin(0.6 * t + phase) * glm::dvec3(way.y, way.z, way.x);
    const bool is_fibre = shape < kFibreShare;
    const double radius = is_fibre ? kind.fibre + kind.fibre_range * size
                                   : kind.flake + kind.flake_range * size * size * size;
    auto bit = Seen(start + drift, radius, view, field_of_view, lens);
    if (!bit) continue;
    bit->angle = phase + (0.5 * way.x + 0.1) * t;
    bit->shape = shape;
    bit->softness = std::max(bit->softness, kind.least_softness);
    // Defocus spreads the light of a bit.
    bit->opacity *= kind.opacity / (1.0 + 2.0 * bit->softness);
    bits.push_back(*bit);
  }
  SortFarthestFirst(bits);
  return bits;
}

}  // namespace

int BubbleCount(double strength) { return static_cast<int>(std::ceil(strength * kMostBubbles)); }
int FlakeCount(double strength) { return static_cast<int>(std::ceil(strength * kMostFlakes)); }
int FleckCount(double share) { return FlakeCount(share); }

std::vector<DriftingBit> Bubbles(const Disturbances& disturbances,
                                 const simulation::ScopeView& view, double field_of_view,
                                 const simulation::WindowLens& lens) {
  std::vector<DriftingBit> bits;
  const double t = disturbances.time;
  for (int i = 0; i < BubbleCount(disturbances.bubbles); ++i) {
    Random own = NumbersOf(disturbances.seed, 1, i);
    std::optional<DriftingBit> bit;
    if (i % kLensEvery == kLensEvery - 1) {
      bit = OnTheLens(own, t);
    } else {
      const glm::dvec3 start = kBox * SharesOfEach(own);
      const double size = Share(own);
      const double radius = 0.3e-3 + 0.9e-3 * size * size;
      // Larger bubbles rise faster; −y is up.
      const double rise = 2e-3 + 5e-3 * size, phase = 6.28 * Share(own);
      const double sway = 0.4e-3 * std::sin(2.1 * t + phase);
      bit =
          Seen(start + glm::dvec3(sway, -rise * t, 0.6 * sway), radius, view, field_of_view, lens);
      if (bit) bit->softness *= 0.35;  // the rim, by which a bubble is recognised, stays sharp
    }
    const double shape = Share(own);
    if (!bit) continue;
    bit->shape = shape;
    bits.push_back(*bit);
  }
  SortFarthestFirst(bits);
  return bits;
}

std::vector<DriftingBit> Flakes(const Disturbances& disturbances, const simulation::ScopeView& view,
                                double field_of_view, const simulation::WindowLens& lens) {
  return Drifting(kFlakes, FlakeCount(disturbances.debris), disturbances, view, field_of_view,
                  lens);
}

std::vector<DriftingBit> Flecks(double share, const Disturbances& disturbances,
                                const simulation::ScopeView& view, double field_of_view,
                                const simulation::WindowLens& lens) {
  return Drifting(kFlecks, FleckCount(share), disturbances, view, field_of_view, lens);
}

}  // namespace arthro::app
