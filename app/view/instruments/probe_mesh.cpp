#include "app/view/instruments/probe_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/view/instruments/loft_mesh.h"
#include "simulation/scope/rod_pose.h"

namespace arthro::app {
namespace {

// Cross-section of the sweep: a circle around `centre`, normal to the path in the yz plane.
struct Ring {
  double y, z;   // centre
  double angle;  // direction of the path, from +z towards +y
  double radius;
};

std::vector<Ring> RingsOf(const ProbeShape& s) {
  std::vector<Ring> rings;
  const double bend = 1.6 * s.neck_radius;  // radius of the centre line
  const double elbow = -s.neck_radius - bend;

  // Shaft and taper, smooth at both ends.
  for (const double z : ShaftStations(elbow, s.shaft_length + elbow, s.ring_spacing)) {
    const double t = std::clamp((z - (elbow - s.taper_length)) / s.taper_length, 0.0, 1.0);
    const double smooth = t * t * (3.0 - 2.0 * t);
    rings.push_back({0.0, z, 0.0, s.shaft_radius + (s.neck_radius - s.shaft_radius) * smooth});
  }
  // Bend, and hook that tapers to its end.
  const double hook_end = s.hook_length - s.point_radius;
  const double path = bend * std::numbers::pi / 2 + std::max(hook_end - bend, 0.0);
  const auto radius_at = [&](double along) {
    return s.neck_radius + (s.point_radius - s.neck_radius) * std::min(along / path, 1.0);
  };
  constexpr int kBendSteps = 12, kHookSteps = 8, kCapSteps = 6;
  for (int i = 1; i <= kBendSteps; ++i) {
    const double angle = std::numbers::pi / 2 * i / kBendSteps;
    rings.push_back({bend * (1.0 - std::cos(angle)), elbow + bend * std::sin(angle), angle,
                     radius_at(bend * angle)});
  }
  for (int i = 1; i <= kHookSteps; ++i) {
    const double y = bend + (hook_end - bend) * i / kHookSteps;
    rings.push_back({y, -s.neck_radius, std::numbers::pi / 2,
                     radius_at(bend * std::numbers::pi / 2 + y - bend)});
  }
  // Rounded end.
  for (int i = 1; i <= kCapSteps; ++i) {
    const double a = std::numbers::pi / 2 * i / kCapSteps;
    rings.push_back({hook_end + s.point_radius * std::sin(a), -s.neck_radius, std::numbers::pi / 2,
                     s.point_radius * std::max(std::cos(a), 1e-3)});
  }
  return rings;
}

}  // namespace

SurfaceMesh MakeProbeMesh(const ProbeShape& shape) {
  SurfaceMesh mesh;
  const std::vector<Ring> rings = RingsOf(shape);
  for (const Ring& ring : rings)
    for (int i = 0; i < shape.sides; ++i) {
      const double a = 2.0 * std::numbers::pi * i / shape.sides;
      // Axes across the path: x, and the path's direction turned back by a right angle.
      const double x = ring.radius * std::cos(a), across = ring.radius * std::sin(a);
      mesh.vertices.push_back(
          {x, ring.y + across * std::cos(ring.angle), ring.z - across * std::sin(ring.angle)});
    }
  // The taper lifts the hook's side slightly off the plane; the place farthest along the rod
  // touches it.
  double farthest = mesh.vertices.front().z;
  for (const glm::dvec3& vertex : mesh.vertices) farthest = std::max(farthest, vertex.z);
  for (glm::dvec3& vertex : mesh.vertices) vertex.z -= farthest;

  const int sides = shape.sides;
  for (int r = 0; r + 1 < static_cast<int>(rings.size()); ++r)
    for (int i = 0; i < sides; ++i) {
      const int a = r * sides + i, b = r * sides + (i + 1) % sides;
      mesh.triangles.push_back({a, b, b + sides});
      mesh.triangles.push_back({a, b + sides, a + sides});
    }
  // Both ends are closed: the far one flat, the hook's by a point.
  const int last = (static_cast<int>(rings.size()) - 1) * sides;
  const int middle = static_cast<int>(mesh.vertices.size());
  mesh.vertices.push_back({0.0, 0.0, mesh.vertices.front().z});
  mesh.vertices.push_back(
      {0.0, shape.hook_length, mesh.vertices[static_cast<std::size_t>(last)].z});
  for (int i = 0; i < sides; ++i) {
    const int j = (i + 1) % sides;
    mesh.triangles.push_back({j, i, middle});
    mesh.triangles.push_back({last + i, last + j, middle + 1});
  }
  return mesh;
}

Pose ProbePose(const glm::dvec3& portal, const glm::dvec3& proxy, double roll) {
  const Rigid3 portal_from_tool = simulation::PortalFromTool(portal, proxy, roll);
  Pose pose;
  pose.position = portal_from_tool.translation;
  pose.quaternion = portal_from_tool.rotation;
  return pose;
}

}  // namespace arthro::app
