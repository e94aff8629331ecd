// Rigid transforms, named `target_from_source`; points are named `x_in_frame` (design: frames are
// device, portal, camera, panorama). x_in_target = rotation * x_in_source + translation, metres.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "simulation/core/options.h"

namespace arthro {

struct Rigid3 {
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  // w, x, y, z; unit
  glm::dvec3 translation{0.0};              // m
  friend bool operator==(const Rigid3&, const Rigid3&) = default;
};

inline glm::dvec3 operator*(const Rigid3& target_from_source, const glm::dvec3& x_in_source) {
  return target_from_source.rotation * x_in_source + target_from_source.translation;
}

inline Rigid3 operator*(const Rigid3& c_from_b, const Rigid3& b_from_a) {
  return {c_from_b.rotation * b_from_a.rotation, c_from_b * b_from_a.translation};
}

inline Rigid3 Inverse(const Rigid3& target_from_source) {
  const glm::dquat inverse = glm::conjugate(target_from_source.rotation);
  return {inverse, -(inverse * target_from_source.translation)};
}

// A rigid pose and a uniform scale: how a model is laid into a scene. Scale acts first.
struct Pose {
  glm::dvec3 position{0.0};                   // m
  glm::dquat quaternion{1.0, 0.0, 0.0, 0.0};  // w, x, y, z; unit
  double scale = 1.0;
  friend bool operator==(const Pose&, const Pose&) = default;
  template <class V>
  void Visit(V&& v) {
    v("position", position, Range{-2, 2}, "m", "Where its origin lies.");
    v("quaternion", quaternion, Any{}, "", "Rotation [w, x, y, z].");
    v("scale", scale, Range{0, 1e6, true}, "", "Uniform scale.");
  }
};

inline glm::dvec3 operator*(const Pose& pose, const glm::dvec3& x) {
  return pose.quaternion * (pose.scale * x) + pose.position;
}

}  // namespace arthro
