#include "authoring/phantom/appearance.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "authoring/phantom/noise.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

constexpr double kMm = kMetrePerMillimetre;

// Position of the light, beside the scope's lens.
constexpr glm::dvec3 kLight(0.8 * kMm, -2.6 * kMm, 0.0);
constexpr double kLightReference = 30.0 * kMm;  // distance of unit light
// Exponent of the falloff with distance. It is below 2 because of the camera's exposure control and
// of light scattered within the joint.
constexpr double kFalloff = 1.05;

struct Tissue {
  glm::dvec3 colour{0.5};
  double wetness = 0.5;    // strength of highlights
  double roughness = 0.1;  // slope of the wet film's ripples
  double depth = 0.2;      // share by which light wraps round inside the tissue
};

// Noise channels: each draws its own values from the cavity's seed.
enum NoiseChannel : std::uint32_t {
  kCartilageCloud = 51,
  kCartilageGrain = 52,
  kCartilageMargin = 53,
  kSynoviumRegion = 61,
  kSynoviumPatch = 62,
  kSynoviumCombX = 63,
  kSynoviumCombY = 64,
  kSynoviumNap = 65,
  kFatCloud = 71,
  kFatGrain = 72,
  kFatVeil = 73,
  kSinewFibre = 81,
  kSinewCloud = 82,
  kBedMargin = 91,
  kBedSpeckle = 92,
  kPlateauFringe = 93,
  kMeniscusFibre = 101,
  kMeniscusCloud = 102,
  kRippleX = 111,
  kRippleY = 112,
  kRippleZ = 113,
  kPools = 121,
  kDimpleX = 131,
  kDimpleY = 132,
  kDimpleZ = 133,
};
// The tibial cartilage draws other noise than the femoral one.
constexpr std::uint32_t kTibialSeed = 5;

glm::dvec3 Mix(const glm::dvec3& a, const glm::dvec3& b, double t) {
  return a + (b - a) * std::clamp(t, 0.0, 1.0);
}

// Linear RGB of the tissues. No value here is measured: colours, sizes of features and their
// strengths are chosen to resemble arthroscopic pictures.
//   colour of a pixel = mixture of two colours, by a mean share plus an amplitude times noise
//   noise of x / (k mm) has features of about k mm; noise of k d about k features per rad
const glm::dvec3 kPearl(0.82, 0.755, 0.64), kIvory(0.80, 0.675, 0.48), kBlush(0.70, 0.47, 0.40);
const glm::dvec3 kSynovium(0.60, 0.165, 0.118), kSynoviumPale(0.78, 0.40, 0.29),
    kSynoviumDeep(0.42, 0.068, 0.052);
const glm::dvec3 kFat(0.86, 0.58, 0.12), kFatPale(0.90, 0.72, 0.30), kFatCrease(0.62, 0.23, 0.09);
const glm::dvec3 kSinew(0.82, 0.68, 0.50), kBone(0.70, 0.47, 0.36);
const glm::dvec3 kBounceColour(0.115, 0.066, 0.054);  // reflected by all other walls
const glm::dvec3 kHazeColour(0.40, 0.31, 0.27);       // light scattered by cloudy water
const glm::dvec3 kVesselRed(0.30, 0.020, 0.026), kVesselDeep(0.25, 0.050, 0.075);

// Faint clouds with a few paler and yellower islands, as in the cartilage of a middle-aged knee.
Tissue Cartilage(const glm::dvec3& x, const Look& look, double wall_gap, std::uint32_t seed) {
  const glm::dvec3 mm = x / kMm;
  const double cloud = FractalNoise(mm / 9.0, 3, seed + kCartilageCloud),
               grain = FractalNoise(mm / 1.3, 3, seed + kCartilageGrain);
  Tissue t;
  t.colour = Mix(kPearl, kIvory, 0.42 + look.texture * 0.75 * cloud);
  t.colour *= 1.0 + look.texture * (0.10 * grain + 0.07 * cloud);
  // Reddens the margin that synovium creeps over.
  const double ragged = 2.4 * FractalNoise(mm / 3.0, 3, seed + kCartilageMargin) + 1.2 * grain;
  constexpr double kMarginFrom = 7.5, kMarginTo = 0.5;  // mm from the synovium behind
  t.colour = Mix(t.colour, kBlush,
                 0.9 * SmoothStep(kMarginFrom, kMarginTo, wall_gap / kMm + 1.6 * ragged));
  t.wetness = 0.55;
  t.roughness = 0.035;
  t.depth = 0.32;
  return t;
}

