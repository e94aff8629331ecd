// Where a triangle surface runs through itself. Exact: decided by signs of determinants in adaptive
// precision (Shewchuk's predicates), so neither a grazing touch nor a near miss is misjudged.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "simulation/core/progress.h"
#include "simulation/scene/surface_mesh.h"

namespace arthro::authoring {

struct IntersectingPair {
  int first, second;  // triangles, first < second
};

inline constexpr int kMostPairs = 100000;

// All pairs of triangles with a point in common that is neither a shared corner nor on a shared
// edge, in ascending order. Triangles without area are left out. Equal triangles are not a pair
// (they are duplicates). Stops after `most` pairs.
std::vector<IntersectingPair> FindSelfIntersections(const SurfaceMesh& surface,
                                                    int most = kMostPairs,
                                                    const Progress& progress = {});

// A point near which the two triangles of a pair meet, for the sentence that a person reads.
glm::dvec3 PlaceOf(const SurfaceMesh& surface, const IntersectingPair& pair);

}  // namespace arthro::authoring
