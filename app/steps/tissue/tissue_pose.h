// A rotation as three angles that a person can type: about the portal frame's right (x), down (y)
// and in (z) axes, in degrees, applied in that order. Near ±90° about y the first and the last turn
// about the same axis; then the first one takes all of it.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace arthro::app {

glm::dvec3 DegreesOf(const glm::dquat& rotation);
glm::dquat QuaternionOf(const glm::dvec3& degrees);

}  // namespace arthro::app
