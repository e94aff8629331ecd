#include "simulation/tissue/body/layer_skin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>

#include "simulation/tissue/cut/cutters.h"

namespace arthro::simulation {
namespace {

// Distance from the tool beyond which nothing moves: the rim has decayed to a thousandth.
constexpr double kReach = 4.0;  // thicknesses of the layer
constexpr double kRim = 0.5;    // decay length of the rim, of the thickness
constexpr int kSweeps = 16;     // per frame; each starts from the previous answer

// Returns the distance from x along `way` (unit) at which the ray leaves the capsule; 0: x is
// outside. Bisects, because a capsule is convex.
double ExitDistance(const Capsule& capsule, const glm::dvec3& x, const glm::dvec3& way,
                    double most) noexcept {
  const glm::dvec3 axis = capsule.b - capsule.a;
  const double length2 = glm::dot(axis, axis);
  const auto is_in = [&](const glm::dvec3& p) noexcept {
    const double t =
        length2 > 0.0 ? std::clamp(glm::dot(p - capsule.a, axis) / length2, 0.0, 1.0) : 0.0;
    const glm::dvec3 off = p - (capsule.a + t * axis);
    return glm::dot(off, off) < capsule.radius * capsule.radius;
  };
  if (!is_in(x)) return 0.0;
  if (is_in(x + most * way)) return most;
  double low = 0.0, high = most;
  for (int i = 0; i < 16; ++i) {  // 40 nm of a 2.5 mm layer
    const double middle = 0.5 * (low + high);
    (is_in(x + middle * way) ? low : high) = middle;
  }
  return high;
}

glm::dvec3 UnitOr(const glm::dvec3& x, const glm::dvec3& otherwise) noexcept {
  const double length = glm::length(x);
  return length > 0.0 ? x / length : otherwise;
}

}  // namespace

LayerSkin::LayerSkin(LayerSpec spec) : spec_(std::move(spec)) {
  const SurfaceMesh& surface = spec_.surface;
  const std::size_t count = surface.vertices.size();
  positions_ = surface.vertices;
  skin_ = std::make_shared<const BodySkin>(BodySkin{surface, {}});
  dent_.assign(count, 0.0);
  least_.assign(count, 0.0);
  moved_.reserve(count);

  // Lists triangles and neighbours of each vertex.
  first_triangle_.assign(count + 1, 0);
  for (const auto& triangle : surface.triangles)
    for (int v : triangle) ++first_triangle_[static_cast<std::size_t>(v) + 1];
  for (std::size_t v = 0; v < count; ++v) first_triangle_[v + 1] += first_triangle_[v];
  triangle_.resize(static_cast<std::size_t>(first_triangle_[count]));
  std::vector<int> next(first_triangle_.begin(), first_triangle_.end() - 1);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (int v : surface.triangles[t])
      triangle_[static_cast<std::size_t>(next[static_cast<std::size_t>(v)]++)] =
          static_cast<int>(t);
  first_neighbour_.push_back(0);
  std::vector<int> around;
  for (std::size_t v = 0; v < count; ++v) {
    around.clear();
    for (int i = first_triangle_[v]; i < first_triangle_[v + 1]; ++i)
      for (int w :
           surface.triangles[static_cast<std::size_t>(triangle_[static_cast<std::size_t>(i)])])
        if (w != static_cast<int>(v)) around.push_back(w);
    std::ranges::sort(around);
    around.erase(std::unique(around.begin(), around.end()), around.end());
    neighbour_.insert(neighbour_.end(), around.begin(), around.end());
    first_neighbour_.push_back(static_cast<int>(neighbour_.size()));
  }

  normals_.assign(count, glm::dvec3(0, 0, 1));
  for (std::size_t v = 0; v < count; ++v) moved_.push_back(static_cast<int>(v));
  TakeShape();
  rest_normals_ = normals_;
  moved_.clear();
}

void LayerSkin::Press(std::span<const Capsule> capsules, double depth) noexcept {
  const Rigid3 body_from_portal = Inverse(spec_.portal_from_body);
  std::array<Capsule, kMaxCapsules> tool;
  const std::size_t pieces = std::min(capsules.size(), tool.size());
  for (std::size_t i = 0; i < pieces; ++i)
    tool[i] = {body_from_portal * capsules[i].a, body_from_portal * capsules[i].b,
               capsules[i].radius};
  // Limits the depth to the range of the theory, or to the tool's depth, at most to the bone.
  const double thickness = spec_.layer.thickness();
  const double most = std::clamp(depth, ElasticLayer::kDeepShare * thickness, thickness);
  const auto is_near = [&](const glm::dvec3& x) noexcept {
    return std::any_of(tool.begin(), tool.begin() + static_cast<std::ptrdiff_t>(pieces),
                       [&](const Capsule& c) {
                         return DistanceToCapsule(x, c.a, c.b, c.radius) < kReach * thickness;
                       });
  };

  // Restores the vertices that were near before, but keeps their dent as a starting value.
  const std::vector<glm::dvec3>& rest = skin_->surface.vertices;
  for (int v : moved_) {
    const auto i = static_cast<std::size_t>(v);
    positions_[i] = rest[i];
    normals_[i] = rest_normals_[i];
    if (!is_near(rest[i])) dent_[i] = least_[i] = 0.0;
  }
  moved_.clear();
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (!is_near(rest[i])) continue;
    moved_.push_back(static_cast<int>(i));
    least_[i] = 0.0;
    for (std::size_t piece = 0; piece < pieces; ++piece)
      least_[i] = std::max(least_[i], ExitDistance(tool[piece], rest[i], -rest_normals_[i], most));
  }
  Relax();
  for (int v : moved_) {
    const auto i = static_cast<std::size_t>(v);
    positions_[i] = rest[i] - dent_[i] * rest_normals_[i];
  }
  TakeShape();
  ++version_;
}