Tissue Synovium(const Cavity& cavity, const VesselTrees& vessels, const Look& look,
                const SurfacePoint& p) {
  const std::uint32_t seed = cavity.seed;
  const glm::dvec3& d = p.direction;
  const double region = FractalNoise(2.2 * d, 3, seed + kSynoviumRegion),
               patch = FractalNoise(7.5 * d, 3, seed + kSynoviumPatch);
  // Villi: a short nap with varying direction.
  const glm::dvec3 comb(GradientNoise(3.0 * d, seed + kSynoviumCombX),
                        GradientNoise(3.0 * d, seed + kSynoviumCombY), 0.0);
  const double nap = FractalNoise(58.0 * d + 6.0 * comb, 3, seed + kSynoviumNap);
  Tissue t;
  t.colour = Mix(kSynovium, kSynoviumPale, 0.34 + look.texture * (1.25 * region + 0.55 * patch));
  t.colour = Mix(t.colour, kSynoviumDeep,
                 look.texture * 0.6 * SmoothStep(0.02, 0.42, -patch - 0.3 * region));
  t.colour *= 1.0 + look.texture * 0.26 * nap;
  const VesselTrees::Cover vessel = vessels.At(d);
  t.colour = Mix(t.colour, Mix(kVesselRed, kVesselDeep, vessel.depth),
                 0.80 * look.vessels * vessel.amount);
  t.wetness = 0.8;
  t.roughness = 0.16;
  t.depth = 0.22;
  return t;
}

Tissue Fat(const Cavity& cavity, const VesselTrees& vessels, const Look& look,
           const SurfacePoint& p) {
  const std::uint32_t seed = cavity.seed;
  const glm::dvec3& d = p.direction;
  const double cloud = FractalNoise(5.0 * d, 3, seed + kFatCloud),
               grain = FractalNoise(34.0 * d, 2, seed + kFatGrain);
  Tissue t;
  t.colour = Mix(kFat, kFatPale, 0.40 + look.texture * (1.3 * cloud + 0.25 * grain));
  // The light comes from the viewer, so creases are dark and hold vessels instead of shadows.
  const double crease = SmoothStep(0.55, 0.12, FatLobule(cavity, d));
  t.colour = Mix(t.colour, kFatCrease, 0.45 * crease) * (1.0 - 0.38 * crease);
  // A red film of synovium covers the pad and is thickest at its border.
  const double veil = 0.30 * FractalNoise(4.0 * d, 3, seed + kFatVeil);
  t.colour = Mix(t.colour, kFatCrease, look.texture * SmoothStep(-0.02, 0.22, veil));
  constexpr double kBorderFrom = 9.0, kBorderTo = 1.0;  // mm from the synovium behind
  t.colour = Mix(t.colour, kSynoviumPale,
                 0.8 * SmoothStep(kBorderFrom, kBorderTo, p.wall_gap / kMm + 9.0 * veil));
  const VesselTrees::Cover vessel = vessels.At(d);
  t.colour =
      Mix(t.colour, Mix(kVesselRed, kVesselDeep, vessel.depth), 0.6 * look.vessels * vessel.amount);
  t.wetness = 0.9;
  t.roughness = 0.12;
  t.depth = 0.3;
  return t;
}

