#include "authoring/phantom/cavity.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "authoring/phantom/noise.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kMm = kMetrePerMillimetre;

// Noise channels: each draws its own values from the cavity's seed. Noise of k d, d a unit
// direction, has about k features per rad.
enum NoiseChannel : std::uint32_t {
  kFoldWarpX = 11,
  kFoldWarpY = 12,
  kFoldWarpZ = 13,
  kFoldBroad = 14,
  kFoldNarrow = 15,
  kOverhangMargin = 21,
  kFatMarginBroad = 31,
  kFatMarginFine = 32,
  kLobuleWarpX = 41,
  kLobuleWarpY = 42,
  kLobuleWarpZ = 43,
  kLobules = 44,
  kLumps = 45,
  kSmallLobules = 46,
};

glm::dvec3 Jitter(Random& random, double size) {
  return {random.Uniform(-size, size), random.Uniform(-size, size), random.Uniform(-size, size)};
}

double CastSphere(const glm::dvec3& centre, double radius, const glm::dvec3& d) {
  const double b = glm::dot(centre, d), c = glm::dot(centre, centre) - radius * radius;
  const double discriminant = b * b - c;
  return discriminant < 0.0 || b <= 0.0 ? kNever : b - std::sqrt(discriminant);
}

double CastBundle(const Bundle& bundle, const glm::dvec3& d) {
  const glm::dvec3 axis = bundle.to - bundle.from, o = -bundle.from;
  const double length2 = glm::dot(axis, axis), ad = glm::dot(axis, d), ao = glm::dot(axis, o);
  const double a = length2 - ad * ad, b = length2 * glm::dot(o, d) - ao * ad;
  const double c = length2 * (glm::dot(o, o) - bundle.radius * bundle.radius) - ao * ao;
  double nearest =
      std::min(CastSphere(bundle.from, bundle.radius, d), CastSphere(bundle.to, bundle.radius, d));
  const double discriminant = b * b - a * c;
  if (discriminant >= 0.0 && a > 0.0) {
    const double s = (-b - std::sqrt(discriminant)) / a, along = ao + s * ad;
    if (s > 0.0 && along > 0.0 && along < length2) nearest = std::min(nearest, s);
  }
  return nearest;
}

// Range of heights that holds the visible plateau; m.
constexpr double kPlateauTop = 17.0 * kMm, kPlateauBottom = -16.0 * kMm;

// Steps down through the range of heights until below the height field, then bisects the step to a
// picometre.
double CastPlateau(const Plateau& plateau, const glm::dvec3& direction, double limit) {
  const Rigid3 plateau_from_portal = Inverse(plateau.portal_from_plateau);
  const glm::dvec3 o = plateau_from_portal.translation,
                   d = plateau_from_portal.rotation * direction;
  if (d.z > -1e-3) return kNever;
  double s = std::max((kPlateauTop - o.z) / d.z, 0.0);
  const double end = std::min((kPlateauBottom - o.z) / d.z, limit);
  const auto above = [&](double at) {
    const glm::dvec3 p = o + at * d;
    return p.z - PlateauHeight(plateau, p.x, p.y);
  };
  constexpr double kStep = 0.35 * kMm;  // finer than anything on the plateau
  double last = s, height = above(s);
  while (height > 0.0) {
    if (s > end) return kNever;
    last = s;
    s += std::max(kStep, 0.5 * height);
    height = above(s);
  }
  double inside = s;
  for (int i = 0; i < 32; ++i) {
    const double middle = 0.5 * (last + inside);
    (above(middle) > 0.0 ? last : inside) = middle;
  }
  return 0.5 * (last + inside);
}

// Folds are long and run in one direction: noise stretched along a slowly turning direction, its
// zero lines rounded into ridges.
double Folds(const glm::dvec3& d, std::uint32_t seed) {
  constexpr double kTurns = 1.7, kWarp = 0.45;  // per rad; strength of the warp
  constexpr double kBroadSharpness = 14.0, kNarrowSharpness = 9.0;
  constexpr double kBroadShare = 0.72, kNarrowShare = 0.28;  // shares of the height
  const glm::dvec3 warp(GradientNoise(kTurns * d, seed + kFoldWarpX),
                        GradientNoise(kTurns * d, seed + kFoldWarpY),
                        GradientNoise(kTurns * d, seed + kFoldWarpZ));
  const glm::dvec3 q = d + kWarp * warp;
  // Folds per rad along x, y and z: closer together from top to bottom.
  const double n = GradientNoise(glm::dvec3(2.1 * q.x, 3.9 * q.y, 2.1 * q.z), seed + kFoldBroad);
  const double broad = std::exp(-n * n * kBroadSharpness);
  const double m = GradientNoise(glm::dvec3(5.3 * q.x, 8.7 * q.y, 5.3 * q.z), seed + kFoldNarrow);
  const double narrow = std::exp(-m * m * kNarrowSharpness);
  return kBroadShare * broad + kNarrowShare * narrow * (0.4 + 0.6 * broad);
}

