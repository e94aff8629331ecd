// Distances from a point to the surfaces of the cavity, and their normals.
#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "authoring/phantom/shape/cavity.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

// Minimum of two distances with a fillet: exact where they differ by more than kFillet.
double FilletedMinimum(double a, double b) {
  constexpr double kFillet = 7.0 * kMm;
  const double near = std::max(kFillet - std::abs(a - b), 0.0) / kFillet;
  return std::min(a, b) - 0.25 * kFillet * near * near;
}

glm::dvec3 FemurNormal(const Cavity& cavity, const glm::dvec3& x) {
  constexpr double kStep = 0.02 * kMm;
  glm::dvec3 slope(0.0);
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 step(0.0);
    step[i] = kStep;
    slope[i] = FemurClearance(cavity, x + step) - FemurClearance(cavity, x - step);
  }
  return glm::normalize(slope);
}

// Normal towards the portal of a surface at distance R(direction): -∇(|x| - R(x/|x|)); x lies on
// it.
template <class Distance>
glm::dvec3 StarNormal(const glm::dvec3& x, const Distance& distance) {
  const double length = glm::length(x);
  const glm::dvec3 d = x / length;
  const glm::dvec3 a = glm::normalize(
      glm::cross(d, std::abs(d.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
  const glm::dvec3 b = glm::cross(d, a);
  constexpr double kTurn = 1.5e-3;  // rad: finer than a fold, coarser than rounding
  const double slope_a = (distance(glm::normalize(d + kTurn * a)) - length) / kTurn;
  const double slope_b = (distance(glm::normalize(d + kTurn * b)) - length) / kTurn;
  return glm::normalize(-d + (slope_a * a + slope_b * b) / length);
}

double BundleClearance(const Bundle& bundle, const glm::dvec3& x, glm::dvec3* nearest = nullptr) {
  const glm::dvec3 axis = bundle.to - bundle.from;
  const double t = std::clamp(glm::dot(x - bundle.from, axis) / glm::dot(axis, axis), 0.0, 1.0);
  const glm::dvec3 on_axis = bundle.from + t * axis;
  if (nearest) *nearest = on_axis;
  return glm::length(x - on_axis) - bundle.radius;
}

}  // namespace

double FemurClearance(const Cavity& cavity, const glm::dvec3& x) {
  return FilletedMinimum(FilletedMinimum(EllipsoidClearance(cavity.condyle, x),
                                         EllipsoidClearance(cavity.trochlea, x)),
                         EllipsoidClearance(cavity.lateral_condyle, x));
}

glm::dvec3 NormalAt(const Cavity& cavity, Surface surface, const glm::dvec3& x, bool with_bed) {
  switch (surface) {
    case Surface::kCondyle:
      return FemurNormal(cavity, x);
    case Surface::kFat:
      return StarNormal(x, [&](const glm::dvec3& d) { return FatDistance(cavity, d); });
    case Surface::kPlateau: {
      const glm::dvec3 p = Inverse(cavity.plateau.portal_from_plateau) * x;
      constexpr double kStep = 0.05 * kMm;
      const auto height = [&](double dx, double dy) {
        return PlateauHeight(cavity.plateau, p.x + dx, p.y + dy, with_bed);
      };
      const double slope_x = (height(kStep, 0) - height(-kStep, 0)) / (2.0 * kStep);
      const double slope_y = (height(0, kStep) - height(0, -kStep)) / (2.0 * kStep);
      return cavity.plateau.portal_from_plateau.rotation *
             glm::normalize(glm::dvec3(-slope_x, -slope_y, 1.0));
    }
    case Surface::kLigament: {
      glm::dvec3 axis_point{0.0}, candidate{0.0};
      double best = std::numeric_limits<double>::infinity();
      for (const Bundle& bundle : cavity.ligament) {
        const double clearance = BundleClearance(bundle, x, &candidate);
        if (clearance < best) best = clearance, axis_point = candidate;
      }
      return glm::normalize(x - axis_point);
    }
    default:
      return StarNormal(x, [&](const glm::dvec3& d) { return CapsuleDistance(cavity, d); });
  }
}

BundlePlace NearestBundle(const Cavity& cavity, const glm::dvec3& x) {
  BundlePlace place;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < cavity.ligament.size(); ++i) {
    const Bundle& bundle = cavity.ligament[i];
    const double clearance = BundleClearance(bundle, x);
    if (clearance >= best) continue;
    const glm::dvec3 axis = bundle.to - bundle.from;
    best = clearance;
    place = {i, std::clamp(glm::dot(x - bundle.from, axis) / glm::dot(axis, axis), 0.0, 1.0)};
  }
  return place;
}

double EllipsoidClearance(const Ellipsoid& e, const glm::dvec3& x) {
  const glm::dvec3 body = glm::conjugate(e.portal_from_body) * (x - e.centre);
  const double k0 = glm::length(body / e.radii), k1 = glm::length(body / (e.radii * e.radii));
  return k1 > 0.0 ? k0 * (k0 - 1.0) / k1 : -std::min({e.radii.x, e.radii.y, e.radii.z});
}

double Clearance(const Cavity& cavity, const glm::dvec3& x, bool with_bed) {
  const double length = glm::length(x);
  double clearance = length > 0.0 ? CapsuleBase(cavity, x / length) - length : cavity.radius;
  clearance = std::min(clearance, FemurClearance(cavity, x));
  const glm::dvec3 p = Inverse(cavity.plateau.portal_from_plateau) * x;
  for (const Bundle& bundle : cavity.ligament)
    clearance = std::min(clearance, BundleClearance(bundle, x));
  return std::min(clearance, PlateauClearance(cavity.plateau, p, with_bed, clearance));
}

}  // namespace arthro::authoring
