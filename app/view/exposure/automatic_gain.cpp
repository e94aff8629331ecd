#include "app/view/exposure/automatic_gain.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

namespace arthro::app {
namespace {

constexpr int kAcross = 16;  // rays across the window
constexpr int kPlaces = MeteredModels::kAcross / kAcross;
constexpr int kSteps = 16;      // steps along a ray
constexpr double kSoft = 0.03;  // depth of partial occlusion, radii of the backdrop

// Returns the weight of a pixel inside the picture, which falls to 0 over a block.
double Inside(const LightGrid& grid, const glm::dvec2& pixel) {
  const glm::dvec2 end = grid.block_px * glm::dvec2(grid.width, grid.height) - pixel;
  return std::clamp(1.0 + std::min({pixel.x, pixel.y, end.x, end.y}) / grid.block_px.x, 0.0, 1.0);
}

struct Light {
  double squares = 0, share = 0;
  void Add(const Light& other, double weight) {
    squares += weight * other.squares;
    share += weight * other.share;
  }
};

// Light of the backdrop along a ray, accumulated up to each step.
struct RayLight {
  std::array<double, kSteps + 1> way{}, clear{};  // m; share of the ray that is not occluded
  std::array<Light, kSteps + 1> light{};          // sum over all steps before

  // Returns the light up to a distance, and the share of the ray that is left there.
  Light Before(double distance, double& left) const {
    const auto after = std::upper_bound(way.begin(), way.end(), distance);
    if (after == way.end() || after == way.begin()) {
      const bool is_end = after == way.end();
      left = is_end ? clear.back() : 1.0;
      return is_end ? light.back() : Light();
    }
    const auto k = static_cast<std::size_t>(after - way.begin());
    const double f = (distance - way[k - 1]) / (way[k] - way[k - 1]);
    left = (1 - f) * clear[k - 1] + f * clear[k];
    Light sum;
    sum.Add(light[k - 1], 1 - f);
    sum.Add(light[k], f);
    return sum;
  }
};

class Meter {
 public:
  Meter(const LightGrid& grid, const Backdrop& backdrop, double light_reach)
      : grid_(grid), backdrop_(backdrop), reach2_(light_reach * light_reach) {}

  double Lamp(double distance) const {
    return reach2_ / (distance * distance + kLampRadius * kLampRadius);
  }

  void Follow(const glm::dvec3& tip, const glm::dvec3& ray, RayLight& of) const {
    const double end = glm::length(simulation::SphereHit(tip, ray, backdrop_.radius) - tip);
    of.way[0] = 0, of.clear[0] = 1, of.light[0] = {};
    const double soft = kSoft * backdrop_.radius;
    double before = -backdrop_.radius, deepest = before;
    for (std::size_t k = 1; k <= kSteps; ++k) {
      const double share = double(k) / kSteps;
      of.way[k] = end * share * std::sqrt(share);  // denser near the lens
      const bool is_end = k == kSteps;
      const double depth = grid_.has_relief ? Depth(tip + of.way[k] * ray) : is_end ? 0.0 : before;
      deepest = std::max(deepest, depth);
      // Half of the ray is occluded at the relief itself.
      const double met = std::clamp(0.5 + deepest / soft, 0.0, 1.0);
      of.clear[k] = is_end ? 0.0 : std::min(of.clear[k - 1], 1.0 - met * met * (3 - 2 * met));
      of.light[k] = of.light[k - 1];
      const double here = of.clear[k - 1] - of.clear[k];
      if (here > 0) {
        const double bend = depth - before;
        const double at = bend > 0 ? std::clamp(-before / bend, 0.0, 1.0) : 0.0;
        const double distance = of.way[k - 1] + at * (of.way[k] - of.way[k - 1]);
        of.light[k].Add(At(tip + distance * ray, distance), here);
      }
      before = depth;
    }
  }

 private:
  // Returns how far a place is behind the relief, m.
  double Depth(const glm::dvec3& x) const {
    const double away = glm::length(x);
    double relief = 0;
    if (const auto pixel =
            away > 0 ? PixelFromDirection(backdrop_.projection, x / away) : std::nullopt)
      relief = Inside(grid_, *pixel) * ReliefAt(grid_, *pixel);
    return away - (backdrop_.radius - relief);
  }

  Light At(const glm::dvec3& x, double distance) const {
    const double away = glm::length(x);
    const auto pixel = away > 0 ? PixelFromDirection(backdrop_.projection, x / away) : std::nullopt;
    if (!pixel) return {};
    const GridLook seen = Look(grid_, *pixel);
    const double share = Inside(grid_, *pixel) * seen.share;
    if (!(share > 0)) return {};
    const double lit = seen.luma / seen.share * Lamp(distance);
    return {share * lit * lit, share};
  }

  const LightGrid& grid_;
  const Backdrop& backdrop_;
  double reach2_;
};

}  // namespace

double AutomaticGain(const LightGrid& grid, const FootageLight& footage, const Backdrop& backdrop,
                     const simulation::ScopeView& view, const simulation::ScopeOptics& optics,
                     double light_reach, const MeteredModels* models) {
  if (grid.blocks.empty()) return 1.0;
  const bool has_models = models != nullptr && !models->empty();
  const Meter meter(grid, backdrop, light_reach);
  RayLight met;
  Light sum;
  for (int j = 0; j < kAcross; ++j)
    for (int i = 0; i < kAcross; ++i) {
      const glm::dvec2 place = (glm::dvec2(i, j) + 0.5) * (2.0 / kAcross) - 1.0;
      const double r = glm::length(place);
      const double inside = std::clamp(0.5 + 0.5 * kAcross * (1.0 - r), 0.0, 1.0);
      if (!(inside > 0)) continue;
      const double weight = inside * (1.25 - std::min(r * r, 1.0));  // larger in the middle
      meter.Follow(view.tip, simulation::RayThrough(optics, view, {place.x, -place.y}), met);
      if (!has_models) {
        sum.Add(met.light.back(), weight);
        continue;
      }
      const double part = weight / (kPlaces * kPlaces);
      for (int y = j * kPlaces; y < (j + 1) * kPlaces; ++y)
        for (int x = i * kPlaces; x < (i + 1) * kPlaces; ++x) {
          const MeteredModels::Place& model = models->at(x, y);
          if (!(model.distance > 0)) {
            sum.Add(met.light.back(), part);
            continue;
          }
          double left = 0;
          sum.Add(met.Before(model.distance, left), part);
          const double lit = model.luma * meter.Lamp(model.distance);
          sum.Add({lit * lit, 1.0}, left * part);
        }
    }
  if (!(sum.share > 0) || !(sum.squares > 0) || !(footage.metered > 0)) return 1.0;
  return std::clamp(footage.metered / std::sqrt(sum.squares / sum.share), 0.005, 12.0);
}

}  // namespace arthro::app
