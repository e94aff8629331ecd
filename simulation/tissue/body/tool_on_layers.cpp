#include "simulation/tissue/body/tool_on_layers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "simulation/core/finite.h"

namespace arthro::simulation {
namespace {

constexpr double kSpacing = 3.5e-4;  // m, of the distance field, as for cuts
constexpr double kAround = 2.6e-3;   // m, outside the surface: the thickest tool and a spacing
constexpr std::int64_t kMostCells = 20'000'000;
constexpr double kLongest = 0.03;       // m from the tip; a rod further up is outside the joint
constexpr double kPart = 0.5;           // fraction of the radius: length of a part of a capsule
constexpr double kShortestPart = 4e-4;  // m
constexpr int kMostParts = 64;          // per capsule
constexpr double kNotThrough = 0.99;    // fraction of the depth to the bone

constexpr int kSteps = 24, kHalvings = 4;
constexpr double kLeastStep = 2e-4;  // m, a step that may touch more; a twelfth of a layer
constexpr double kBalanced = 1e-6;   // N

// Returns whether this is a free end: not inside another capsule, nor the later of two equal ends.
bool IsEnd(std::span<const Capsule> tool, std::size_t capsule, const glm::dvec3& end) noexcept {
  const double radius = tool[capsule].radius;
  for (std::size_t i = 0; i < tool.size(); ++i) {
    if (i == capsule) continue;
    const Capsule& other = tool[i];
    const glm::dvec3 axis = other.b - other.a;
    const double length2 = glm::dot(axis, axis);
    const double t =
        length2 > 0.0 ? std::clamp(glm::dot(end - other.a, axis) / length2, 0.0, 1.0) : 0.0;
    const double beyond = glm::distance(end, other.a + t * axis) + radius - other.radius;
    if (beyond < -1e-9 || (beyond < 1e-9 && i < capsule)) return false;
  }
  return true;
}

struct Sum {
  LayerForce all;
  double of_layer = 0;