// Smooth approximations of the star-shaped surfaces, for Clearance.
double CapsuleBase(const Cavity& cavity, const glm::dvec3& d) {
  const double front = SmoothStep(0.58, 0.96, d.z - 0.08 * d.x);
  const double base = cavity.capsule_side + (cavity.capsule_front - cavity.capsule_side) * front;
  // Overhead the synovium reaches down to its junction with the condyle.
  if (d.y > -0.45) return base;
  constexpr double kOverheadFrom = 0.74;  // sine of the elevation
  const double ragged = 0.22 * GradientNoise(1.9 * d, cavity.seed + kOverhangMargin);
  return base - cavity.overhang * SmoothStep(kOverheadFrom, 1.0, -d.y + ragged);
}

// Share of the fat pad in a direction, 0 to 1: below and in front, more on the lateral side.
double FatShare(const Cavity& cavity, const glm::dvec3& d) {
  constexpr double kFatFrom = 0.38,
                   kFatTo = 0.80;    // sine of the depression; full pad from kFatTo on
  constexpr double kLateral = 0.16;  // preference of the lateral side
  const double edge = 0.24 * GradientNoise(2.3 * d, cavity.seed + kFatMarginBroad) +
                      0.08 * GradientNoise(6.0 * d, cavity.seed + kFatMarginFine);
  return SmoothStep(kFatFrom, kFatTo, d.y - kLateral * d.x + edge);
}

}  // namespace

Cavity MakeCavity(std::uint32_t seed) {
  Random random(0xA27450000ull + seed);
  Cavity cavity;
  cavity.seed = static_cast<std::uint32_t>(random.Next());
  // Near(mean, share): a mean in mm and its relative spread. Sizes are chosen so that the joint
  // holds the scope and the instrument and fills its view; none is measured.
  cavity.capsule_side = random.Near(41.5, 0.01) * kMm;
  cavity.capsule_front = 47.6 * kMm;
  cavity.fold_height = random.Near(3.2, 0.15) * kMm;
  cavity.overhang = random.Near(24.0, 0.05) * kMm;
  cavity.fat_distance = random.Near(21.8, 0.03) * kMm;
  cavity.lobe_height = random.Near(2.4, 0.12) * kMm;

  // The plateau is tilted towards the scope, which looks down on it.
  Plateau& plateau = cavity.plateau;
  const double tilt = RadiansFromDegrees(random.Uniform(12.5, 15.0));
  const double yaw = RadiansFromDegrees(random.Uniform(-5.0, 5.0));
  // Columns of the untilted frame: x medial, y posterior (portal z), z up (portal -y).
  const glm::dquat upright = glm::angleAxis(RadiansFromDegrees(90.0), glm::dvec3(1, 0, 0));
  plateau.portal_from_plateau.rotation = glm::angleAxis(tilt, glm::dvec3(1, 0, 0)) * upright *
                                         glm::angleAxis(yaw, glm::dvec3(0, 0, 1));
  plateau.portal_from_plateau.translation =
      glm::dvec3(random.Uniform(5.5, 7.5), random.Uniform(7.6, 8.4), random.Uniform(28.3, 29.3)) *
      kMm;
  plateau.curvature_x = 1.0 / (random.Near(62.0, 0.1) * kMm);
  plateau.curvature_y = 1.0 / (random.Near(95.0, 0.1) * kMm);
  plateau.half_width_medial = random.Near(24.0, 0.03) * kMm;
  plateau.half_width_lateral = random.Near(38.0, 0.03) * kMm;
  plateau.half_depth = random.Near(18.0, 0.02) * kMm;
  plateau.roll_off = 60.0 * kMm;
  plateau.spine = glm::dvec2(random.Uniform(-17.5, -16.0), random.Uniform(0.0, 4.0)) * kMm;
  plateau.spine_radii = glm::dvec2(random.Near(4.2, 0.1), random.Near(8.0, 0.1)) * kMm;
  plateau.spine_height = random.Near(4.6, 0.12) * kMm;
  plateau.bed.centre = glm::dvec2(random.Uniform(-3.2, -2.0), random.Uniform(-2.6, -1.6)) * kMm;
  plateau.bed.radii = glm::dvec2(random.Near(8.0, 0.04), random.Near(5.6, 0.04)) * kMm;
  plateau.bed.wobble = {random.Uniform(0.0, 6.28), random.Uniform(0.0, 6.28)};
  plateau.bed.depth = random.Near(2.3, 0.06) * kMm;

  // The condyle lies over the dish; a valgus load opens the joint.
  cavity.condyle.radii =
      glm::dvec3(random.Near(19.0, 0.03), random.Near(22.0, 0.02), random.Near(20.5, 0.02)) * kMm;
  const double gap = random.Uniform(7.0, 7.8) * kMm;
  cavity.condyle.portal_from_body =
      glm::angleAxis(RadiansFromDegrees(random.Uniform(-4.0, 0.0)), glm::dvec3(1, 0, 0)) *
      glm::angleAxis(RadiansFromDegrees(random.Uniform(2.0, 8.0)), glm::dvec3(0, 0, 1));
  const glm::dvec3 lowest =
      plateau.portal_from_plateau * glm::dvec3(random.Uniform(-1.0, 0.5) * kMm, 1.0 * kMm, gap);
  cavity.condyle.centre =
      lowest + cavity.condyle.portal_from_body * glm::dvec3(0.0, -cavity.condyle.radii.y, 0.0);

  // Ligament similar to a cruciate, with fibres that fan out at the tibia.
  const glm::dvec3 foot =
      plateau.portal_from_plateau * glm::dvec3(-18.0 * kMm, 3.0 * kMm, -0.5 * kMm);
  const glm::dvec3 roof = glm::dvec3(-22.0, -26.0, 37.0) * kMm + Jitter(random, 0.8 * kMm);
  for (std::size_t i = 0; i < cavity.ligament.size(); ++i) {
    const double side = static_cast<double>(i) - 2.0;
    cavity.ligament[i].from =
        foot + glm::dvec3(1.9 * side, 0.3 * std::abs(side), 0.8 * std::abs(side)) * kMm +
        Jitter(random, 0.4 * kMm);
    cavity.ligament[i].to = roof + glm::dvec3(0.8 * side, 0.5 * side, 1.0 * std::abs(side)) * kMm +
                            Jitter(random, 0.4 * kMm);
    cavity.ligament[i].radius = random.Uniform(1.7, 2.3) * kMm;
  }
  return cavity;
}

