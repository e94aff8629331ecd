#include "authoring/phantom/shape/cavity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include <glm/geometric.hpp>

#include "authoring/phantom/shape/crescent.h"
#include "authoring/phantom/shape/noise.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// Noise channels: each draws its own values from the cavity's seed. Noise of k d, d a unit
// direction, has about k features per rad.
enum WallNoise : std::uint32_t {
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

// Root of a function that is positive at `outside` and not at `inside`, to a picometre: false
// position, with the Illinois rule that halves the value of an end that stays.
template <class Function>
double RootBetween(const Function& f, double outside, double inside) {
  double f_outside = f(outside), f_inside = f(inside);
  constexpr double kExact = 1e-12;  // m
  int stays = 0;
  for (int i = 0; i < 60 && inside - outside > kExact; ++i) {
    const double middle = std::clamp(
        (outside * f_inside - inside * f_outside) / (f_inside - f_outside), outside, inside);
    const double value = f(middle);
    if (std::abs(value) < kExact) return middle;
    if (value > 0.0) {
      outside = middle, f_outside = value;
      if (stays > 0) f_inside *= 0.5;
      stays = 1;
    } else {
      inside = middle, f_inside = value;
      if (stays < 0) f_outside *= 0.5;
      stays = -1;
    }
  }
  return 0.5 * (outside + inside);
}

// Range of heights that holds the visible plateau; m.
constexpr double kPlateauTop = 30.0 * kMm, kPlateauBottom = -16.0 * kMm;

// Walks by a share of the clearance until below the height field.
double CastPlateau(const Plateau& plateau, const glm::dvec3& direction, double limit) {
  const Rigid3 plateau_from_portal = Inverse(plateau.portal_from_plateau);
  const glm::dvec3 o = plateau_from_portal.translation,
                   d = plateau_from_portal.rotation * direction;
  const bool is_downward = d.z < -1e-3;
  double s = is_downward ? std::max((kPlateauTop - o.z) / d.z, 0.0) : 0.0;
  const double end = is_downward ? std::min((kPlateauBottom - o.z) / d.z, limit) : limit;
  constexpr double kStep = 0.3 * kMm;  // finer than anything on the plateau
  const auto above = [&](double at) { return PlateauClearance(plateau, o + at * d, true, kStep); };
  constexpr double kShare =
      0.75;  // share of the clearance, since lobules are steeper than it knows
  double last = s, height = above(s);
  while (height > 0.0) {
    if (s > end) return kNever;
    last = s;
    s += std::max(kStep, kShare * height);
    height = above(s);
  }
  return RootBetween(above, last, s);
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

// Share of the fat pad in a direction, 0 to 1: below and in front, more on the lateral side.
double FatShare(const Cavity& cavity, const glm::dvec3& d) {
  constexpr double kFatFrom = 0.38,
                   kFatTo = 0.80;    // sine of the depression; full pad from kFatTo on
  constexpr double kLateral = 0.16;  // preference of the lateral side
  const double edge = 0.24 * GradientNoise(2.3 * d, cavity.seed + kFatMarginBroad) +
                      0.08 * GradientNoise(6.0 * d, cavity.seed + kFatMarginFine);
  return SmoothStep(kFatFrom, kFatTo, d.y - kLateral * d.x + edge);
}

// Cross-section of a ligament: one bundle in the middle and the others around it.
glm::dvec2 PlaceInSection(std::size_t i, std::size_t count) {
  if (i == 0) return glm::dvec2(0.0);
  const double angle =
      2.0 * std::numbers::pi * static_cast<double>(i - 1) / static_cast<double>(count - 1);
  return {std::cos(angle), std::sin(angle)};
}

// Bundles between two places, in elliptic sections that turn by `twist` between them.
struct Section {
  glm::dvec3 centre, across, along;  // half axes
};
void MakeBundles(std::span<Bundle> bundles, const Section& from, const Section& to, double twist,
                 double radius, Random& random) {
  const glm::dvec2 turn(std::cos(twist), std::sin(twist));
  for (std::size_t i = 0; i < bundles.size(); ++i) {
    const glm::dvec2 u = PlaceInSection(i, bundles.size());
    const glm::dvec2 v(turn.x * u.x - turn.y * u.y, turn.y * u.x + turn.x * u.y);
    bundles[i].from =
        from.centre + u.x * from.across + u.y * from.along + Jitter(random, 0.2 * kMm);
    bundles[i].to = to.centre + v.x * to.across + v.y * to.along + Jitter(random, 0.2 * kMm);
    bundles[i].radius = radius * random.Uniform(0.88, 1.12);
  }
}

// Everything that joins the bones: lateral condyle, eminence, roots, capsule, ligaments. Draws from
// a sequence of its own, so that the bones of a seed do not depend on it.
void MakeSoftTissue(Cavity& cavity) {
  Random random(0x50F7715ull + cavity.seed);
  Plateau& plateau = cavity.plateau;
  plateau.seed = cavity.seed;
  plateau.lobule_height = random.Near(1.5, 0.1) * kMm;
  const Tubercle& medial = plateau.eminence[0];
  plateau.eminence[1] = {medial.centre + glm::dvec2(-6.2, -1.5) * kMm,
                         glm::dvec2(random.Near(2.7, 0.1), random.Near(4.6, 0.1)) * kMm,
                         random.Near(3.0, 0.12) * kMm};
  plateau.footprint = {
      0.5 * (medial.centre + plateau.eminence[1].centre) + glm::dvec2(0.6, -5.5) * kMm,
      glm::dvec2(5.0, 5.5) * kMm, random.Near(1.7, 0.1) * kMm};

  // The capsule begins beyond the bulge of the meniscus.
  const Crescent crescent = MakeCrescent(cavity);
  constexpr double kBeyondRim = 1.25 * kMm;
  CapsuleBorder& border = plateau.border;
  border.medial = crescent.centre;
  border.medial_radii = glm::dvec2(crescent.outer_x, crescent.outer_y) + kBeyondRim;
  border.lateral_x = medial.centre.x - random.Uniform(11.5, 12.5) * kMm;
  border.lateral_radius = random.Near(11.5, 0.03) * kMm;
  border.height = random.Near(9.0, 0.06) * kMm;
  border.front_height = random.Near(2.4, 0.06) * kMm;
  border.reach = random.Near(2.4, 0.05) * kMm;
  border.hiatus_depth = random.Near(3.2, 0.1) * kMm;
  border.hiatus_angle = RadiansFromDegrees(random.Uniform(118.0, 128.0));
  plateau.lateral_meniscus = {random.Near(7.6, 0.04) * kMm, random.Near(4.4, 0.05) * kMm};
  for (const bool posterior : {false, true}) {
    const double angle = posterior ? crescent.to : crescent.from, onwards = posterior ? 1.0 : -1.0;
    const Wedge wedge = WedgeAt(crescent, angle);
    const double r = OuterRadius(crescent, angle) - 0.42 * wedge.width;
    const glm::dvec2 out(std::cos(angle), std::sin(angle)), tangent(-out.y, out.x);
    MeniscalRoot& root = plateau.roots[posterior ? 1 : 0];
    // The root encloses the end of the horn.
    root.from = crescent.centre + r * out - 0.8 * kMm * onwards * tangent;
    root.to = root.from + random.Near(posterior ? 6.5 : 8.5, 0.06) * kMm *
                              glm::normalize(onwards * tangent - 0.15 * out);
    root.half_width = 1.0 * wedge.width;
    root.height = 1.3 * wedge.height;
  }

  // The lateral condyle bounds the notch opposite the medial one; the trochlea joins both above.
  cavity.lateral_condyle.centre = glm::dvec3(-32.0, -23.5, 30.5) * kMm + Jitter(random, 0.5 * kMm);
  cavity.lateral_condyle.radii =
      glm::dvec3(random.Near(16.0, 0.02), random.Near(22.5, 0.02), random.Near(18.0, 0.02)) * kMm;
  cavity.lateral_condyle.portal_from_body =
      glm::angleAxis(RadiansFromDegrees(random.Uniform(-6.0, 0.0)), glm::dvec3(0, 0, 1));

  cavity.trochlea.centre = glm::dvec3(-13.0, -38.5, 29.0) * kMm + Jitter(random, 0.5 * kMm);
  cavity.trochlea.radii = glm::dvec3(20.0, 13.0, 16.0) * kMm;

  const auto on_bone = [&](const glm::dvec2& at, double sunk) {
    return plateau.portal_from_plateau *
           glm::dvec3(at.x, at.y, BoneHeight(plateau, at.x, at.y) - sunk);
  };
  const std::span<Bundle> all(cavity.ligament);
  const glm::dquat& turn = plateau.portal_from_plateau.rotation;
  const glm::dvec3 right = turn * glm::dvec3(1, 0, 0), back = turn * glm::dvec3(0, 1, 0);
  // Anterior cruciate ligament: from its footprint in front of the eminence up, back and outwards
  // to the wall of the lateral condyle.
  const glm::dvec2 foot = 0.5 * (medial.centre + plateau.eminence[1].centre);
  MakeBundles(all.first(kAnteriorBundles),
              {on_bone(plateau.footprint.centre, 4.2 * kMm), 2.5 * kMm * right, 3.2 * kMm * back},
              {cavity.lateral_condyle.centre + glm::dvec3(10.8, 9.6, 5.0) * kMm,
               glm::dvec3(0.4, 1.6, 0.6) * kMm, glm::dvec3(0.2, -0.6, 2.4) * kMm},
              RadiansFromDegrees(75.0), 2.3 * kMm, random);
  // Posterior cruciate ligament: from the wall of the medial condyle back and down behind the
  // eminence.
  MakeBundles(
      all.subspan(kAnteriorBundles, kPosteriorBundles),
      {cavity.condyle.centre + glm::dvec3(-11.0, 10.0, 9.5) * kMm, glm::dvec3(0.5, 1.8, 0.0) * kMm,
       glm::dvec3(0.0, 0.6, 2.0) * kMm},
      {on_bone(foot + glm::dvec2(3.5, 14.5) * kMm, 1.0 * kMm), 2.2 * kMm * right, 1.0 * kMm * back},
      RadiansFromDegrees(40.0), 2.2 * kMm, random);
  // Popliteus tendon: from the lateral condyle obliquely down through the hiatus.
  const double angle = border.hiatus_angle;
  const glm::dvec2 through(border.lateral_x + (border.lateral_radius + 1.5 * kMm) * std::cos(angle),
                           border.medial.y + (border.medial_radii.y + 1.5 * kMm) * std::sin(angle));
  all.back() = {on_bone(through + glm::dvec2(-3.5, -2.0) * kMm, -9.0 * kMm),
                on_bone(through + glm::dvec2(2.0, 1.0) * kMm, 2.0 * kMm),
                random.Near(2.0, 0.05) * kMm};
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
  plateau.eminence[0].centre =
      glm::dvec2(random.Uniform(-17.5, -16.0), random.Uniform(0.0, 4.0)) * kMm;
  plateau.eminence[0].radii = glm::dvec2(random.Near(2.9, 0.1), random.Near(5.4, 0.1)) * kMm;
  plateau.eminence[0].height = random.Near(4.2, 0.12) * kMm;
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

  MakeSoftTissue(cavity);
  return cavity;
}

double CapsuleBase(const Cavity& cavity, const glm::dvec3& d) {
  const double front = SmoothStep(0.58, 0.96, d.z - 0.08 * d.x);
  const double base = cavity.capsule_side + (cavity.capsule_front - cavity.capsule_side) * front;
  // Overhead the synovium reaches down to its junction with the condyle.
  if (d.y > -0.45) return base;
  constexpr double kOverheadFrom = 0.74;  // sine of the elevation
  const double ragged = 0.22 * GradientNoise(1.9 * d, cavity.seed + kOverhangMargin);
  return base - cavity.overhang * SmoothStep(kOverheadFrom, 1.0, -d.y + ragged);
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

namespace {

// Walks by a share of the clearance until inside.
double CastFemur(const Cavity& cavity, const glm::dvec3& d, double limit) {
  constexpr double kShare = 0.9, kLeastStep = 0.05 * kMm;
  double s = 0.0, last = 0.0;
  double clearance = FemurClearance(cavity, glm::dvec3(0.0));
  while (clearance > 0.0) {
    last = s;
    s += std::max(kLeastStep, kShare * clearance);
    if (s > limit) return kNever;
    clearance = FemurClearance(cavity, s * d);
  }
  return RootBetween([&](double at) { return FemurClearance(cavity, at * d); }, last, s);
}

}  // namespace

double WallDistance(const Cavity& cavity, const glm::dvec3& d) {
  return std::min(CapsuleDistance(cavity, d), FatDistance(cavity, d));
}

CavityHit CastFromPortal(const Cavity& cavity, const glm::dvec3& d) {
  const double capsule = CapsuleDistance(cavity, d), fat = FatDistance(cavity, d);
  CavityHit hit{capsule, Surface::kCapsule};
  const auto offer = [&hit](double distance, Surface surface) {
    if (distance < hit.distance) hit.distance = distance, hit.surface = surface;
  };
  offer(fat, Surface::kFat);
  offer(CastFemur(cavity, d, hit.distance), Surface::kCondyle);
  for (const Bundle& bundle : cavity.ligament) offer(CastBundle(bundle, d), Surface::kLigament);
  offer(CastPlateau(cavity.plateau, d, hit.distance), Surface::kPlateau);
  return hit;
}

}  // namespace arthro::authoring
