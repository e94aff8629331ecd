#include "simulation/training/scene_of_attempt.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "simulation/core/fingerprint.h"
#include "simulation/scene/json/exercise_json.h"
#include "simulation/scene/json/lens_io.h"
#include "simulation/scene/json/scene_json.h"
#include "simulation/training/observe/surface_names.h"

namespace arthro::simulation {
namespace {

template <class T>
void Put(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// The scene without what no frame depends on. Files are told by their contents, not their names.
Scene Geometry(const Scene& scene) {
  Scene own;
  own.backdrop = scene.backdrop;
  own.scope = scene.scope;
  for (std::filesystem::path* file :
       {&own.backdrop.panorama, &own.backdrop.depth, &own.backdrop.depth_sigma,
        &own.backdrop.depth_origin, &own.backdrop.footage, &own.scope.lens})
    file->clear();
  own.backdrop.rights = own.backdrop.depth_rights = {};
  own.backdrop.relight = 0;
  own.backdrop.medium = {};
  own.portals = scene.portals;
  own.tissues = scene.tissues;
  for (Tissue& tissue : own.tissues) {
    tissue.surface.clear();
    tissue.mesh.clear();
    tissue.colour = {};
    tissue.rights = {};
  }
  return own;
}

// Files of surfaces hold 32 bits, and so does the fingerprint, before and after a save.
void PutSurface(std::string& bytes, const SurfaceMesh& surface) {
  Put(bytes, surface.vertices.size());
  for (const glm::dvec3& vertex : surface.vertices)
    for (int i = 0; i < 3; ++i) Put(bytes, static_cast<float>(vertex[i]));
  for (const auto& triangle : surface.triangles) Put(bytes, triangle);
}

}  // namespace

std::string FingerprintOfScene(const LoadedScene& loaded) {
  std::string bytes = JsonFromScene(Geometry(loaded.scene)).dump();
  if (loaded.lens) bytes += JsonFromLens(*loaded.lens);
  for (const auto& map : {loaded.depth, loaded.depth_sigma}) {
    if (!map) continue;
    Put(bytes, map->width);
    bytes.append(reinterpret_cast<const char*>(map->relief.data()),
                 map->relief.size() * sizeof(float));
  }
  for (const SharedSurface& surface : loaded.surfaces) PutSurface(bytes, OrEmpty(surface));
  return FingerprintOf(bytes);
}

bool IsOfScene(const AttemptHead& head, const LoadedScene& loaded) {
  if (!head.scene_fingerprint.empty()) return head.scene_fingerprint == FingerprintOfScene(loaded);
  return head.scene == loaded.scene.title && head.surfaces == SurfaceNames(loaded.scene);
}

std::string WhyAnotherScene(const AttemptHead& head, const LoadedScene& loaded,
                            const Exercise& exercise) {
  const Scene& scene = loaded.scene;
  if (head.exercise.empty())
    return "this attempt does not say which exercise and scene it was made in; give --reobserve to "
           "see its targets in this one";
  if (head.exercise != exercise.id)
    return fmt::format("this attempt is at the exercise {}, not at {}; give --exercise {}",
                       head.exercise, exercise.id, head.exercise);
  if (!IsOfScene(head, loaded)) {
    const std::vector<std::string> surfaces = SurfaceNames(scene);
    if (head.scene == scene.title && head.surfaces == surfaces)
      return fmt::format(
          "the scene \"{}\" has changed since this attempt; give the scene as it "
          "was, or --reobserve to see its targets in the scene as it is",
          scene.title);
    return fmt::format(
        "this attempt was made in the scene \"{}\" ({}), and this is \"{}\" ({}); "
        "give that scene, or --reobserve to see its targets in this one",
        head.scene, fmt::join(head.surfaces, ", "), scene.title, fmt::join(surfaces, ", "));
  }
  if (head.exercise_hash != HashOf(exercise))
    return fmt::format(
        "the exercise {} has changed since this attempt; give the scene with the "
        "exercise as it was, or --reobserve to assess it by the exercise as it is",
        exercise.id);
  return "";
}

}  // namespace arthro::simulation
