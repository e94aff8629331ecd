#include "authoring/alignment/place_by_hand.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Eigenvalues>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "simulation/core/geometry/box3.h"

namespace arthro::authoring {
namespace {

constexpr double kNormalRadius = 2e-3;  // m; folds and noise of a relief are narrower

glm::dvec3 AxisOf(const Pose& pose, int axis, NudgeAxes axes) {
  glm::dvec3 unit(0.0);
  unit[axis] = 1;
  return axes == NudgeAxes::kTissue ? pose.quaternion * unit : unit;
}

glm::dvec3 MirroredPoint(glm::dvec3 x, double at) {
  x.x = 2 * at - x.x;
  return x;
}

struct CutMirror {
  double at;
  Cut operator()(CapsuleCut cut) const {
    cut.a = MirroredPoint(cut.a, at);
    cut.b = MirroredPoint(cut.b, at);
    return cut;
  }
  Cut operator()(BoxCut cut) const {
    glm::dquat& q = cut.rest_from_box.rotation;
    q = glm::dquat(q.w, q.x, -q.y, -q.z);
    cut.rest_from_box.translation = MirroredPoint(cut.rest_from_box.translation, at);
    return cut;
  }
  Cut operator()(TearCut cut) const {
    for (glm::dvec3& x : cut.path) x = MirroredPoint(x, at);
    cut.into.x = -cut.into.x;
    return cut;
  }
};

// Direction of least extent of a surface, unit; its own frame.
glm::dvec3 FlatAxis(const SurfaceMesh& surface) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  const double share = 1.0 / static_cast<double>(surface.vertices.size());
  for (const glm::dvec3& x : surface.vertices) mean += share * Eigen::Vector3d(x.x, x.y, x.z);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const glm::dvec3& x : surface.vertices) {
    const Eigen::Vector3d offset = Eigen::Vector3d(x.x, x.y, x.z) - mean;
    spread += share * offset * offset.transpose();
  }
  const Eigen::Vector3d axis =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
  return {axis.x(), axis.y(), axis.z()};
}

// Shortest rotation of one unit vector into another.
glm::dquat RotationBetween(const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 axis = glm::cross(from, to);
  const double sine = glm::length(axis), cosine = glm::dot(from, to);
  if (sine > 1e-9) return glm::angleAxis(std::atan2(sine, cosine), axis / sine);
  if (cosine > 0) return {1, 0, 0, 0};
  const glm::dvec3 other = std::abs(from.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return glm::angleAxis(std::numbers::pi, glm::normalize(glm::cross(from, other)));
}

// Normal of the relief about a place, towards the portal.
glm::dvec3 NormalAbout(const ReliefTarget& relief, const glm::dvec3& place) {
  const SurfacePoint nearest = relief.finder->Find(place);
  const glm::dvec3 first = relief.normals[static_cast<std::size_t>(nearest.triangle)];
  const glm::dvec3 other = std::abs(first.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 along = glm::normalize(glm::cross(first, other)),
                   across = glm::cross(first, along);
  glm::dvec3 sum = first;
  for (int i = 0; i < 16; ++i) {
    const double turn = 2 * std::numbers::pi * i / 8, radius = kNormalRadius * (i < 8 ? 1 : 0.5);
    const SurfacePoint beside = relief.finder->Find(
        place + radius * (std::cos(turn) * along + std::sin(turn) * across), kNormalRadius);
    if (beside.triangle >= 0) sum += relief.normals[static_cast<std::size_t>(beside.triangle)];
  }
  return glm::length(sum) > 0 ? glm::normalize(sum) : first;
}

}  // namespace

Pose Shifted(const Pose& pose, int axis, double distance, NudgeAxes axes) {
  Pose shifted = pose;
  shifted.position += distance * AxisOf(pose, axis, axes);
  return shifted;
}

Pose Turned(const Pose& pose, int axis, double angle, NudgeAxes axes, const glm::dvec3& middle) {
  Pose turned = pose;
  const glm::dquat rotation = glm::angleAxis(angle, AxisOf(pose, axis, axes));
  const glm::dvec3 centre = pose * middle;
  turned.quaternion = glm::normalize(rotation * pose.quaternion);
  turned.position = centre + rotation * (pose.position - centre);
  return turned;
}

glm::dvec3 MiddleOf(const SurfaceMesh& surface) {
  Box3 box = kEmptyBox;
  for (const glm::dvec3& x : surface.vertices) box = Union(box, {x, x});
  return box.empty() ? glm::dvec3(0.0) : 0.5 * (box.low + box.high);
}

glm::dvec3 FacingOf(const SurfaceMesh& surface) {
  constexpr double kClosed = 1e-6;  // rounding of the sum over a closed surface
  glm::dvec3 sum(0.0);
  double area = 0;
  for (const auto& [a, b, c] : surface.triangles) {
    const auto at = [&](int i) { return surface.vertices[static_cast<std::size_t>(i)]; };
    const glm::dvec3 normal = glm::cross(at(b) - at(a), at(c) - at(a));
    sum += normal;
    area += glm::length(normal);
  }
  return glm::length(sum) > kClosed * area ? sum / area : glm::dvec3(0.0);
}

SurfaceMesh Mirrored(SurfaceMesh surface, double at) {
  for (glm::dvec3& x : surface.vertices) x = MirroredPoint(x, at);
  for (auto& triangle : surface.triangles) std::swap(triangle[1], triangle[2]);
  return surface;
}

Tissue Mirrored(Tissue tissue, double at) {
  for (auto* balls : {&tissue.fixed, &tissue.probed})
    for (Ball& ball : *balls) ball.centre = MirroredPoint(ball.centre, at);
  for (Region& region : tissue.regions) region.ball.centre = MirroredPoint(region.ball.centre, at);
  for (Cut& cut : tissue.cuts) cut = std::visit(CutMirror{at}, std::as_const(cut));
  return tissue;
}

// Every kind of part is its own mirror image in its own plane x = 0.
Solid Mirrored(Solid solid, double at) {
  for (SolidPart& part : solid.parts) {
    Rigid3& place = PlaceOf(part).solid_from_part;
    place.translation = MirroredPoint(place.translation, at);
    glm::dquat& q = place.rotation;
    q = glm::dquat(q.w, q.x, 0.0 - q.y, 0.0 - q.z);
  }
  return solid;
}

Pose LaidOnRelief(const ReliefTarget& relief, const SurfaceMesh& surface, const Pose& present,
                  const glm::dvec3& place) {
  if (relief.empty() || surface.vertices.empty()) return present;
  const glm::dvec3 normal = NormalAbout(relief, place);
  glm::dvec3 up = FlatAxis(surface);
  // The side that needs the smaller turn is up.
  if (glm::dot(present.quaternion * up, normal) < 0) up = -up;
  Pose laid = present;
  laid.quaternion =
      glm::normalize(RotationBetween(present.quaternion * up, normal) * present.quaternion);
  double lowest = 0;
  const glm::dvec3 middle = MiddleOf(surface);
  for (const glm::dvec3& x : surface.vertices) lowest = std::min(lowest, glm::dot(x - middle, up));
  const glm::dvec3 base = middle + lowest * up;
  laid.position = glm::dvec3(0.0);
  laid.position = place - laid * base;
  return laid;
}

}  // namespace arthro::authoring
