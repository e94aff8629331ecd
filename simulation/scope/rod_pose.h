// Pose of a rod held at a fixed pivot, as angles on the sphere about it [paper, 3.2; method.md, Rod
// pose]. Angles in rad; depth ρ is the signed distance from pivot to tip along the rod, m, positive
// in the joint.
//   u = (cos φ sin λ, −sin φ, cos φ cos λ): the rod's direction from hand to tip, in its portal's
//   frame
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "simulation/scene/scene.h"

namespace arthro::simulation {

struct RodPose {
  double latitude = 0, longitude = 0;  // φ up, λ right
  double roll = 0;                     // γ, from north towards east; continuous, not wrapped
  double depth = 0;                    // ρ
};

// Unit vectors of the rod: `axis` is u, `north` ∂u/∂φ, `east` ∂u/∂λ / cos φ; axis × north = east.
// At the poles the formulas are continued, so all three stay unit.
struct RodBasis {
  glm::dvec3 axis, north, east;
};
RodBasis BasisOf(const RodPose& pose) noexcept;

// Frame of a straight tool from its portal and tip: z along the tool from portal to tip, y in the
// direction of its hook (north without roll). A tip at the portal gives a tool along z of the
// portal.
Rigid3 PortalFromTool(const glm::dvec3& portal, const glm::dvec3& tip, double roll) noexcept;

// Returns the tip relative to the portal of the rod: ρ u.
glm::dvec3 TipInOwnPortal(const RodPose& pose) noexcept;

// Computes the pose from the hand position and handle orientation of a device; the quaternion need
// not be of unit length. Roll is the angle from north towards east of the up axis of the handle
// (-y), projected perpendicular to the rod; an identity orientation has no roll. Roll is continued
// from `previous`, so it never jumps by a whole turn. With the hand within 0.5 mm of the pivot the
// direction of the rod cannot be measured, and the previous one is kept. A hand that passes through
// the pivot turns the rod around once. A sample that is not finite keeps the previous pose.
RodPose RodPoseFromHip(const glm::dvec3& hip_in_device, const glm::dquat& handle_in_device,
                       const DeviceRig& rig, const RodPose& previous = {}) noexcept;

// Inverse functions, for scripted hands and tests: position of the hand and orientation of the
// handle in the device frame. A depth beyond the rod length would need the hand inside the joint
// and is not recovered by RodPoseFromHip.
glm::dvec3 HipFromRodPose(const RodPose& pose, const DeviceRig& rig) noexcept;
glm::dquat HandleFromRodPose(const RodPose& pose, const DeviceRig& rig) noexcept;

}  // namespace arthro::simulation
