// Shape of the unpressed skin around a touch: its curvature, and the depth of a tool in it.
#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "simulation/tissue/contact/tool_contact.h"

namespace arthro::simulation {
namespace {

// Radius of a probe's end and its motion in a step; the skin is not resolved any finer.
constexpr double kReach = 2.5e-3;  // m

// Cosine limit: skin that faces further away belongs to another side of the tissue.
constexpr double kSameSide = 0.5;

constexpr int kMostAdvances = 20;
constexpr double kOut = 1e-5, kDeepest = 0.02;  // m

// Returns the rotation of least angle that maps `from` to `to`, both unit.
glm::dmat3 Turn(const glm::dvec3& from, const glm::dvec3& to) noexcept {
  const glm::dvec3 axis = glm::cross(from, to);
  const double cosine = glm::dot(from, to);
  if (!(cosine > -0.999)) return glm::dmat3(1.0);
  const glm::dmat3 cross(0.0, axis.z, -axis.y, -axis.z, 0.0, axis.x, axis.y, -axis.x, 0.0);
  return glm::dmat3(1.0) + cross + cross * cross / (1.0 + cosine);
}

}  // namespace

// Fits n ≈ m − C s to the normals n of the skin at offsets s from the touch: least squares over
// triangles, weighted by area and nearness.
glm::dmat3 SkinContact::Curvature(std::span<const ContactPoint> contacts,
                                  std::span<const ContactResult> results,
                                  int owner) const noexcept {
  glm::dvec3 centre(0.0), push(0.0), facing(0.0);
  double whole = 0.0;
  for (std::size_t i = 0; i < std::min(contacts.size(), results.size()); ++i) {
    if (contacts[i].owner != owner) continue;
    const double size = glm::length(results[i].push);
    centre += size * results[i].point;
    push -= results[i].push;
    whole += size;
  }
  const glm::dmat3 flat(0.0);
  if (!(whole > 0.0) || !(glm::length(push) > 0.0)) return flat;
  const OnSkin under = NearestTo(centre / whole, kReach);
  if (under.triangle < 0) return flat;
  centre = Blend(under, skin_->rest.vertices);
  facing = glm::normalize(Blend(under, rest_normals_));

  struct Sums {
    double weight = 0;
    glm::dvec3 place{0.0}, normal{0.0};
    glm::dmat3 places{0.0}, mixed{0.0};  // s sᵀ, n sᵀ
  } sum;
  double limit2 = 4.0 * kReach * kReach;  // pressed skin has moved
  tree_.ForNear(positions_[static_cast<std::size_t>(
                    skin_->rest.triangles[static_cast<std::size_t>(under.triangle)][0])],
                limit2, [&](int t) noexcept {
                  const OnSkin middle{t, glm::dvec3(1.0 / 3.0), 0};
                  const glm::dvec3 s = Blend(middle, skin_->rest.vertices) - centre;
                  const glm::dvec3 n = Blend(middle, rest_normals_);
                  const double far2 = glm::dot(s, s) / (kReach * kReach);
                  if (!(far2 < 1.0) || !(glm::dot(n, facing) > kSameSide)) return;
                  const auto& [i, j, k] = skin_->rest.triangles[static_cast<std::size_t>(t)];
                  const glm::dvec3& a = skin_->rest.vertices[static_cast<std::size_t>(i)];
                  const double weight =
                      (1.0 - far2) * glm::length(glm::cross(
                                         skin_->rest.vertices[static_cast<std::size_t>(j)] - a,
                                         skin_->rest.vertices[static_cast<std::size_t>(k)] - a));
                  sum.weight += weight;
                  sum.place += weight * s;
                  sum.normal += weight * n;
                  sum.places += weight * glm::outerProduct(s, s);
                  sum.mixed += weight * glm::outerProduct(n, s);
                });
  if (!(sum.weight > 0.0) || !(glm::length(sum.normal) > 0.0)) return flat;
  const glm::dvec3 m = glm::normalize(sum.normal);
  const glm::dmat3 spread = sum.places - glm::outerProduct(sum.place, sum.place) / sum.weight;
  const glm::dmat3 turned = sum.mixed - glm::outerProduct(sum.normal, sum.place) / sum.weight;
  // Restricts to the plane across m; a patch that is a line or a point does not determine C.
  const glm::dvec3 aside = std::abs(m.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 e1 = glm::normalize(glm::cross(m, aside)), e2 = glm::cross(m, e1);
  const auto in_plane = [&](const glm::dmat3& full) noexcept {
    return glm::dmat2(glm::dot(e1, full * e1), glm::dot(e2, full * e1), glm::dot(e1, full * e2),
                      glm::dot(e2, full * e2));
  };
  const glm::dmat2 places = in_plane(spread);
  const double trace = places[0][0] + places[1][1];
  if (!(glm::determinant(places) > 1e-3 * trace * trace)) return flat;
  glm::dmat2 bend = -in_plane(turned) * glm::inverse(places);
  bend = 0.5 * (bend + glm::transpose(bend));
  // Limits the curvature to the radius of the fit: a rim is not a quadric.
  const double sharpest = std::abs(bend[0][0]) + std::abs(bend[0][1]) + std::abs(bend[1][1]);
  if (!std::isfinite(sharpest)) return flat;
  if (sharpest > 1.0 / kReach) bend *= 1.0 / (kReach * sharpest);
  const glm::dmat3 turn = Turn(m, glm::normalize(push));
  const glm::dvec3 t1 = turn * e1, t2 = turn * e2;
  return bend[0][0] * glm::outerProduct(t1, t1) + bend[1][1] * glm::outerProduct(t2, t2) +
         bend[0][1] * (glm::outerProduct(t1, t2) + glm::outerProduct(t2, t1));
}

double SkinContact::DepthAtRest(std::span<const Capsule> capsules,
                                const glm::dvec3& out) const noexcept {
  double deepest = 0.0;
  for (const Capsule& capsule : capsules) {
    const glm::dvec3 way = capsule.b - capsule.a;
    const int parts = static_cast<int>(
        std::clamp(std::ceil(glm::length(way) / capsule.radius), 1.0, double{kMaxPieces}));
    for (int i = 0; i <= parts; ++i) {
      const glm::dvec3 x = capsule.a + static_cast<double>(i) / parts * way;
      if (Distance2(field_->box(), x) > capsule.radius * capsule.radius) continue;
      // Advances repeatedly by the distance within which no skin can be met.
      double gone = 0.0;
      for (int round = 0; round < kMostAdvances && gone < kDeepest; ++round) {
        const double inside = capsule.radius - field_->Distance(x + gone * out);
        if (!(inside > kOut)) break;
        gone += inside;
      }
      deepest = std::max(deepest, gone);
    }
  }
  return deepest;
}

}  // namespace arthro::simulation
