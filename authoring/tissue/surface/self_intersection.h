// Self-intersections of a triangle surface. Exact: decided by signs of determinants in adaptive
// precision (Shewchuk's predicates), so neither a grazing touch nor a near miss is misjudged.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "simulation/core/progress.h"
#include "simulation/scene/mesh/surface_mesh.h"

namespace arthro::authoring {

struct IntersectingPair {
  int first, second;  // triangles, first < second
};

inline constexpr int kMostPairs = 100000;

// Returns all pairs of triangles with a common point that is neither a shared corner nor on a
// shared edge, in ascending order. Leaves out triangles without area and equal triangles, which are
// duplicates. Returns the first `most` pairs.
std::vector<IntersectingPair> FindSelfIntersections(const SurfaceMesh& surface,
                                                    int most = kMostPairs,
                                                    const Progress& progress = {});

// Returns a point near which the two triangles of a pair meet, for a message.
glm::dvec3 PlaceOf(const SurfaceMesh& surface, const IntersectingPair& pair);

}  // namespace arthro::authoring
