#include "authoring/phantom/look/appearance.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "authoring/phantom/look/tissue_looks.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

// Position of the light, beside the scope's lens.
constexpr glm::dvec3 kLight(0.8 * kMm, -2.6 * kMm, 0.0);
constexpr double kLightReference = 30.0 * kMm;  // distance of unit light
// Exponent of the falloff with distance. It is below 2 because of the camera's exposure control and
// of light scattered within the joint.
constexpr double kFalloff = 0.8;

const glm::dvec3 kBounceColour(0.115, 0.066, 0.054);  // reflected by all other walls
const glm::dvec3 kHazeColour(0.40, 0.31, 0.27);       // light scattered by cloudy water

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
  constexpr double kDensity = 0.60;    // exponent per unit of blocked height
  constexpr double kLeastOpen = 0.16;  // light that reaches the deepest recess
  double blocked = 0.0, weight = 1.0;
  for (const double h : kHeights) {
    blocked +=
        weight * std::max(h - std::max(Clearance(cavity, x + h * p.normal, false), 0.0), 0.0) / h;
    weight *= kDecay;
  }
  return kLeastOpen + 0.84 * std::exp(-kDensity * blocked);
}

// Normal of a surface with fine structure on it.
glm::dvec3 Tilted(const glm::dvec3& normal, const glm::dvec3& slope) {
  return glm::normalize(normal - (slope - glm::dot(slope, normal) * normal));
}

}  // namespace

Look LookOf(Difficulty difficulty) {
  if (difficulty == Difficulty::kEasy) return {1.0, 1.0, 0.02, 1.0};
  if (difficulty == Difficulty::kMedium) return {0.60, 0.70, 0.10, 0.85};
  return {0.32, 0.42, 0.22, 0.65};
}

glm::dvec3 Radiance(const Cavity& cavity, const VesselTrees& vessels, const Look& look,
                    const SurfacePoint& p) {
  const TissueLook tissue = LookAt(cavity, vessels, look, p);
  const glm::dvec3 to_light = kLight - p.x;
  const double light_distance = glm::length(to_light);
  const glm::dvec3 l = to_light / light_distance;
  const double fall = std::pow(kLightReference / light_distance, kFalloff);

  const double facing = glm::dot(Tilted(p.normal, tissue.slope), l);
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
