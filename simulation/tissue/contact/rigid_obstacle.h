// What tissue rests on and cannot enter: the backdrop's relief, a rigid model. Who knows the depth
// field or the mesh gives one of these. Portal frame, m.
#pragma once

#include <glm/vec3.hpp>

namespace arthro::simulation {

class RigidObstacle {
 public:
  virtual ~RigidObstacle() = default;
  // Distance of x above the surface (negative: inside), exact near it, and the unit normal there.
  virtual double Gap(const glm::dvec3& x, glm::dvec3& normal) const noexcept = 0;
};

}  // namespace arthro::simulation