  // Adds a ball of the tool at x. `press`: the closed form; `share`: its fraction, from the normal.
  template <class Press, class Share>
  void Add(const LayerUnder& layer, const glm::dvec3& x, double radius, const Press& press,
           const Share& share) noexcept {
    const double depth = radius - layer.solid.Distance(x);
    if (!(depth > 0.0)) {
      all.clear = std::min(all.clear, -depth);
      return;
    }
    all.clear = 0.0;
    all.depth = std::max(all.depth, depth);
    // Bone, or the depth limit of the field: F/(1 − (δ/most)⁴).
    const double most = std::min(layer.layer.thickness(), radius + 0.8 * layer.half_way);
    const double way = std::min(depth / most, kNotThrough);
    if (depth >= kNotThrough * most) all.is_through = true;
    const double rest = 1.0 - way * way * way * way;
    const LayerTouch touch = press(way * most);
    const glm::dvec3 normal = layer.solid.Normal(x);
    const double part = share(normal) / rest;
    const double force = part * touch.force;
    const double stiffness =
        part * (touch.stiffness + touch.force * 4.0 * way * way * way / (rest * most));
    all.force += force * normal;
    all.stiffness += stiffness * glm::outerProduct(normal, normal);
    all.is_deep |= touch.is_deep && part > 0.0;
    of_layer += force;
  }
};

}  // namespace

LayerUnder::LayerUnder(const SurfaceMesh& surface, const Rigid3& portal_from_surface,
                       const ElasticLayer& of, int index)
    : solid{SolidField::FromSurface(surface, kSpacing, kMostCells, kAround),
            {portal_from_surface.translation, portal_from_surface.rotation, 1.0}},
      layer(of),
      tissue(index) {
  for (const float value : solid.field.values())
    half_way = std::max(half_way, -static_cast<double>(value));
}

LayerForce ComputeLayerForce(std::span<const LayerUnder> layers, std::span<const Capsule> tool,
                             const glm::dvec3& tip) noexcept {
  Sum sum;
  sum.all.clear = std::numeric_limits<double>::max();
  double most = 0.0;
  for (const LayerUnder& layer : layers) {
    sum.of_layer = 0.0;
    for (std::size_t i = 0; i < tool.size(); ++i) {
      const double radius = tool[i].radius;
      // Runs from the end nearer to the tip, as far as the tool goes into a joint.
      const bool is_b_near = glm::dot(tool[i].b, tool[i].b) <= glm::dot(tool[i].a, tool[i].a);
      const glm::dvec3 near = is_b_near ? tool[i].b : tool[i].a;
      const glm::dvec3 far = is_b_near ? tool[i].a : tool[i].b;
      const double length = glm::distance(near, far);
      const glm::dvec3 along = length > 0.0 ? (far - near) / length : glm::dvec3(0.0);
      const double used = std::min(length, kLongest);
      const int parts =
          std::clamp(static_cast<int>(std::ceil(used / std::max(kPart * radius, kShortestPart))), 0,
                     kMostParts);
      const double part = parts > 0 ? used / parts : 0.0;
      for (int k = 0; k < parts; ++k)
        sum.Add(
            layer, tip + near + (k + 0.5) * part * along, radius,
            [&](double depth) noexcept { return layer.layer.PressLine(radius, depth); },
            [&](const glm::dvec3& normal) noexcept {
              const double across = glm::dot(along, normal);
              return part * std::sqrt(std::max(0.0, 1.0 - across * across));
            });
      const auto add_end = [&](const glm::dvec3& end, const glm::dvec3& outwards) noexcept {
        if (!IsEnd(tool, i, end)) return;
        sum.Add(
            layer, tip + end, radius,
            [&](double depth) noexcept { return layer.layer.PressBall(radius, depth); },
            [&](const glm::dvec3& normal) noexcept {
              return 0.5 * (1.0 - glm::dot(outwards, normal));
            });
      };
      add_end(near, -along);
      if (length <= kLongest) add_end(far, along);
    }
    if (sum.of_layer > most) {
      most = sum.of_layer;
      sum.all.tissue = layer.tissue;
    }
  }
  return sum.all;
}

LayerHold HoldOnLayers(std::span<const LayerUnder> layers, std::span<const Capsule> tool,
                       const glm::dvec3& held, const glm::dvec3& before, double stiffness,
                       double friction) noexcept {
  LayerHold hold;
  hold.tip = held;
  const bool is_known = IsFinite(held) && IsFinite(before);
  if (layers.empty() || tool.empty() || !(stiffness > 0.0) || !is_known) return hold;
  // Newton's method from the previous position, in steps that cannot skip a layer.
  glm::dvec3 x = before;
  LayerForce at = ComputeLayerForce(layers, tool, x);
  glm::dvec3 excess = stiffness * (held - x) + at.force;
  for (int i = 0; i < kSteps && glm::length(excess) > kBalanced; ++i) {
    glm::dvec3 step = glm::inverse(glm::dmat3(stiffness) + at.stiffness) * excess;
    const double length = glm::length(step), most = std::max(kLeastStep, 0.9 * at.clear);
    if (length > most) step *= most / length;
    bool is_nearer = false;
    for (int halving = 0; halving <= kHalvings && !is_nearer; ++halving, step *= 0.5) {
      const LayerForce next = ComputeLayerForce(layers, tool, x + step);
      const glm::dvec3 left = stiffness * (held - x - step) + next.force;
      // A tool that is too deep moves out whatever the residual.
      is_nearer = at.is_through || (glm::length(left) < glm::length(excess) && !next.is_through);
      if (!is_nearer) continue;
      x += step;
      at = next;
      excess = left;
    }
    if (!is_nearer) break;
  }
  if (at.tissue < 0) return hold;  // free: at its commanded position
  // Friction: the tip lags behind, across the force, by as much as friction holds.
  const double push = glm::length(at.force);
  const glm::dvec3 normal = push > 0.0 ? at.force / push : glm::dvec3(0.0);
  glm::dvec3 lag = before - x;
  lag -= glm::dot(lag, normal) * normal;
  const double most = friction * push / stiffness, length = glm::length(lag);
  if (length > most) lag *= most / length;
  hold.tip = x + lag;
  hold.force = stiffness * (hold.tip - held);
  hold.depth = at.depth;
  hold.tissue = at.tissue;
  hold.is_deep = at.is_deep;
  return hold;
}

}  // namespace arthro::simulation
