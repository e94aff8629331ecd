// Lays a model of the library onto the relief of a scene, and adds it as a tissue. Portal frame, m.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "authoring/models/library_model.h"
#include "authoring/project/document.h"
#include "simulation/core/frames.h"

namespace arthro::authoring {

// Point of the relief, and the direction in which it faces there.
struct ReliefPoint {
  glm::dvec3 place{0.0}, normal{0, 0, -1};
};
// Returns where a ray meets the relief, with the mean normal of the relief within `reach` of it;
// nothing where nothing was imaged.
std::optional<ReliefPoint> FindOnRelief(const LoadedScene& scene, const glm::dvec3& from,
                                        const glm::dvec3& direction, double reach);

// Lifts a surface that lies on the relief along `normal` until no more than a quarter of it is
// hidden, by 6 mm at most; in a narrow groove it is drawn back against the direction `to` of the
// view until no more than half of it is.
Pose Uncovered(const SurfaceMesh& surface, const Pose& laid, const LoadedScene& scene,
               const glm::dvec3& normal, const glm::dvec3& to);

// Pose of a model whose base lies on the relief where a ray meets it. Its z follows the normal and
// its y the direction into the joint. Where the relief is uneven it is uncovered. A ray that meets
// nothing places it on the sphere.
Pose PoseOnRelief(const LibraryModel& model, const LoadedScene& scene, const glm::dvec3& from,
                  const glm::dvec3& direction);

// Adds the model with a free name. `mesh`: file of its tetrahedra; empty for none.
void AddModel(Document& document, const LibraryModel& model, const Pose& pose,
              std::vector<Cut> cuts, const std::filesystem::path& mesh);

}  // namespace arthro::authoring
