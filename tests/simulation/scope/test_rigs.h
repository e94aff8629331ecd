// Rigs that several tests of this folder stand on. m.
#pragma once

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "simulation/scene/scene.h"

namespace arthro::test {

// Axes of the device along those of the portal.
inline const DeviceRig kStraightRig{{0.012, -0.034, 0.11}, {1, 0, 0, 0}, 0.2};

inline DeviceRig TiltedRig() {
  DeviceRig rig;
  rig.pivot = {0.01, -0.02, 0.15};
  rig.portal_from_device = glm::normalize(glm::dquat(0.9, 0.1, -0.3, 0.2));
  rig.rod_length = 0.25;
  return rig;
}

}  // namespace arthro::test
