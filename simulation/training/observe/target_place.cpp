#include "simulation/training/observe/target_place.h"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "simulation/core/geometry/segment3.h"
#include "simulation/practice/cut_skin.h"
#include "simulation/scene/mesh/surface_finder.h"
#include "simulation/scope/rod_pose.h"

namespace arthro::simulation {
namespace {

// Skin of a tissue in the frame of its body, with the author's cuts; empty: it has none.
SurfaceMesh SkinAtRest(const LoadedScene& loaded, std::size_t tissue) {
  if (tissue >= loaded.scene.tissues.size() || tissue >= loaded.surfaces.size()) return {};
  const Tissue& own = loaded.scene.tissues[tissue];
  SurfaceMesh skin = OrEmpty(loaded.surfaces[tissue]);
  if (skin.triangles.empty()) return {};
  if (HasCutsMade(own)) skin = CutSkin(own, skin).surface;
  for (glm::dvec3& x : skin.vertices) x *= own.pose.scale;
  return skin;
}

glm::dvec3 NormalOf(const TriangleCorners& corner) {
  const glm::dvec3 across = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  const double area = glm::length(across);
  return area > 0 ? across / area : glm::dvec3(0.0);
}

}  // namespace

DepthField ReliefOf(const LoadedScene& loaded) {
  const Backdrop& backdrop = loaded.scene.backdrop;
  if (const DepthMap& depth = OrEmpty(loaded.depth); !depth.empty())
    return {backdrop, depth, {}, OrEmpty(loaded.depth_sigma)};
  const ColourImage& panorama = OrEmpty(loaded.panorama);
  return {backdrop, panorama.width, panorama.height};
}

std::optional<TargetPlace> TargetOnBearing(const LoadedScene& loaded, double latitude,
                                           double longitude, double radius) {
  return TargetOnBearing(loaded, ReliefOf(loaded), latitude, longitude, radius);
}

std::optional<TargetPlace> TargetOnBearing(const LoadedScene& loaded, const DepthField& relief,
                                           double latitude, double longitude, double radius) {
  const glm::dvec3 way = BasisOf({latitude, longitude, 0, 0}).axis;
  std::optional<TargetPlace> first;
  double reach = loaded.scene.backdrop.radius;
  // The clearance falls along the ray, on which all points have one pixel of the relief.
  if (relief.Query(0.5 * reach * way).weight > 0) {
    double free = 0, behind = reach * (1 + 1e-9);
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (free + behind);
      (relief.Query(middle * way).clearance > 0 ? free : behind) = middle;
    }
    first = TargetPlace{-1, free * way, relief.Query(free * way).normal, radius, false};
    reach = free;
  }
  for (std::size_t i = 0; i < loaded.scene.tissues.size(); ++i) {
    const Pose& pose = loaded.scene.tissues[i].pose;
    const Rigid3 portal_from_body{pose.quaternion, pose.position};
    const Rigid3 body_from_portal = Inverse(portal_from_body);
    const SurfaceMesh skin = SkinAtRest(loaded, i);
    for (std::size_t triangle = 0; triangle < skin.triangles.size(); ++triangle) {
      const TriangleCorners corner = CornersOf(skin, triangle);
      const Segment3 ray{body_from_portal * glm::dvec3(0.0), body_from_portal * (reach * way)};
      if (!Crosses(ray, corner)) continue;
      const glm::dvec3 normal = NormalOf(corner), along = ray.b - ray.a;
      const double share = glm::dot(corner[0] - ray.a, normal) / glm::dot(along, normal);
      first = TargetPlace{static_cast<int>(i), ray.a + share * along, normal, radius, false};
      reach *= share;
    }
  }
  return first;
}

std::optional<TargetPlace> TargetOnTissue(const LoadedScene& loaded, int tissue,
                                          const glm::dvec3& point, double radius) {
  if (tissue < 0 || static_cast<std::size_t>(tissue) >= loaded.scene.tissues.size())
    return std::nullopt;
  const auto index = static_cast<std::size_t>(tissue);
  const SurfaceMesh skin = SkinAtRest(loaded, index);
  if (skin.triangles.empty()) return std::nullopt;
  const SurfacePoint on =
      SurfaceFinder(skin).Find(loaded.scene.tissues[index].pose.scale * point, kTiedWithin);
  if (on.triangle < 0) return std::nullopt;
  return TargetPlace{tissue, on.place,
                     NormalOf(CornersOf(skin, static_cast<std::size_t>(on.triangle))), radius,
                     false};
}

TargetPlace TargetInBall(const glm::dvec3& middle_in_portal, double radius) {
  return {-1, middle_in_portal, glm::dvec3(0.0), radius, false};
}

}  // namespace arthro::simulation
