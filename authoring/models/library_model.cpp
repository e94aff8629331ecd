#include "authoring/models/library_model.h"

#include <utility>

namespace arthro::authoring {

void Mirror(LibraryModel& model) {
  for (glm::dvec3& x : model.surface.vertices) x.x = -x.x;
  for (auto& triangle : model.surface.triangles) std::swap(triangle[1], triangle[2]);
  for (Region& region : model.regions) region.ball.centre.x = -region.ball.centre.x;
  for (Ball& ball : model.fixed) ball.centre.x = -ball.centre.x;
}

Tissue TissueOf(const LibraryModel& model) {
  Tissue tissue;
  tissue.name = model.name;
  tissue.material = model.material;
  tissue.fixed = model.fixed;
  tissue.regions = model.regions;
  tissue.is_implicit = model.is_solid;
  tissue.colour = model.colour;
  tissue.rights.source = "library of models of Arthroscene";
  tissue.rights.licence = "AGPL-3.0-or-later";
  return tissue;
}

}  // namespace arthro::authoring
