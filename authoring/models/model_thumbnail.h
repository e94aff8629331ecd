// Small picture of a model as shaded triangles, so that a list of models needs no renderer: the
// simplified surface seen obliquely from above, farthest triangle first. Places from 0 to 1, y
// down.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scene/tissue_parts.h"

namespace arthro::authoring {

struct ModelThumbnail {
  struct Facet {
    std::array<glm::vec2, 3> at;
    float light = 0;  // 0 to 1
  };
  std::vector<Facet> facets;
  std::vector<std::vector<glm::vec2>> tears;  // paths of tears
};

// `most_triangles` bounds the cost of drawing it.
ModelThumbnail ThumbnailOf(const SurfaceMesh& surface, std::span<const Cut> cuts,
                           int most_triangles = 500);

}  // namespace arthro::authoring
