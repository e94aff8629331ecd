#include "authoring/phantom/look/tissue_looks.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "authoring/phantom/shape/noise.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

// Noise channels: each draws its own values from the cavity's seed.
enum NoiseChannel : std::uint32_t {
  kCartilageCloud = 51,
  kCartilageGrain = 52,
  kCartilageMargin = 53,
  kCartilageFine = 54,
  kSynoviumRegion = 61,
  kSynoviumPatch = 62,
  kSynoviumNap = 65,
  kSynoviumVilli = 66,
  kSynoviumTips = 67,
  kFatCloud = 71,
  kFatGrain = 72,
  kFatVeil = 73,
  kSinewFibre = 81,
  kSinewCloud = 82,
  kSinewBundle = 83,
  kBedMargin = 91,
  kBedSpeckle = 92,
  kPlateauFringe = 93,
  kMeniscusFibre = 101,
  kMeniscusCloud = 102,
  kPlexusWarp = 111,
  kPlexusNet = 112,
  kPlexusFine = 113,
  kPlexusGaps = 114,
};
// The tibial cartilage draws other noise than the femoral one.
constexpr std::uint32_t kTibialSeed = 5;
constexpr double kNoWall = 1.0;  // m; no synovium behind, since the plateau has its own capsule

// Linear RGB of the tissues. No value here is measured: colours, sizes of features and their
// strengths are chosen to resemble arthroscopic pictures.
//   colour of a pixel = mixture of two colours, by a mean share plus an amplitude times noise
//   noise of x / (k mm) has features of about k mm; noise of k d about k features per rad
const glm::dvec3 kPearl(0.74, 0.71, 0.635), kIvory(0.74, 0.635, 0.47), kBlush(0.70, 0.44, 0.37);
const glm::dvec3 kSynovium(0.60, 0.165, 0.118), kSynoviumPale(0.80, 0.47, 0.36),
    kSynoviumDeep(0.40, 0.060, 0.047);
const glm::dvec3 kFat(0.88, 0.60, 0.15), kFatPale(0.92, 0.75, 0.34), kFatCrease(0.62, 0.23, 0.09);
const glm::dvec3 kSinew(0.82, 0.70, 0.54), kSinewShade(0.66, 0.47, 0.34), kBone(0.70, 0.47, 0.36);
const glm::dvec3 kVesselRed(0.34, 0.022, 0.026), kVesselDeep(0.25, 0.050, 0.075);

// Noise with its gradient, by differences.
struct Sloped {
  double value;
  glm::dvec3 slope;
};
template <class Noise>
Sloped WithSlope(const glm::dvec3& p, const Noise& noise) {
  constexpr double kStep = 0.05;
  const double value = noise(p);
  return {value, glm::dvec3(noise(p + glm::dvec3(kStep, 0, 0)) - value,
                            noise(p + glm::dvec3(0, kStep, 0)) - value,
                            noise(p + glm::dvec3(0, 0, kStep)) - value) /
                     kStep};
}

// Network of capillaries: lines of equal width along the zeros of a warped noise, which a broader
// noise interrupts. Returns the share of a point that blood covers.
double Plexus(const glm::dvec3& x, double size, double half_width, std::uint32_t seed) {
  const glm::dvec3 p = x / size;
  const double warp = 0.5 * GradientNoise(0.8 * p, seed + kPlexusWarp);
  const Sloped net =
      WithSlope(p + warp, [&](const glm::dvec3& q) { return GradientNoise(q, seed + kPlexusNet); });
  const double away = size * std::abs(net.value) / std::max(glm::length(net.slope), 0.35);
  const double open = SmoothStep(-0.05, 0.35, GradientNoise(0.45 * p, seed + kPlexusGaps));
  return open * SmoothStep(1.6 * half_width, 0.4 * half_width, away);
}

