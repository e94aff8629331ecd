#include "app/view/tool_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "app/view/probe_mesh.h"

namespace arthro::app {
namespace {

using simulation::Capsule;
using simulation::ToolKind;
using simulation::ToolShape;

constexpr int kSides = 24, kCapSteps = 6;

struct Ring {
  double along, radius;  // m
};

// Stations of a rod with rounded ends: caps, and rings between them.
std::vector<Ring> RingsOf(double length, double radius, double spacing) {
  std::vector<Ring> rings;
  const auto cap = [&](int i) { return std::numbers::pi / 2 * i / kCapSteps; };
  for (int i = 0; i < kCapSteps; ++i)
    rings.push_back({-radius * std::cos(cap(i)), radius * std::max(std::sin(cap(i)), 1e-3)});
  const int straight = std::max(1, static_cast<int>(std::ceil(length / spacing)));
  for (int i = 0; i <= straight; ++i) rings.push_back({length * i / straight, radius});
  for (int i = kCapSteps - 1; i >= 0; --i)
    rings.push_back(
        {length + radius * std::cos(cap(i)), radius * std::max(std::sin(cap(i)), 1e-3)});
  return rings;
}

// Quads between rings, but for those that `is_open` leaves out.
template <class IsOpen>
void AddSweep(SurfaceMesh& mesh, const Capsule& capsule, const std::vector<Ring>& rings,
              const IsOpen& is_open) {
  const glm::dvec3 way = capsule.b - capsule.a;
  const glm::dvec3 along = glm::length(way) > 0 ? glm::normalize(way) : glm::dvec3(0, 0, 1);
  // Angles run from +y, so that windows are where the shape says.
  const glm::dvec3 up = std::abs(along.y) < 0.9
                            ? glm::normalize(glm::dvec3(0, 1, 0) - along.y * along)
                            : glm::normalize(glm::cross(along, glm::dvec3(1, 0, 0)));
  const glm::dvec3 side = glm::cross(up, along);
  const int first = static_cast<int>(mesh.vertices.size());
  for (const Ring& ring : rings)
    for (int i = 0; i < kSides; ++i) {
      const double a = 2.0 * std::numbers::pi * i / kSides;
      mesh.vertices.push_back(capsule.a + ring.along * along +
                              ring.radius * (std::cos(a) * up + std::sin(a) * side));
    }
  for (int r = 0; r + 1 < static_cast<int>(rings.size()); ++r)
    for (int i = 0; i < kSides; ++i) {
      if (is_open(r, i)) continue;
      const int a = first + r * kSides + i, b = first + r * kSides + (i + 1) % kSides;
      mesh.triangles.push_back({a, b + kSides, b});
      mesh.triangles.push_back({a, a + kSides, b + kSides});
    }
}

void AddCapsule(SurfaceMesh& mesh, const Capsule& capsule, double spacing) {
  AddSweep(mesh, capsule, RingsOf(glm::distance(capsule.a, capsule.b), capsule.radius, spacing),
           [](int, int) { return false; });
}

// A tube with a window towards +y, from `low` to `high` along z and `half` to either side.
struct Window {
  double low, high, half;
};
void AddTube(SurfaceMesh& mesh, const Capsule& tube, const Window& window, double spacing) {
  const std::vector<Ring> rings =
      RingsOf(glm::distance(tube.a, tube.b), tube.radius, std::min(spacing, 0.5e-3));
  AddSweep(mesh, tube, rings, [&](int r, int i) {
    const auto at = static_cast<std::size_t>(r);
    const double z = tube.a.z + 0.5 * (rings[at].along + rings[at + 1].along);
    double angle = 2.0 * std::numbers::pi * (i + 0.5) / kSides;
    if (angle > std::numbers::pi) angle -= 2.0 * std::numbers::pi;
    return z > window.low && z < window.high && std::abs(angle) < window.half;
  });
}

// The outer tube's window is where the shape takes tissue; the blade inside has one like it, with
// which it cuts as it runs past.
void AddShaver(ToolMesh& tool, const ToolShape& shape, double spacing) {
  constexpr double kWall = 0.3e-3;    // m, of the outer tube
  constexpr double kHalfWidth = 1.0;  // rad
  const Capsule& tube = shape.capsules.front();
  const Window window{shape.bite.a.z - 0.5e-3, shape.bite.b.z + 0.8e-3, kHalfWidth};
  AddTube(tool.body, tube, window, spacing);
  Capsule blade = tube;
  blade.radius = tube.radius - kWall;
  blade.a.z = window.low - 6e-3;  // more of it is never seen
  AddTube(tool.moving, blade, window, spacing);
  tool.axis = {0, 0, 1};
  tool.turns_freely = true;
}

}  // namespace

ToolMesh MakeToolMesh(ToolKind kind, double ring_spacing, double shaft_length) {
  ToolMesh tool;
  if (kind == ToolKind::kNone) return tool;
  if (kind == ToolKind::kProbe) {
    ProbeShape probe;
    probe.ring_spacing = ring_spacing;
    probe.shaft_length = shaft_length;
    tool.body = MakeProbeMesh(probe);
    return tool;
  }
  ToolShape shape = simulation::ShapeOf(kind);
  for (Capsule& capsule : shape.capsules) capsule.a.z = std::max(capsule.a.z, -shaft_length);
  if (kind == ToolKind::kShaver) {
    AddShaver(tool, shape, ring_spacing);
    return tool;
  }
  for (std::size_t i = 0; i < shape.capsules.size(); ++i) {
    const bool is_jaw = std::ranges::count(shape.jaw, static_cast<int>(i)) > 0;
    AddCapsule(is_jaw ? tool.moving : tool.body, shape.capsules[i], ring_spacing);
  }
  tool.hinge = shape.hinge;
  tool.axis = shape.hinge_axis;
  tool.max_opening = shape.max_opening;
  return tool;
}

Pose MovingPart(const ToolMesh& mesh, double opening, double turn) {
  const double angle = mesh.turns_freely ? turn : std::clamp(opening, 0.0, 1.0) * mesh.max_opening;
  Pose pose;
  pose.quaternion = glm::angleAxis(angle, mesh.axis);
  pose.position = mesh.hinge - pose.quaternion * mesh.hinge;
  return pose;
}

}  // namespace arthro::app
