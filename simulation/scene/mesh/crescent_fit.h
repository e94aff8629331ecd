// Plane and circle of a crescent, such as a meniscus, found from the points of its surface: the
// plane by principal components, the circle in it by least squares [Kåsa 1976], the ends at the
// largest gap of angles. m, rad, frame of the points.
#pragma once

#include <optional>
#include <span>

#include <glm/vec3.hpp>

namespace arthro {

// Middle of points, and directions of the plane in which they lie; axis is its normal.
struct PlaneFit {
  glm::dvec3 middle{0.0}, across{0.0}, along{0.0}, axis{0.0};

  // Coordinates along the three directions, from the middle.
  glm::dvec3 InPlane(const glm::dvec3& x) const;
};
PlaneFit FitPlane(std::span<const glm::dvec3> points);

// Angle of a point in the plane from `across` towards `along`, 0 to 2π.
double AngleInPlane(const glm::dvec3& flat);

struct CrescentFit {
  PlaneFit plane;  // its middle is that of the circle
  double radius = 0;
  double begin = 0, sweep = 0;  // first angle and extent
};
// Returns nothing where the points lie on a line.
std::optional<CrescentFit> FitCrescent(std::span<const glm::dvec3> points, int bins);

}  // namespace arthro
