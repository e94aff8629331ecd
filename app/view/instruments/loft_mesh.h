// Surfaces between cross-sections, for instruments made in code: smooth where they are round, with
// an edge of its own where the real thing has one. m.
#pragma once

#include <functional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "simulation/scene/surface_mesh.h"

namespace arthro::app {

// A closed outline of as many points as its neighbours have, counter-clockwise seen from the last
// section's side.
using Section = std::vector<glm::dvec3>;

struct LoftEdges {
  std::vector<int> corners;  // points whose lines along the loft are edges, ascending
  std::vector<int> creases;  // sections that are edges, ascending
};

// Closed and outward: sides between the sections, and a flat cap at both ends, which must be
// star-shaped about their middle.
void AddLoft(SurfaceMesh& mesh, const std::vector<Section>& sections, const LoftEdges& edges = {});

// A rod about z with rings at `stations` of (z, radius), ascending in z.
void AddRod(SurfaceMesh& mesh, const std::vector<glm::dvec2>& stations, int sides,
            const std::vector<int>& creases = {});

// Ring places of a shaft from its far end to `end`, close together near its end, where the lens'
// bend shows, and far apart where a joint ends.
std::vector<double> ShaftStations(double end, double length, double spacing);

}  // namespace arthro::app
