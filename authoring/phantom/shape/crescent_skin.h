// Closed surface about a crescent, with rings of points from the anterior to the posterior horn.
// m, in the frame of the ground on which the crescent lies.
#pragma once

#include <functional>
#include <vector>

#include <glm/vec3.hpp>

#include "authoring/phantom/shape/crescent.h"
#include "simulation/scene/mesh/surface_mesh.h"

namespace arthro::authoring {

// Point at an angle (rad), a distance from the crescent's centre and a height over the ground.
using CrescentGround = std::function<glm::dvec3(double angle, double r, double lift)>;

struct CrescentSkin {
  SurfaceMesh surface;
  // Per vertex: 0 at the free edge, 1 at the outer rim.
  std::vector<double> rims;
};
CrescentSkin SkinOf(const Crescent& crescent, const CrescentGround& ground);

// Middle of the free edge, and the upper end of the outer rim.
glm::dvec3 FreeEdgeAt(const Crescent& crescent, const CrescentGround& ground, double angle);
glm::dvec3 ShoulderAt(const Crescent& crescent, const CrescentGround& ground, double angle);

// Point at a share q of the width, 0 at the free edge, and a share t of the height.
glm::dvec3 PlaceInCrescent(const Crescent& crescent, const CrescentGround& ground, double angle,
                           double q, double t);

// Places where a meniscus is held, as in the knee: the horns at their roots, the rim along the
// capsule. `place` has the arguments of PlaceInCrescent.
using CrescentPlace = std::function<glm::dvec3(double angle, double q, double t)>;
std::vector<Ball> HoldsOf(const Crescent& crescent, const CrescentPlace& place);

}  // namespace arthro::authoring
