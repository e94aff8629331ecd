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

// A straight tool of which the portal and the tip are known, z along it from portal to tip, y the
// way its hook points (north at no roll). A tip at the portal: as if it pointed along the portal's
// z.
Rigid3 PortalFromTool(const glm::dvec3& portal, const glm::dvec3& tip, double roll) noexcept;

// Tip relative to the rod's own portal: ρ u.
glm::dvec3 TipInOwnPortal(const RodPose& pose) noexcept;

// The pose from a device's hand position and handle orientation (need not be of unit length). Roll
// is read from the handle: the angle by which the handle's up axis (-y), laid flat against the rod,
// is turned from north towards east; an identity orientation has no roll. It is continued from
// `previous` so that it never jumps by a whole turn. With the hand within 0.5 mm of the pivot the
// rod has no direction that can be measured, and the previous one is kept; a hand that goes on to
// the other side turns the rod about once. A sample that is not finite leaves the pose as it was.
RodPose RodPoseFromHip(const glm::dvec3& hip_in_device, const glm::dquat& handle_in_device,
                       const DeviceRig& rig, const RodPose& previous = {}) noexcept;

// The inverse, for scripted hands and tests: where the hand is, in the device frame. A depth beyond
// the rod's length would need the hand inside the joint and does not come back.
glm::dvec3 HipFromRodPose(const RodPose& pose, const DeviceRig& rig) noexcept;
glm::dquat HandleFromRodPose(const RodPose& pose, const DeviceRig& rig) noexcept;

}  // namespace arthro::simulation