// Faint clouds with a few paler and yellower islands, as in the cartilage of a middle-aged knee,
// and a fine grain.
TissueLook Cartilage(const glm::dvec3& x, const Look& look, double wall_gap, std::uint32_t seed) {
  const glm::dvec3 mm = x / kMm;
  const double cloud = FractalNoise(mm / 9.0, 3, seed + kCartilageCloud),
               grain = FractalNoise(mm / 1.3, 3, seed + kCartilageGrain);
  const double fine = FractalNoise(mm / 0.40, 2, seed + kCartilageFine);
  TissueLook t;
  t.colour = Mix(kPearl, kIvory, 0.30 + look.texture * 0.75 * cloud);
  t.colour *= 1.0 + look.texture * (0.13 * grain + 0.07 * cloud + 0.15 * fine);
  // Reddens the margin that synovium creeps over.
  const double ragged = 2.4 * FractalNoise(mm / 3.0, 3, seed + kCartilageMargin) + 1.2 * grain;
  constexpr double kMarginFrom = 5.0, kMarginTo = 0.3;  // mm from the synovium behind
  const double margin = SmoothStep(kMarginFrom, kMarginTo, wall_gap / kMm + 1.4 * ragged);
  t.colour = Mix(t.colour, kBlush, 0.85 * margin);
  if (margin > 0.0)
    t.colour = Mix(t.colour, kVesselRed,
                   0.6 * look.vessels * margin * Plexus(x, 1.6 * kMm, 0.045 * kMm, seed));
  t.depth = 0.32;
  return t;
}

TissueLook Synovium(const Cavity& cavity, const VesselTrees& vessels, const Look& look,
                    const SurfacePoint& p) {
  const std::uint32_t seed = cavity.seed;
  const glm::dvec3& d = p.direction;
  const glm::dvec3 mm = p.x / kMm;
  const double region = FractalNoise(2.2 * d, 3, seed + kSynoviumRegion),
               patch = FractalNoise(7.5 * d, 3, seed + kSynoviumPatch);
  // Villi and granules: rounded tops with dark gaps, where the synovium is inflamed; elsewhere a
  // smooth translucent membrane.
  const double villous = SmoothStep(-0.22, 0.30, region + 0.7 * patch);
  const double villi = LobeNoise(mm / 0.62, seed + kSynoviumVilli);
  const double tips = LobeNoise(mm / 0.31, seed + kSynoviumTips);
  const double nap = FractalNoise(mm / 0.5, 2, seed + kSynoviumNap);
  TissueLook t;
  t.colour = Mix(kSynoviumPale, kSynovium, 0.42 + look.texture * (1.1 * region + 0.5 * patch));
  t.colour = Mix(t.colour, kSynoviumDeep,
                 look.texture * 0.6 * SmoothStep(0.02, 0.42, patch + 0.3 * region));
  t.colour *= 1.0 + look.texture * (0.34 * nap + (0.42 + 0.62 * villous) * (villi - 0.6) +
                                    (0.14 + 0.32 * villous) * (tips - 0.6));
  t.colour = Mix(t.colour, kVesselRed,
                 0.80 * look.vessels * Plexus(p.x, 1.0 * kMm, 0.045 * kMm, seed + kPlexusFine));
  const VesselTrees::Cover vessel = vessels.At(d);
  t.colour = Mix(t.colour, Mix(kVesselRed, kVesselDeep, vessel.depth),
                 0.80 * look.vessels * vessel.amount);
  t.depth = 0.22;
  return t;
}

// Lobules of fat; `lobule` is 0 in the creases between them and 1 on their tops, `veil_gap` the
// distance to the synovium that covers their border, m.
TissueLook Fat(const Cavity& cavity, const VesselTrees& vessels, const Look& look,
               const SurfacePoint& p, double lobule, double veil_gap) {
  const std::uint32_t seed = cavity.seed;
  const glm::dvec3& d = p.direction;
  const double cloud = FractalNoise(5.0 * d, 3, seed + kFatCloud);
  const double grain = FractalNoise(p.x / (0.6 * kMm), 4, seed + kFatGrain);
  TissueLook t;
  t.colour = Mix(kFat, kFatPale, 0.40 + look.texture * (1.3 * cloud));
  t.colour *= 1.0 + look.texture * 0.55 * grain;
  // The light comes from the viewer, so creases are dark and hold vessels instead of shadows.
  const double crease = SmoothStep(0.55, 0.12, lobule);
  t.colour = Mix(t.colour, kFatCrease, 0.45 * crease) * (1.0 - 0.38 * crease);
  // A red film of synovium covers the pad and is thickest at its border.
  const double veil = 0.30 * FractalNoise(4.0 * d, 3, seed + kFatVeil);
  t.colour = Mix(t.colour, kFatCrease, 0.8 * look.texture * SmoothStep(-0.02, 0.22, veil));
  constexpr double kBorderFrom = 9.0, kBorderTo = 1.0;  // mm from the synovium behind
  t.colour = Mix(t.colour, kSynoviumPale,
                 0.8 * SmoothStep(kBorderFrom, kBorderTo, veil_gap / kMm + 9.0 * veil));
  const VesselTrees::Cover vessel = vessels.At(d);
  t.colour =
      Mix(t.colour, Mix(kVesselRed, kVesselDeep, vessel.depth), 0.6 * look.vessels * vessel.amount);
  t.depth = 0.3;
  return t;
}

