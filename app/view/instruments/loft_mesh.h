// Surfaces between cross-sections, for instruments made in code: smooth where they are round, with
// separate normals at edges. m.
#pragma once

#include <functional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "simulation/scene/mesh/surface_mesh.h"

namespace arthro::app {

// Closed outline with as many points as its neighbours, counter-clockwise seen from the side of the
// last section.
using Section = std::vector<glm::dvec3>;

struct LoftEdges {
  std::vector<int> corners;  // points whose lines along the loft are edges, ascending
  std::vector<int> creases;  // sections that are edges, ascending
};

// Returns a closed surface that faces outwards: sides between the sections, and a flat cap at both
// ends, which must be star-shaped around their centres.
void AddLoft(SurfaceMesh& mesh, const std::vector<Section>& sections, const LoftEdges& edges = {});

// Returns a rod around z with rings at `stations` of (z, radius), ascending in z.
void AddRod(SurfaceMesh& mesh, const std::vector<glm::dvec2>& stations, int sides,
            const std::vector<int>& creases = {});

// Places of the rings of a shaft from its far end to `end`, dense near its end, where the lens
// bends it visibly, and sparse where a joint ends.
std::vector<double> ShaftStations(double end, double length, double spacing);

}  // namespace arthro::app
