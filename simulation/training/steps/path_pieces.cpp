#include "simulation/training/steps/path_pieces.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "simulation/scope/arthroscope.h"

namespace arthro::simulation {

Pointer TipPointer(const AttemptFrame& frame) {
  return {glm::dvec3(frame.tool[Index(DeviceRole::kInstrument)].drawn_tip), std::nullopt};
}

Pointer ViewPointer(const AttemptFrame& frame) {
  const ToolFrame& scope = frame.tool[Index(DeviceRole::kScope)];
  const glm::dvec3 u = glm::normalize(glm::dvec3(scope.axis));
  RodPose pose;
  pose.latitude = std::asin(std::clamp(-u.y, -1.0, 1.0));
  pose.longitude = std::atan2(u.x, u.z);
  pose.roll = scope.roll;
  pose.depth = scope.depth;
  // Without an observation the lens is taken at the tip.
  const glm::vec3 lens = frame.sight.targets > 0 ? frame.lens : scope.drawn_tip;
  return {glm::dvec3(lens), ViewFromPose(pose, frame.view_angle).view};
}

double DistanceTo(const Pointer& pointer, const glm::dvec3& a, const glm::dvec3& b) {
  // Seen along the axis, a segment in front of the lens is a segment in a plane.
  const auto flat = [&](const glm::dvec3& x) {
    const glm::dvec3 d = x - pointer.origin;
    if (!pointer.axis) return d;
    return d - std::max(0.0, glm::dot(d, *pointer.axis)) * *pointer.axis;
  };
  const glm::dvec3 p = flat(a), q = flat(b), way = q - p;
  const double square = glm::dot(way, way);
  const double share = square > 0 ? std::clamp(-glm::dot(p, way) / square, 0.0, 1.0) : 0.0;
  return glm::length(p + share * way);
}

double LengthOf(std::span<const glm::dvec3> path) {
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i) length += glm::distance(path[i - 1], path[i]);
  return length;
}

glm::dvec3 PointAt(std::span<const glm::dvec3> path, double way) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double leg = glm::distance(path[i - 1], path[i]);
    if (way <= leg)
      return leg > 0 ? glm::mix(path[i - 1], path[i], std::max(0.0, way / leg)) : path[i];
    way -= leg;
  }
  return path.empty() ? glm::dvec3(0.0) : path.back();
}

int PieceCount(std::span<const glm::dvec3> path) {
  // A share of a piece that is rounding is no further piece.
  constexpr double kRounding = 1e-6;
  return std::max(1, static_cast<int>(std::ceil(LengthOf(path) / kPieceLength - kRounding)));
}

}  // namespace arthro::simulation