// Tendinous tissue with fibre bundles along a unit direction; coordinates in m.
TissueLook Fibrous(const glm::dvec3& x, const glm::dvec3& along, const Look& look,
                   std::uint32_t seed) {
  const glm::dvec3 mm = x / kMm;
  const double t_along = glm::dot(mm, along);
  const glm::dvec3 across = mm - t_along * along;
  constexpr double kFibreWidth = 0.34, kFibreLength = 7.0;    // mm
  constexpr double kBundleWidth = 1.1, kBundleLength = 14.0;  // mm
  const Sloped fibre =
      WithSlope(across / kFibreWidth + along * (t_along / kFibreLength),
                [&](const glm::dvec3& q) { return FractalNoise(q, 2, seed + kSinewFibre); });
  const double bundle =
      GradientNoise(across / kBundleWidth + along * (t_along / kBundleLength), seed + kSinewBundle);
  const double cloud = FractalNoise(mm / 6.0, 2, seed + kSinewCloud);
  TissueLook t;
  t.colour = Mix(kSinew, kSinewShade, 0.30 + look.texture * (0.5 * cloud + 0.55 * bundle));
  t.colour *= 1.0 + look.texture * 0.72 * fibre.value;
  t.slope = look.texture * 0.27 * (fibre.slope - glm::dot(fibre.slope, along) * along);
  t.depth = 0.25;
  return t;
}

// Cruciate ligament or tendon: bundles of fibres under a thin sheath of synovium, which is thick
// and red at both insertions and carries vessels along the ligament.
TissueLook Ligament(const Cavity& cavity, const Look& look, const SurfacePoint& p) {
  const BundlePlace place = NearestBundle(cavity, p.x);
  const Bundle& bundle = cavity.ligament[place.bundle];
  const glm::dvec3 along = glm::normalize(bundle.to - bundle.from);
  TissueLook t = Fibrous(p.x, along, look, cavity.seed);
  const double cloud = FractalNoise(p.x / (2.5 * kMm), 3, cavity.seed + kPlateauFringe);
  const double ends = std::max(SmoothStep(0.22, 0.04, place.share + 0.12 * cloud),
                               SmoothStep(0.62, 0.92, place.share + 0.12 * cloud));
  const double sheath = std::clamp(0.75 * ends + SmoothStep(0.05, 0.5, cloud) * 0.35, 0.0, 1.0);
  t.colour = Mix(t.colour, Mix(kBlush, kSynovium, 0.35), sheath);
  // The vessels of the sheath run along it.
  const glm::dvec3 drawn = p.x - 0.72 * glm::dot(p.x, along) * along;
  t.colour = Mix(t.colour, kVesselRed,
                 look.vessels * (0.30 + 0.4 * sheath) *
                     Plexus(drawn, 1.5 * kMm, 0.045 * kMm, cavity.seed + kSinewBundle));
  return t;
}