double BedOutline(const CartilageBed& bed, double angle) {
  return 1.0 + 0.07 * std::cos(2.0 * angle + bed.wobble.x) +
         0.05 * std::cos(3.0 * angle + bed.wobble.y);
}

double BedShare(const CartilageBed& bed, double x, double y) {
  const double u = (x - bed.centre.x) / bed.radii.x, v = (y - bed.centre.y) / bed.radii.y;
  const double r2 = u * u + v * v;
  if (r2 < 1e-12 || r2 > 4.0) return std::sqrt(r2);
  return std::sqrt(r2) / BedOutline(bed, std::atan2(v, u));
}

double BedDepth(const CartilageBed& bed, double share) {
  return bed.depth * SmoothStep(1.0, 1.0 - bed.wall, share);
}

double PlateauHeight(const Plateau& plateau, double x, double y, bool with_bed) {
  double z = 0.5 * plateau.curvature_x * x * x + 0.5 * plateau.curvature_y * y * y;
  // Outline of a rounded box, with an edge that rolls off beyond nine tenths of it.
  constexpr double kRollFrom = 0.9;
  const double u = x / (x > 0.0 ? plateau.half_width_medial : plateau.half_width_lateral),
               v = y / plateau.half_depth;
  const double past = std::sqrt(std::sqrt(u * u * u * u + v * v * v * v)) - kRollFrom;
  if (past > 0.0) z -= plateau.roll_off * past * past;
  const double su = (x - plateau.spine.x) / plateau.spine_radii.x,
               sv = (y - plateau.spine.y) / plateau.spine_radii.y;
  const double spine2 = su * su + sv * sv;
  if (spine2 < 16.0) z += plateau.spine_height * std::exp(-spine2);
  if (with_bed) {
    const double share = BedShare(plateau.bed, x, y);
    if (share < 1.0) z -= BedDepth(plateau.bed, share);
  }
  return z;
}

double CapsuleDistance(const Cavity& cavity, const glm::dvec3& d) {
  // Folds fade towards the back of the joint and at the instrument's portal.
  const double portal_side = SmoothStep(0.75, 0.97, d.x);
  const double strength = (1.0 - 0.75 * SmoothStep(0.7, 0.95, d.z)) * (1.0 - 0.6 * portal_side);
  return CapsuleBase(cavity, d) - cavity.fold_height * strength * Folds(d, cavity.seed);
}

