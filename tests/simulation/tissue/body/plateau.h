// Plane that supports a meniscus crescent (meniscus_body.h). Portal frame, m.
#pragma once

#include "simulation/core/frames.h"
#include "simulation/tissue/contact/obstacle_contact.h"

namespace arthro::test {

class Plateau : public simulation::RigidObstacle {
 public:
  explicit Plateau(const Rigid3& portal_from_body)
      : normal_(portal_from_body.rotation * glm::dvec3(0, 0, 1)),
        body_from_portal_(Inverse(portal_from_body)) {}
  double Gap(const glm::dvec3& x, glm::dvec3& normal) const noexcept override {
    normal = normal_;
    return (body_from_portal_ * x).z;
  }

 private:
  glm::dvec3 normal_;
  Rigid3 body_from_portal_;
};

}  // namespace arthro::test
