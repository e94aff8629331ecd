#include "simulation/scope/window_lens.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "simulation/core/error.h"
#include "simulation/core/units.h"

namespace arthro::simulation {
namespace {

using Terms = std::array<double, WindowLens::kTerms>;

// Interpolates f by a polynomial in s at the Chebyshev nodes of 0 to `end`: divided differences,
// then expansion into powers.
template <class F>
Terms Through(double end, F&& f) {
  constexpr int n = WindowLens::kTerms;
  Terms s{}, difference{};
  for (int i = 0; i < n; ++i) {
    s[i] = 0.5 * end * (1.0 - std::cos(std::numbers::pi * (i + 0.5) / n));
    difference[i] = f(s[i]);
  }
  for (int order = 1; order < n; ++order)
    for (int i = n - 1; i >= order; --i)
      difference[i] = (difference[i] - difference[i - 1]) / (s[i] - s[i - order]);
  Terms terms{};
  for (int i = n - 1; i >= 0; --i) {
    for (int k = n - 1; k > 0; --k) terms[k] = terms[k - 1] - s[i] * terms[k];
    terms[0] = difference[i] - s[i] * terms[0];
  }
  return terms;
}

}  // namespace

double LensFactor(const Terms& factor, double squared) noexcept {
  double sum = 0.0;
  for (int k = WindowLens::kTerms - 1; k >= 0; --k) sum = sum * squared + factor[k];
  return sum;
}

double WindowFieldOfView(const Lens& lens) {
  if (lens.field_of_view > 0.0) return lens.field_of_view;
  const auto field = FieldOfViewOf(lens);
  if (!field)
    throw Error(Code::kBadData,
                "the lens ends within its own picture; give it a circle or a field of view");
  return *field;
}

WindowLens FitWindowLens(const Lens& lens, double field_of_view) {
  const auto rim = RadiusFromAngle(lens, 0.5 * field_of_view);
  if (!rim || !(*rim > 0.0))
    throw Error(Code::kBadData,
                fmt::format("the lens ends within a field of view of {:.1f} degrees; choose a "
                            "smaller one",
                            DegreesFromRadians(field_of_view)));
  WindowLens window;
  double radius = *rim;  // px
  if (lens.circle.r > 0.0) {
    if (std::abs(field_of_view - WindowFieldOfView(lens)) < 1e-9) radius = lens.circle.r;
    window.axis =
        glm::dvec2(lens.cx - lens.circle.cx, lens.aspect * (lens.circle.cy - lens.cy)) / radius;
  }
  const double scale = std::sin(0.25 * field_of_view);
  const auto equisolid = [&](double r) -> std::optional<double> {
    const auto theta = AngleFromRadius(lens, r * radius);
    if (!theta) return std::nullopt;
    return std::sin(0.5 * *theta) / scale;
  };
  // Fits up to the point of the rim that is furthest from the axis, and slightly beyond where the
  // lens extends so far.
  const double furthest = 1.0 + glm::length(window.axis);
  double reach = furthest;
  for (const double more : {1.25, 1.1, 1.03})
    if (equisolid(more * furthest)) {
      reach = more * furthest;
      break;
    }
  if (!equisolid(reach))
    throw Error(Code::kBadData, "the lens ends within its round window; mend its circle");
  const double q_reach = *equisolid(reach);
  window.end = std::min(reach * reach, q_reach * q_reach);
  window.inward =
      Through(reach * reach, [&](double s) { return *equisolid(std::sqrt(s)) / std::sqrt(s); });
  window.outward = Through(q_reach * q_reach, [&](double s) {
    const double theta = 2.0 * std::asin(std::min(std::sqrt(s) * scale, 1.0));
    return RadiusFromAngle(lens, theta).value_or(reach * radius) / radius / std::sqrt(s);
  });
  double worst = 0.0;
  constexpr int kChecked = 400;
  for (int i = 1; i <= kChecked; ++i) {
    const double r = furthest * i / kChecked, q = *equisolid(r);
    worst = std::max({worst, std::abs(r * LensFactor(window.inward, r * r) - q),
                      std::abs(q * LensFactor(window.outward, q * q) - r)});
  }
  if (!(worst <= kWindowLensError))
    throw Error(Code::kBadData,
                fmt::format("the lens bends too much at the rim of {:.1f} degrees to be drawn (off "
                            "by {:.2g} of the window's radius); choose a smaller field of view",
                            DegreesFromRadians(field_of_view), worst));
  return window;
}

ScopeOptics OpticsOf(const ScopeSpec& scope, const std::optional<Lens>& lens,
                     std::optional<double> field_of_view) {
  if (!lens) return {field_of_view.value_or(scope.field_of_view), {}, {}};
  try {
    const double field = field_of_view ? *field_of_view : WindowFieldOfView(*lens);
    return {field, FitWindowLens(*lens, field), lens->camera};
  } catch (const Error& error) {
    throw Error(error.code(),
                "scope.lens, " + scope.lens.generic_string() + ": " + error.sentence());
  }
}

glm::dvec3 RayThrough(const ScopeOptics& optics, const ScopeView& view,
                      const glm::dvec2& place) noexcept {
  const glm::dvec2 offset = place - optics.lens.axis;
  const double squared = std::min(glm::dot(offset, offset), optics.lens.end);
  // Equal-area: with s = sin(θ/2), cos θ = 1 − 2 s² and sin θ = 2 s √(1 − s²).
  const glm::dvec2 s =
      LensFactor(optics.lens.inward, squared) * std::sin(0.25 * optics.field_of_view) * offset;
  const double s2 = std::min(glm::dot(s, s), 1.0);
  const glm::dvec2 across = 2.0 * std::sqrt(1.0 - s2) * s;
  return across.x * view.right + across.y * view.up + (1.0 - 2.0 * s2) * view.view;
}

glm::dvec2 PlaceOf(const ScopeOptics& optics, const ScopeView& view,
                   const glm::dvec3& direction) noexcept {
  const glm::dvec2 across(glm::dot(direction, view.right), glm::dot(direction, view.up));
  const double length = glm::length(across);
  if (!(length > 0.0)) return optics.lens.axis;
  const double theta = std::atan2(length, glm::dot(direction, view.view));
  const double q = std::sin(0.5 * theta) / std::sin(0.25 * optics.field_of_view);
  const double r = q * LensFactor(optics.lens.outward, std::min(q * q, optics.lens.end));
  return optics.lens.axis + (r / length) * across;
}

}  // namespace arthro::simulation