Tissue Sinew(const Cavity& cavity, const Look& look, const SurfacePoint& p) {
  // Fibres along the band: noise stretched along it.
  const glm::dvec3 along = glm::normalize(cavity.ligament[2].to - cavity.ligament[2].from);
  const glm::dvec3 mm = p.x / kMm;
  const double t_along = glm::dot(mm, along);
  const glm::dvec3 across = mm - t_along * along;
  constexpr double kFibreWidth = 0.55, kFibreLength = 9.0;  // mm
  const double fibre = FractalNoise(across / kFibreWidth + along * (t_along / kFibreLength), 3,
                                    cavity.seed + kSinewFibre);
  const double cloud = FractalNoise(mm / 6.0, 2, cavity.seed + kSinewCloud);
  Tissue t;
  t.colour = Mix(kSinew, kBlush, 0.30 + look.texture * (0.9 * cloud));
  t.colour *= 1.0 + look.texture * 0.34 * fibre;
  t.wetness = 0.6;
  t.roughness = 0.12;
  t.depth = 0.25;
  return t;
}

Tissue PlateauTissue(const Cavity& cavity, const Look& look, const SurfacePoint& p) {
  Tissue t = Cartilage(p.x, look, p.wall_gap, cavity.seed + kTibialSeed);
  const glm::dvec3 q = Inverse(cavity.plateau.portal_from_plateau) * p.x;
  const glm::dvec3 mm = p.x / kMm;
  // Bed of the cartilage layer: bone shows through the remaining cartilage.
  const double ragged = 0.10 * FractalNoise(mm / 1.6, 3, cavity.seed + kBedMargin);
  const double bed = SmoothStep(1.0, 0.80, BedShare(cavity.plateau.bed, q.x, q.y) + ragged);
  const double speckle = FractalNoise(mm / 0.8, 3, cavity.seed + kBedSpeckle);
  t.colour = Mix(t.colour, kBone * (1.0 + 0.5 * look.texture * speckle), 0.45 * bed);
  // Synovium and fibres cover the spine and the outer rim.
  const glm::dvec2 from_spine =
      (glm::dvec2(q.x, q.y) - cavity.plateau.spine) / cavity.plateau.spine_radii;
  const double fringe = 0.5 * FractalNoise(mm / 2.5, 3, cavity.seed + kPlateauFringe);
  t.colour = Mix(t.colour, kBlush, 0.85 * SmoothStep(1.25, 0.55, glm::length(from_spine) + fringe));
  const double u =
      q.x / (q.x > 0.0 ? cavity.plateau.half_width_medial : cavity.plateau.half_width_lateral);
  const double v = q.y / cavity.plateau.half_depth;
  const double outline = std::sqrt(std::sqrt(u * u * u * u + v * v * v * v));
  t.colour = Mix(t.colour, Mix(kBlush, kSynovium, 0.5 + fringe),
                 SmoothStep(0.93, 1.12, outline + 0.35 * fringe));
  t.roughness += 0.1 * bed;
  return t;
}

Tissue Meniscus(const Cavity& cavity, const Look& look, const SurfacePoint& p) {
  const glm::dvec3 mm = p.x / kMm;
  const glm::dvec3 q = Inverse(cavity.plateau.portal_from_plateau) * p.x / kMm;
  const double angle = std::atan2(q.y, q.x), r = std::hypot(q.x, q.y);
  constexpr double kFibreWidth = 0.45;  // mm
  constexpr double kFibresPerRadian = 2.2;
  const double fibre = FractalNoise({r / kFibreWidth, q.z / kFibreWidth, angle * kFibresPerRadian},
                                    3, cavity.seed + kMeniscusFibre);
  const double cloud = FractalNoise(mm / 5.0, 2, cavity.seed + kMeniscusCloud);
  Tissue t;
  t.colour = Mix(kPearl, kIvory, 0.55 + look.texture * (0.7 * cloud));
  t.colour *= 1.0 + look.texture * 0.20 * fibre;
  // Blood vessels reach the outer third: shares of the width from the free edge.
  constexpr double kVascularFrom = 0.62, kVascularTo = 1.05;
  t.colour =
      Mix(t.colour, kBlush, 0.75 * SmoothStep(kVascularFrom, kVascularTo, p.rim + 0.35 * cloud));
  t.wetness = 0.65;
  t.roughness = 0.05;
  t.depth = 0.34;
  return t;
}

