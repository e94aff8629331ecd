#include "authoring/models/model_in_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "authoring/project/free_tissue_name.h"
#include "simulation/core/folders/file_name.h"
#include "simulation/scene/backdrop/hidden_share.h"
#include "simulation/scene/backdrop/relief_range.h"

namespace arthro::authoring {
namespace {

constexpr glm::dvec3 kIn{0, 0, 1}, kUp{0, -1, 0};  // portal frame: right, down, in

// Distance from the relief, positive on the portal's side; NaN where nothing was imaged.
double Clearance(const LoadedScene& scene, const glm::dvec3& x) {
  const double range = glm::length(x);
  if (!(range > 0)) return scene.scene.backdrop.radius;
  return ReliefRange(x / range, OrEmpty(scene.depth), scene.scene.backdrop) - range;
}

std::optional<glm::dvec3> HitOf(const LoadedScene& scene, const glm::dvec3& from,
                                const glm::dvec3& direction) {
  constexpr double kStep = 2e-4, kFarthest = 3.0;  // m; radii of the sphere
  constexpr int kHalvings = 20;
  double before = 0;
  bool was_clear = false;
  for (double t = 0; t < kFarthest * scene.scene.backdrop.radius; t += kStep) {
    const double clearance = Clearance(scene, from + t * direction);
    if (std::isnan(clearance)) continue;
    if (clearance > 0) {
      was_clear = true;
      before = t;
      continue;
    }
    if (!was_clear) continue;  // the ray begins behind the relief
    double low = before, high = t;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (low + high);
      (Clearance(scene, from + middle * direction) > 0 ? low : high) = middle;
    }
    return from + high * direction;
  }
  return {};
}

}  // namespace

std::optional<ReliefPoint> FindOnRelief(const LoadedScene& scene, const glm::dvec3& from,
                                        const glm::dvec3& direction, double reach) {
  const glm::dvec3 to = glm::normalize(direction);
  const auto hit = HitOf(scene, from, to);
  if (!hit) return {};
  // Points of the relief around the hit, on rays from the portal, which the relief covers once.
  const double range = glm::length(*hit);
  const glm::dvec3 towards = *hit / range;
  const glm::dvec3 aside =
      glm::normalize(glm::cross(towards, std::abs(towards.y) < 0.9 ? kUp : kIn));
  const glm::dvec3 across = glm::cross(towards, aside);
  constexpr int kAround = 12;
  constexpr double kOtherSurface = 2.0;
  glm::dvec3 sum(0.0);
  for (const double share : {0.35, 0.7, 1.0}) {
    std::vector<glm::dvec3> ring;
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kAround;
      const glm::dvec3 way = glm::normalize(
          *hit + share * reach * (std::cos(angle) * aside + std::sin(angle) * across));
      const glm::dvec3 x = ReliefRange(way, OrEmpty(scene.depth), scene.scene.backdrop) * way;
      // Beyond a step of the relief lies another surface.
      if (glm::distance(x, *hit) < kOtherSurface * share * reach) ring.push_back(x);
    }
    for (std::size_t i = 0; i < ring.size(); ++i)
      sum += glm::cross(ring[i] - *hit, ring[(i + 1) % ring.size()] - *hit);
  }
  glm::dvec3 normal = glm::length(sum) > 0 ? glm::normalize(sum) : -towards;
  if (glm::dot(normal, towards) > 0) normal = -normal;
  return ReliefPoint{*hit, normal};
}

Pose Uncovered(const SurfaceMesh& surface, const Pose& laid, const LoadedScene& scene,
               const glm::dvec3& normal, const glm::dvec3& to) {
  Pose pose = laid;
  const auto hidden = [&] {
    return HiddenShare(surface, pose, OrEmpty(scene.depth), scene.scene.backdrop);
  };
  constexpr double kMostHidden = 0.25, kLift = 5e-4, kMostLift = 6e-3;
  for (double lift = 0; lift < kMostLift; lift += kLift) {
    pose.position = laid.position + lift * normal;
    if (hidden() <= kMostHidden) return pose;
  }
  // In a groove that is too narrow for it: towards the eye, out of the groove.
  constexpr double kMostlyHidden = 0.5, kStep = 5e-4, kFarthest = 25e-3;
  for (double back = 0; back < kFarthest && hidden() > kMostlyHidden; back += kStep)
    pose.position -= kStep * to;
  return pose;
}

Pose PoseOnRelief(const LibraryModel& model, const LoadedScene& scene, const glm::dvec3& from,
                  const glm::dvec3& direction) {
  double reach = 0;
  for (const glm::dvec3& x : model.surface.vertices) reach = std::max(reach, std::hypot(x.x, x.y));
  const glm::dvec3 to = glm::normalize(direction);
  const ReliefPoint point =
      FindOnRelief(scene, from, to, 0.7 * reach)
          .value_or(ReliefPoint{from + 0.35 * scene.scene.backdrop.radius * to, -to});
  // x right, y into the joint and z up are the model's axes where the relief is level.
  const glm::dvec3 z = point.normal;
  const glm::dvec3 wished = std::abs(glm::dot(z, kIn)) < 0.9 ? kIn : kUp;
  const glm::dvec3 y = glm::normalize(wished - glm::dot(wished, z) * z);
  Pose pose;
  pose.position = point.place;
  pose.quaternion = glm::normalize(glm::quat_cast(glm::dmat3(glm::cross(y, z), y, z)));
  return Uncovered(model.surface, pose, scene, z, to);
}

void AddModel(Document& document, const LibraryModel& model, const Pose& pose,
              std::vector<Cut> cuts, const std::filesystem::path& mesh) {
  Tissue tissue = TissueOf(model);
  tissue.name = FreeTissueName(document.scene, tissue.name);
  tissue.pose = pose;
  tissue.cuts = std::move(cuts);
  if (!mesh.empty()) {
    const std::string name = "tissues/" + FileNameFrom(tissue.name, "tissue") + ".vtu";
    tissue.mesh = name;
    document.files[name].file = mesh;
  }
  document.scene.tissues.push_back(std::move(tissue));
  document.surfaces.push_back(Share(model.surface));
}

}  // namespace arthro::authoring
