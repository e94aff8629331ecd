// Rigid obstacle that supports tissue and cannot be entered: the backdrop's relief or a rigid
// model. Implemented by the owner of the depth field or mesh. Portal frame, m.
#pragma once

#include <glm/vec3.hpp>

namespace arthro::simulation {

class RigidObstacle {
 public:
  virtual ~RigidObstacle() = default;
  // Returns the distance of x above the surface (negative inside), exact near it, and the unit
  // normal there.
  virtual double Gap(const glm::dvec3& x, glm::dvec3& normal) const noexcept = 0;
};

}  // namespace arthro::simulation
