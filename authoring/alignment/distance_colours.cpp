#include "authoring/alignment/distance_colours.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace arthro::authoring {
namespace {

// Ends of a diverging scale that colour-blind people tell apart.
constexpr glm::dvec3 kOn{0.97, 0.97, 0.95}, kBefore{0.13, 0.40, 0.75}, kBehind{0.75, 0.13, 0.15};

}  // namespace

glm::dvec3 ColourOfDistance(double distance) {
  if (std::isnan(distance)) return kNoDistanceColour;
  const double share = std::min(std::abs(distance) / kFullColour, 1.0);
  return glm::mix(kOn, distance < 0 ? kBehind : kBefore, share);
}

std::vector<glm::dvec3> DistanceColours(const ReliefTarget& relief, const SurfaceMesh& surface,
                                        const Pose& pose) {
  std::vector<glm::dvec3> points;
  points.reserve(surface.vertices.size());
  for (const glm::dvec3& x : surface.vertices) points.push_back(pose * x);
  std::vector<glm::dvec3> colours;
  colours.reserve(points.size());
  for (const double distance : DistancesFrom(relief, points, kReliefReach))
    colours.push_back(ColourOfDistance(distance));
  return colours;
}

}  // namespace arthro::authoring
