// Path of straight legs between points, in pieces of at most 1 mm, and distances of a tip or of a
// view axis from it. Portal frame, m.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/training/observe/attempt_frame.h"

namespace arthro::simulation {

inline constexpr double kPieceLength = 1e-3;  // m

// A tip, or a view axis from the lens.
struct Pointer {
  glm::dvec3 origin{0.0};
  std::optional<glm::dvec3> axis;  // unit; nothing: the tip itself
};

Pointer TipPointer(const AttemptFrame& frame);
// The lens and the centre of its view [method.md, Oblique view].
Pointer ViewPointer(const AttemptFrame& frame);

// Distance of a point or of a straight segment from the pointer. A part behind the lens counts with
// its distance from the lens.
double DistanceTo(const Pointer& pointer, const glm::dvec3& a, const glm::dvec3& b);

double LengthOf(std::span<const glm::dvec3> path);
// Point at `way` from the start, m; the ends of the path beyond them.
glm::dvec3 PointAt(std::span<const glm::dvec3> path, double way);
int PieceCount(std::span<const glm::dvec3> path);

}  // namespace arthro::simulation
