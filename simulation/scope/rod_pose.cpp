#include "simulation/scope/rod_pose.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace arthro::simulation {
namespace {

// Distance from the pivot below which the direction of the rod is unknown: sensor noise of 0.055 mm
// per axis, nine times less, would turn the rod around.
constexpr double kHandOnPivot = 0.5e-3;  // m

}  // namespace

RodBasis BasisOf(const RodPose& pose) noexcept {
  const double cos_lat = std::cos(pose.latitude), sin_lat = std::sin(pose.latitude);
  const double cos_lon = std::cos(pose.longitude), sin_lon = std::sin(pose.longitude);
  return {{cos_lat * sin_lon, -sin_lat, cos_lat * cos_lon},
          {-sin_lat * sin_lon, -cos_lat, -sin_lat * cos_lon},
          {cos_lon, 0.0, -sin_lon}};
}

Rigid3 PortalFromTool(const glm::dvec3& portal, const glm::dvec3& tip, double roll) noexcept {
  const glm::dvec3 rod = tip - portal;
  RodPose pose;
  pose.latitude = std::atan2(-rod.y, std::hypot(rod.x, rod.z));
  pose.longitude = std::atan2(rod.x, rod.z);
  const RodBasis basis = BasisOf(pose);
  const glm::dvec3 hook = std::cos(roll) * basis.north + std::sin(roll) * basis.east;
  return {glm::quat_cast(glm::dmat3(glm::cross(hook, basis.axis), hook, basis.axis)), tip};
}

glm::dvec3 TipInOwnPortal(const RodPose& pose) noexcept { return pose.depth * BasisOf(pose).axis; }

RodPose RodPoseFromHip(const glm::dvec3& hip_in_device, const glm::dquat& handle_in_device,
                       const DeviceRig& rig, const RodPose& previous) noexcept {
  const glm::dvec3 hand_to_pivot = rig.portal_from_device * (rig.pivot - hip_in_device);
  const double distance = glm::length(hand_to_pivot);
  if (!std::isfinite(distance)) return previous;
  RodPose pose = previous;
  pose.depth = rig.rod_length - distance;
  if (distance > kHandOnPivot) {
    const glm::dvec3 u = hand_to_pivot / distance;
    const double from_axis = std::hypot(u.x, u.z);
    pose.latitude = std::atan2(-u.y, from_axis);  // an arc sine is exact to only 1e-8 at the poles
    // At a pole every longitude is the same direction; the previous one is kept, and so is north.
    if (from_axis > 1e-12) pose.longitude = std::atan2(u.x, u.z);
  }
  // The up axis of the handle, projected along the rod, gives the roll.
  const double handle_length = glm::length(handle_in_device);
  if (!(handle_length > 1e-6) || !std::isfinite(handle_length)) return pose;
  const RodBasis basis = BasisOf(pose);
  const glm::dvec3 mark =
      rig.portal_from_device * ((handle_in_device / handle_length) * glm::dvec3(0.0, -1.0, 0.0));
  const double north = glm::dot(mark, basis.north), east = glm::dot(mark, basis.east);
  if (std::hypot(north, east) > 1e-9) {
    constexpr double kTurn = 2.0 * std::numbers::pi;
    const double roll = std::atan2(east, north);
    pose.roll = roll + kTurn * std::round((previous.roll - roll) / kTurn);
  }
  return pose;
}

glm::dvec3 HipFromRodPose(const RodPose& pose, const DeviceRig& rig) noexcept {
  const glm::dvec3 hip_in_portal = -(rig.rod_length - pose.depth) * BasisOf(pose).axis;
  return glm::conjugate(rig.portal_from_device) * hip_in_portal + rig.pivot;
}

glm::dquat HandleFromRodPose(const RodPose& pose, const DeviceRig& rig) noexcept {
  const RodBasis basis = BasisOf(pose);
  const glm::dvec3 y = -std::cos(pose.roll) * basis.north - std::sin(pose.roll) * basis.east;
  const glm::dmat3 handle_in_portal(glm::cross(y, basis.axis), y, basis.axis);
  return glm::conjugate(rig.portal_from_device) * glm::quat_cast(handle_in_portal);
}

}  // namespace arthro::simulation
