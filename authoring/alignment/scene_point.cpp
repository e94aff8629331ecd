#include "authoring/alignment/scene_point.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "simulation/core/units.h"
#include "simulation/scene/backdrop/relief_range.h"
#include "simulation/scene/projection.h"

namespace arthro::authoring {
namespace {

constexpr double kMarchStep = 0.25e-3;  // m; folds of a relief are wider
constexpr int kHalvings = 20;           // halvings of a step, to less than a nanometre
// Standard error of a range that brightness or interpolation gave: root mean square at the
// landmarks of three phantoms [benchmarks.md, Alignment]. Brightness knows neither the scale nor
// the origin of the ranges, so most of it is common to all landmarks, and perspective gives a
// better one.
constexpr double kGuessedSigma = 12e-3;
// Standard error of an imported or measured relief that states none [benchmarks.md, Relief].
constexpr double kUnstatedSigma = 0.5e-3;

// Range from the eye at which the line meets the relief; NaN where it meets none.
double RangeOf(const LoadedScene& scene, const Sight& sight) {
  const Backdrop& backdrop = scene.scene.backdrop;
  const DepthMap& depth = OrEmpty(scene.depth);
  // Height over the relief, towards the portal; NaN where nothing was imaged.
  const auto height = [&](double range) {
    const glm::dvec3 x = sight.eye + range * sight.direction;
    const double radius = glm::length(x);
    if (!(radius > 0)) return backdrop.radius;
    return ReliefRange(x / radius, depth, backdrop) - radius;
  };
  double free = std::nan("");  // range of the last place in front of the relief
  // The far side of the sphere, from an eye inside or outside of it.
  const double last = glm::length(sight.eye) + backdrop.radius + kMarchStep;
  for (double range = 0; range <= last; range += kMarchStep) {
    const double now = height(range);
    if (std::isnan(now)) {
      free = std::nan("");  // a surface behind a hole is uncertain
    } else if (now > 0) {
      free = range;
    } else if (!std::isnan(free)) {
      double low = free, high = range;
      for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (low + high);
        (height(middle) > 0 ? low : high) = middle;
      }
      return high;
    }
  }
  return std::nan("");
}

struct StatedError {
  double sigma = kUnstatedSigma;  // m
  bool is_guessed = false;
};

StatedError ErrorTowards(const LoadedScene& scene, const glm::dvec3& direction,
                         ReliefOrigin unstated) {
  const DepthMap &depth = OrEmpty(scene.depth), &sigma = OrEmpty(scene.depth_sigma);
  if (depth.empty()) return {kGuessedSigma, true};  // a bare sphere
  const auto pixel = PixelFromDirection(scene.scene.backdrop.projection, direction);
  if (!pixel) return {kGuessedSigma, true};
  const int u = std::clamp(static_cast<int>(std::lround(pixel->x)), 0, depth.width - 1);
  const int v = std::clamp(static_cast<int>(std::lround(pixel->y)), 0, depth.height - 1);
  StatedError error;
  const OriginMap& origins = OrEmpty(scene.depth_origin);
  error.is_guessed = (origins.empty() ? unstated : origins.at(u, v)) != ReliefOrigin::kMeasured;
  if (error.is_guessed) error.sigma = kGuessedSigma;
  if (!sigma.empty() && std::isfinite(sigma.at(u, v)))
    error.sigma = std::max(static_cast<double>(sigma.at(u, v)), error.is_guessed ? error.sigma : 0);
  return error;
}

// Two unit directions across a line of sight.
std::pair<glm::dvec3, glm::dvec3> AcrossOf(const glm::dvec3& direction) {
  const glm::dvec3 other = std::abs(direction.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 first = glm::normalize(glm::cross(direction, other));
  return {first, glm::cross(direction, first)};
}

}  // namespace

Sight SightOfPanorama(const Backdrop& backdrop, const glm::dvec2& pixel) {
  const glm::dvec3 direction = DirectionFromPixel(backdrop.projection, pixel);
  // Pixels per radian: geometric mean over both directions across the line.
  const auto [first, second] = AcrossOf(direction);
  const glm::dmat2x3 gradients = PixelGradients(backdrop.projection, direction);
  const auto along = [&](const glm::dvec3& across) {
    return glm::dvec2(glm::dot(gradients[0], across), glm::dot(gradients[1], across));
  };
  const glm::dvec2 a = along(first), b = along(second);
  return {glm::dvec3(0.0), direction, std::sqrt(std::abs(a.x * b.y - a.y * b.x))};
}

std::optional<Sight> SightOfScope(const simulation::ScopeOptics& optics,
                                  const simulation::ScopeView& view, int size,
                                  const glm::dvec2& pixel) {
  const double radius = 0.5 * size;
  const glm::dvec2 place((pixel.x - 0.5 * (size - 1)) / radius,
                         (0.5 * (size - 1) - pixel.y) / radius);
  if (!(glm::length(place) <= 1.0)) return std::nullopt;
  const glm::dvec3 direction = glm::normalize(simulation::RayThrough(optics, view, place));
  const auto [first, second] = AcrossOf(direction);
  constexpr double kSmall = 1e-4;  // rad
  const auto along = [&](const glm::dvec3& across) {
    return (simulation::PlaceOf(optics, view, direction + kSmall * across) -
            simulation::PlaceOf(optics, view, direction - kSmall * across)) *
           (radius / (2 * kSmall));
  };
  const glm::dvec2 a = along(first), b = along(second);
  return Sight{view.tip, direction, std::sqrt(std::abs(a.x * b.y - a.y * b.x))};
}

std::optional<ScenePoint> PointOnRelief(const LoadedScene& scene, const Sight& sight,
                                        ReliefOrigin unstated) {
  const double range = RangeOf(scene, sight);
  if (std::isnan(range)) return std::nullopt;
  ScenePoint point;
  point.eye = sight.eye;
  point.x_in_portal = sight.eye + range * sight.direction;
  point.px_per_radian = sight.px_per_radian;
  const double angle = sight.px_per_radian > 0 ? kClickSigma / sight.px_per_radian : 0;
  point.lateral_sigma = range * angle;
  const StatedError stated = ErrorTowards(scene, glm::normalize(point.x_in_portal), unstated);
  point.is_guessed = stated.is_guessed;

  // Slopes and edges: mean square change of the range around the click.
  const auto [first, second] = AcrossOf(sight.direction);
  double sum = 0;
  int count = 0;
  constexpr int kAround = 8;
  for (int i = 0; i < kAround; ++i) {
    const double turn = 2 * std::numbers::pi * i / kAround;
    Sight beside = sight;
    beside.direction = glm::normalize(sight.direction +
                                      angle * (std::cos(turn) * first + std::sin(turn) * second));
    const double change = RangeOf(scene, beside) - range;
    if (std::isnan(change)) continue;
    sum += change * change;
    ++count;
  }
  point.range_sigma = std::hypot(stated.sigma, count > 0 ? std::sqrt(sum / count) : 0.0);
  return point;
}

std::optional<double> ResidualPx(const ScenePoint& point, const glm::dvec3& x_in_portal) {
  if (!(point.px_per_radian > 0)) return std::nullopt;
  const glm::dvec3 a = point.x_in_portal - point.eye, b = x_in_portal - point.eye;
  return point.px_per_radian * std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace arthro::authoring
