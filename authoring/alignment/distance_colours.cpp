#include "authoring/alignment/distance_colours.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace arthro::authoring {
namespace {

// Ends of a diverging scale that colour-blind people tell apart.
constexpr glm::dvec3 kOn{0.97, 0.97, 0.95}, kBefore{0.13, 0.40, 0.75}, kBehind{0.75, 0.13, 0.15};

std::vector<double> VertexDistances(const ReliefTarget& relief, const SurfaceMesh& surface,
                                    const Pose& pose) {
  std::vector<glm::dvec3> points;
  points.reserve(surface.vertices.size());
  for (const glm::dvec3& x : surface.vertices) points.push_back(pose * x);
  return DistancesFrom(relief, points, kReliefReach);
}

}  // namespace

glm::dvec3 ColourOfDistance(double distance) {
  if (std::isnan(distance)) return kNoDistanceColour;
  const double share = std::min(std::abs(distance) / kFullColour, 1.0);
  return glm::mix(kOn, distance < 0 ? kBehind : kBefore, share);
}

std::vector<std::vector<ContourSegment>> ContoursOf(const SurfaceMesh& surface,
                                                    const std::vector<double>& distances,
                                                    const std::vector<double>& levels) {
  std::vector<std::vector<ContourSegment>> contours(levels.size());
  for (const auto& triangle : surface.triangles) {
    std::array<glm::dvec3, 3> x;
    std::array<double, 3> d{};
    for (std::size_t i = 0; i < 3; ++i) {
      x[i] = surface.vertices[static_cast<std::size_t>(triangle[i])];
      d[i] = distances[static_cast<std::size_t>(triangle[i])];
    }
    if (std::isnan(d[0] + d[1] + d[2])) continue;
    for (std::size_t k = 0; k < levels.size(); ++k) {
      // A line crosses none of the three edges, or two.
      std::array<glm::dvec3, 2> ends;
      std::size_t count = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        if ((d[i] < levels[k]) == (d[j] < levels[k])) continue;
        ends[count++] = glm::mix(x[i], x[j], (levels[k] - d[i]) / (d[j] - d[i]));
      }
      if (count == 2)
        contours[k].push_back({ends[0], ends[1], glm::cross(x[1] - x[0], x[2] - x[0])});
    }
  }
  return contours;
}

std::vector<glm::dvec3> DistanceColours(const ReliefTarget& relief, const SurfaceMesh& surface,
                                        const Pose& pose) {
  std::vector<glm::dvec3> colours;
  colours.reserve(surface.vertices.size());
  for (const double distance : VertexDistances(relief, surface, pose))
    colours.push_back(ColourOfDistance(distance));
  return colours;
}

std::vector<std::vector<ContourSegment>> DistanceContours(const ReliefTarget& relief,
                                                          const SurfaceMesh& surface,
                                                          const Pose& pose) {
  return ContoursOf(surface, VertexDistances(relief, surface, pose),
                    {kContourLevels.begin(), kContourLevels.end()});
}

}  // namespace arthro::authoring