Tissue TissueAt(const Cavity& cavity, const VesselTrees& vessels, const Look& look,
                const SurfacePoint& p) {
  switch (p.surface) {
    case Surface::kFat:
      return Fat(cavity, vessels, look, p);
    case Surface::kCondyle:
      return Cartilage(p.x, look, p.wall_gap, cavity.seed);
    case Surface::kPlateau:
      return PlateauTissue(cavity, look, p);
    case Surface::kLigament:
      return Sinew(cavity, look, p);
    case Surface::kMeniscus:
      return Meniscus(cavity, look, p);
    case Surface::kCartilage:
      return Cartilage(p.x, look, p.wall_gap, cavity.seed + kTibialSeed);
    default:
      return Synovium(cavity, vessels, look, p);
  }
}

// Ambient occlusion: open share of the surroundings, from the rate at which free space ends along
// the normal. The bed shades nothing: its points are raised to the cartilage around it.
double Openness(const Cavity& cavity, const SurfacePoint& p) {
  glm::dvec3 x = p.x;
  if (p.surface == Surface::kPlateau) {
    const Rigid3& portal_from_plateau = cavity.plateau.portal_from_plateau;
    glm::dvec3 q = Inverse(portal_from_plateau) * x;
    q.z = std::max(q.z, PlateauHeight(cavity.plateau, q.x, q.y, false));
    x = portal_from_plateau * q;
  }
  constexpr double kHeights[] = {0.7 * kMm, 1.6 * kMm, 3.4 * kMm, 6.5 * kMm};
  constexpr double kDecay = 0.8;       // weight of a height relative to the one below
  constexpr double kDensity = 0.72;    // exponent per unit of blocked height
  constexpr double kLeastOpen = 0.16;  // light that reaches the deepest recess
  double blocked = 0.0, weight = 1.0;
  for (const double h : kHeights) {
    blocked +=
        weight * std::max(h - std::max(Clearance(cavity, x + h * p.normal, false), 0.0), 0.0) / h;
    weight *= kDecay;
  }
  return kLeastOpen + 0.84 * std::exp(-kDensity * blocked);
}

// Normal with the ripples of the wet film; they affect highlights only.
glm::dvec3 Rippled(const SurfacePoint& p, double roughness, std::uint32_t seed) {
  constexpr double kRipple = 0.9 * kMm;  // wavelength
  const glm::dvec3 q = p.x / kRipple;
  const glm::dvec3 slope(FractalNoise(q, 3, seed + kRippleX), FractalNoise(q, 3, seed + kRippleY),
                         FractalNoise(q, 3, seed + kRippleZ));
  return glm::normalize(p.normal +
                        2.0 * roughness * (slope - glm::dot(slope, p.normal) * p.normal));
}

// Normal with the dimples of the surface under the film.
glm::dvec3 Dimpled(const SurfacePoint& p, std::uint32_t seed) {
  constexpr double kDimple = 2.2 * kMm;  // wavelength
  constexpr double kSlope = 0.16;        // slope of the dimples, dimensionless
  const glm::dvec3 q = p.x / kDimple;
  const glm::dvec3 slope(FractalNoise(q, 2, seed + kDimpleX), FractalNoise(q, 2, seed + kDimpleY),
                         FractalNoise(q, 2, seed + kDimpleZ));
  return glm::normalize(p.normal + kSlope * (slope - glm::dot(slope, p.normal) * p.normal));
}