double FatLobule(const Cavity& cavity, const glm::dvec3& d) {
  const glm::dvec3 wobble(GradientNoise(4.0 * d, cavity.seed + kLobuleWarpX),
                          GradientNoise(4.0 * d, cavity.seed + kLobuleWarpY),
                          GradientNoise(4.0 * d, cavity.seed + kLobuleWarpZ));
  return LobeNoise(6.2 * d + 0.45 * wobble, cavity.seed + kLobules);
}

double FatDistance(const Cavity& cavity, const glm::dvec3& d) {
  const double share = FatShare(cavity, d);
  if (share <= 0.0) return 2.0 * cavity.radius;  // behind all other surfaces
  // Lobules carry smaller ones and lie on lumps four times their size.
  const double lobulet = LobeNoise(14.0 * d, cavity.seed + kSmallLobules);
  const double lump = 0.5 + 0.5 * GradientNoise(2.6 * d, cavity.seed + kLumps);
  const double base = cavity.capsule_front + (cavity.fat_distance - cavity.capsule_front) * share;
  return base -
         share * cavity.lobe_height * (1.3 * FatLobule(cavity, d) + 0.25 * lobulet + 0.9 * lump);
}

double CastEllipsoid(const Ellipsoid& e, const glm::dvec3& direction) {
  const glm::dquat body = glm::conjugate(e.portal_from_body);
  const glm::dvec3 o = (body * -e.centre) / e.radii, d = (body * direction) / e.radii;
  const double a = glm::dot(d, d), b = glm::dot(o, d), c = glm::dot(o, o) - 1.0;
  const double discriminant = b * b - a * c;
  if (discriminant < 0.0) return kNever;
  const double s = c / (-b + std::sqrt(discriminant));  // the nearer root, free of cancellation
  return s > 0.0 ? s : kNever;
}

CavityHit CastFromPortal(const Cavity& cavity, const glm::dvec3& d) {
  const double capsule = CapsuleDistance(cavity, d), fat = FatDistance(cavity, d);
  CavityHit hit{capsule, Surface::kCapsule, std::min(capsule, fat)};
  const auto offer = [&hit](double distance, Surface surface) {
    if (distance < hit.distance) hit.distance = distance, hit.surface = surface;
  };
  offer(fat, Surface::kFat);
  offer(CastEllipsoid(cavity.condyle, d), Surface::kCondyle);
  for (const Bundle& bundle : cavity.ligament) offer(CastBundle(bundle, d), Surface::kLigament);
  offer(CastPlateau(cavity.plateau, d, hit.distance), Surface::kPlateau);
  return hit;
}

namespace {

glm::dvec3 EllipsoidNormal(const Ellipsoid& e, const glm::dvec3& x) {
  const glm::dvec3 body = glm::conjugate(e.portal_from_body) * (x - e.centre);
  return glm::normalize(e.portal_from_body * (body / (e.radii * e.radii)));
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

glm::dvec3 NormalAt(const Cavity& cavity, Surface surface, const glm::dvec3& x, bool with_bed) {
  switch (surface) {
    case Surface::kCondyle:
      return EllipsoidNormal(cavity.condyle, x);
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
      double best = kNever;
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

double EllipsoidClearance(const Ellipsoid& e, const glm::dvec3& x) {
  const glm::dvec3 body = glm::conjugate(e.portal_from_body) * (x - e.centre);
  const double k0 = glm::length(body / e.radii), k1 = glm::length(body / (e.radii * e.radii));
  return k1 > 0.0 ? k0 * (k0 - 1.0) / k1 : -std::min({e.radii.x, e.radii.y, e.radii.z});
}

double Clearance(const Cavity& cavity, const glm::dvec3& x, bool with_bed) {
  const double length = glm::length(x);
  double clearance = length > 0.0 ? CapsuleBase(cavity, x / length) - length : cavity.radius;
  clearance = std::min(clearance, EllipsoidClearance(cavity.condyle, x));
  const glm::dvec3 p = Inverse(cavity.plateau.portal_from_plateau) * x;
  clearance = std::min(clearance, 0.9 * (p.z - PlateauHeight(cavity.plateau, p.x, p.y, with_bed)));
  for (const Bundle& bundle : cavity.ligament)
    clearance = std::min(clearance, BundleClearance(bundle, x));
  return clearance;
}

}  // namespace arthro::authoring