TissueLook PlateauLook(const Cavity& cavity, const VesselTrees& vessels, const Look& look,
                       const SurfacePoint& p) {
  const Plateau& plateau = cavity.plateau;
  TissueLook t = Cartilage(p.x, look, kNoWall, cavity.seed + kTibialSeed);
  const glm::dvec3 q = Inverse(plateau.portal_from_plateau) * p.x;
  const glm::dvec3 mm = p.x / kMm;
  // Bed of the cartilage layer: bone shows through the remaining cartilage, away from the seam.
  const double ragged = 0.06 * FractalNoise(mm / 1.6, 3, cavity.seed + kBedMargin);
  const double bed = SmoothStep(0.88, 0.68, BedShare(plateau.bed, q.x, q.y) + ragged);
  const double speckle = FractalNoise(mm / 0.8, 3, cavity.seed + kBedSpeckle);
  t.colour = Mix(t.colour, kBone * (1.0 + 0.5 * look.texture * speckle), 0.45 * bed);

  const PlateauCover cover = CoverAt(plateau, q.x, q.y);
  const double fringe = 0.5 * FractalNoise(mm / 2.5, 3, cavity.seed + kPlateauFringe);
  const auto cover_with = [&t](const TissueLook& other, double share) {
    share = std::clamp(share, 0.0, 1.0);
    t.colour = Mix(t.colour, other.colour, share);
    t.slope = Mix(t.slope, other.slope, share);
    t.depth += share * (other.depth - t.depth);
  };
  const auto in_portal = [&](const glm::dvec2& level) {
    return plateau.portal_from_plateau.rotation * glm::dvec3(level, 0.0);
  };
  // Between the compartments a thin synovium covers the bone; the tubercles' tops stay pale.
  const double strip = SmoothStep(
      1.7, 0.75,
      std::abs(q.x - 0.5 * (plateau.eminence[0].centre.x + plateau.eminence[1].centre.x)) /
              (5.0 * kMm) +
          0.9 * fringe);
  if (strip > 0.0) {
    TissueLook veil = Synovium(cavity, vessels, look, p);
    veil.colour = Mix(veil.colour, kSinew, 0.45);
    cover_with(veil, 0.85 * strip * (1.0 - SmoothStep(0.35, 0.8, cover.eminence + 0.5 * fringe)));
  }
  if (cover.fibre > 0.0) {
    TissueLook fibres = Fibrous(p.x, in_portal(cover.along), look, cavity.seed);
    fibres.colour = Mix(fibres.colour, kPearl, 0.35);
    cover_with(fibres, cover.fibre);
  }
  if (cover.capsule > 0.0)
    cover_with(Synovium(cavity, vessels, look, p), cover.capsule + fringe * cover.capsule);
  if (cover.lobule > 0.0)
    cover_with(Fat(cavity, vessels, look, p, SlopeLobule(plateau, q.x, q.y),
                   (1.0 - cover.lobule) * 9.0 * kMm),
               cover.lobule + 0.6 * fringe);
  t.colour = Mix(t.colour, kSynoviumDeep, 0.75 * cover.hiatus);
  return t;
}

TissueLook Meniscus(const Cavity& cavity, const Look& look, const SurfacePoint& p) {
  const glm::dvec3 mm = p.x / kMm;
  const glm::dvec3 q = Inverse(cavity.plateau.portal_from_plateau) * p.x / kMm;
  const double angle = std::atan2(q.y, q.x), r = std::hypot(q.x, q.y);
  constexpr double kFibreWidth = 0.45;  // mm
  constexpr double kFibresPerRadian = 2.2;
  const double fibre = FractalNoise({r / kFibreWidth, q.z / kFibreWidth, angle * kFibresPerRadian},
                                    3, cavity.seed + kMeniscusFibre);
  const double cloud = FractalNoise(mm / 5.0, 2, cavity.seed + kMeniscusCloud);
  TissueLook t;
  t.colour = Mix(kPearl, kIvory, 0.45 + look.texture * (0.7 * cloud));
  t.colour *= 1.0 + look.texture * 0.22 * fibre;
  // Blood vessels reach the outer third: shares of the width from the free edge.
  constexpr double kVascularFrom = 0.62, kVascularTo = 1.05;
  const double red = SmoothStep(kVascularFrom, kVascularTo, p.rim + 0.35 * cloud);
  t.colour = Mix(t.colour, kBlush, 0.75 * red);
  if (red > 0.0)
    t.colour = Mix(t.colour, kVesselRed,
                   0.5 * look.vessels * red * Plexus(p.x, 1.3 * kMm, 0.04 * kMm, cavity.seed));
  t.depth = 0.34;
  return t;
}

}  // namespace

TissueLook LookAt(const Cavity& cavity, const VesselTrees& vessels, const Look& look,
                  const SurfacePoint& p) {
  switch (p.surface) {
    case Surface::kFat:
      return Fat(cavity, vessels, look, p, FatLobule(cavity, p.direction), p.wall_gap);
    case Surface::kCondyle:
      return Cartilage(p.x, look, p.wall_gap, cavity.seed);
    case Surface::kPlateau:
      return PlateauLook(cavity, vessels, look, p);
    case Surface::kLigament:
      return Ligament(cavity, look, p);
    case Surface::kMeniscus:
      return Meniscus(cavity, look, p);
    case Surface::kCartilage:
      return Cartilage(p.x, look, kNoWall, cavity.seed + kTibialSeed);
    default:
      return Synovium(cavity, vessels, look, p);
  }
}

}  // namespace arthro::authoring
