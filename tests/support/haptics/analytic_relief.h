// Backdrops whose surface is known in closed form, and the force that a tip under it must feel: the
// reference for touch. The relief is a smooth function of the pixel, sampled into a depth map of
// any precision; the nearest point of the exact surface is found by Newton's method on the pixel.
// Pixels of 0.05 mm. Portal frame, m.
#pragma once

#include <functional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "simulation/scene/image.h"
#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scene/scene.h"

namespace arthro::test {

struct AnalyticRelief {
  Backdrop backdrop;
  int width = 1024, height = 1024;
  std::function<double(glm::dvec2)> relief;  // m, of a pixel

  // On a sphere of 50 mm.
  static AnalyticRelief Make(ProjectionType type, std::function<double(glm::dvec2)> relief);
  // Two crossed waves: 6.6 mm from the lowest to the highest point, slopes up to about 1.
  static AnalyticRelief Waves(ProjectionType type = ProjectionType::kGnomonic);
  // Half the width, since at wider angles the next two would leave the 7 mm of a map of 8 bit.
  // A plane that is tilted by 10°.
  static AnalyticRelief Plane();
  // A ball of 40 mm, as a condyle's back, 45 mm away; slopes up to 1.
  static AnalyticRelief Ball();

  DepthMap Float() const;
  DepthMap EightBit(double range = 0.007) const;
  // The part between two pixels as a mesh of 2·cells² triangles that face free space, raised
  // towards the portal.
  SurfaceMesh Mesh(glm::dvec2 low, glm::dvec2 high, int cells, double raise = 0) const;

  glm::dvec3 Surface(glm::dvec2 p) const;
  glm::dvec3 Normal(glm::dvec2 p) const;  // unit, into free space
  // The pixel of the surface point nearest to x, near `start`.
  glm::dvec2 Nearest(const glm::dvec3& x, glm::dvec2 start) const;
};

}  // namespace arthro::test