// Pools of fluid; between them the film is thin and has hardly any highlights.
double Pool(const SurfacePoint& p, std::uint32_t seed) {
  constexpr double kPoolSize = 4.5 * kMm;
  return SmoothStep(0.05, 0.40, FractalNoise(p.x / kPoolSize, 3, seed + kPools));
}

}  // namespace

Look LookOf(Difficulty difficulty) {
  if (difficulty == Difficulty::kEasy) return {1.0, 1.0, 0.02, 1.0};
  if (difficulty == Difficulty::kMedium) return {0.60, 0.70, 0.10, 0.85};
  return {0.32, 0.42, 0.22, 0.65};
}

glm::dvec3 Radiance(const Cavity& cavity, const VesselTrees& vessels, const Look& look,
                    const SurfacePoint& p) {
  const Tissue tissue = TissueAt(cavity, vessels, look, p);
  const glm::dvec3 to_light = kLight - p.x;
  const double light_distance = glm::length(to_light);
  const glm::dvec3 l = to_light / light_distance;
  const double fall = std::pow(kLightReference / light_distance, kFalloff);

  const double facing = glm::dot(p.normal, l);
  const double open = Openness(cavity, p) * p.shade;
  // Light wraps round inside the tissue and comes out redder; recesses keep only red light.
  static const glm::dvec3 kWrap(1.25, 0.95, 0.85);    // per channel
  static const glm::dvec3 kRecess(0.80, 1.10, 1.25);  // exponent per channel
  const glm::dvec3 wrap = tissue.depth * kWrap;
  const glm::dvec3 lit = glm::max((glm::dvec3(facing) + wrap) / (1.0 + wrap), glm::dvec3(0.0));
  const glm::dvec3 recess = glm::pow(glm::dvec3(std::max(open, 1e-3)), kRecess);
  // Pink light reflected by the other walls.
  const glm::dvec3 bounce = kBounceColour * open;
  glm::dvec3 radiance = tissue.colour * (fall * lit * recess + bounce);

  // Wet film: a broad sheen and a few small highlights, seen from the portal.
  constexpr double kSheenPower = 40.0, kGlintPower = 1100.0;  // exponents [Blinn 1977]
  constexpr double kSheen = 0.11, kGlint = 0.9;               // strengths
  constexpr double kSmooth = 0.05;    // roughness below which the film has no dry places
  constexpr double kGlintCone = 0.8;  // cosine; beyond it a lobe of kGlintPower is 0
  const glm::dvec3 half = glm::normalize(l - p.direction);
  const double sheen =
      std::pow(std::max(glm::dot(Dimpled(p, cavity.seed), half), 0.0), kSheenPower);
  double glint = 0.0;
  if (glm::dot(p.normal, half) > kGlintCone)
    glint = std::pow(std::max(glm::dot(Rippled(p, tissue.roughness, cavity.seed), half), 0.0),
                     kGlintPower) *
            (tissue.roughness < kSmooth ? 1.0 : Pool(p, cavity.seed));
  radiance += glm::dvec3(fall * open * tissue.wetness * (kSheen * sheen + kGlint * glint));

  // Haze grows with the depth of water; its veil has the colour of scattered light.
  const double veil = 1.0 - std::pow(1.0 - look.haze, glm::length(p.x) / cavity.radius);
  radiance = Mix(radiance, kHazeColour, veil);
  return look.light * radiance;
}

glm::dvec3 Develop(const glm::dvec3& radiance, double exposure) {
  glm::dvec3 out;
  for (int i = 0; i < 3; ++i) {
    // Linear up to the knee, then a shoulder that reaches white slowly.
    constexpr double kKnee = 0.60;
    double v = exposure * std::max(radiance[i], 0.0);
    if (v > kKnee) v = kKnee + (1.0 - kKnee) * (1.0 - std::exp(-(v - kKnee) / (1.0 - kKnee)));
    // Transfer function of sRGB, IEC 61966-2-1.
    out[i] = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
  }
  return out;
}

}  // namespace arthro::authoring