// Relaxes Δu = u/rim² outside the tool, with u at least the tool's depth, by in-place sweeps of
// alternating direction.
void LayerSkin::Relax() noexcept {
  const std::vector<glm::dvec3>& rest = skin_->surface.vertices;
  const double rim = kRim * spec_.layer.thickness();
  const auto relax = [&](int vertex) noexcept {
    const auto v = static_cast<std::size_t>(vertex);
    double sum = 0.0, weights = 0.0;
    for (int n = first_neighbour_[v]; n < first_neighbour_[v + 1]; ++n) {
      const auto w = static_cast<std::size_t>(neighbour_[static_cast<std::size_t>(n)]);
      const glm::dvec3 edge = rest[w] - rest[v];
      const double weight = 1.0 / std::max(glm::dot(edge, edge), 1e-14);
      sum += weight * dent_[w];
      weights += weight;
    }
    // For n neighbours at distance l in the plane: Δu ≈ 4/n Σ (u_w − u_v)/l².
    const double valence = first_neighbour_[v + 1] - first_neighbour_[v];
    dent_[v] = std::max(least_[v], sum / (weights + 0.25 * valence / (rim * rim)));
  };
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    if (sweep % 2 == 0)
      for (std::size_t i = 0; i < moved_.size(); ++i) relax(moved_[i]);
    else
      for (std::size_t i = moved_.size(); i-- > 0;) relax(moved_[i]);
}

// Computes area-weighted normals of the vertices that moved; adjacent ones hardly rotate.
void LayerSkin::TakeShape() noexcept {
  const auto& triangles = skin_->surface.triangles;
  for (int vertex : moved_) {
    const auto v = static_cast<std::size_t>(vertex);
    glm::dvec3 sum(0.0);
    for (int i = first_triangle_[v]; i < first_triangle_[v + 1]; ++i) {
      const auto& [a, b, c] =
          triangles[static_cast<std::size_t>(triangle_[static_cast<std::size_t>(i)])];
      const glm::dvec3& x = positions_[static_cast<std::size_t>(a)];
      sum += glm::cross(positions_[static_cast<std::size_t>(b)] - x,
                        positions_[static_cast<std::size_t>(c)] - x);
    }
    normals_[v] = UnitOr(sum, {0, 0, 1});
  }
}

void LayerSkin::Release() noexcept {
  if (moved_.empty()) return;
  for (int v : moved_) {
    const auto i = static_cast<std::size_t>(v);
    positions_[i] = skin_->surface.vertices[i];
    normals_[i] = rest_normals_[i];
    dent_[i] = least_[i] = 0.0;
  }
  moved_.clear();
  ++version_;
}

}  // namespace arthro::simulation
