// Quality of a tetrahedral mesh. Lengths in m, angles in rad.
#pragma once

#include <cstdint>
#include <vector>

#include "simulation/scene/mesh/tet_mesh.h"

namespace arthro::authoring {

struct TetQuality {
  double volume = 0;                          // m³, of all elements
  double min_dihedral = 0, max_dihedral = 0;  // worst of all elements
  double worst_radius_edge = 0;               // circumradius over shortest edge; 0.612 is regular
  double worst_relative_volume = 0;           // least volume over longest edge cubed; 0.118 regular
  double longest_edge = 0, median_edge = 0;   // m
  // Curved elements: least det(dx/dξ) at nodes and quadrature points, over that of the element with
  // the same corners and straight edges. 1: straight; 0 or less: folded somewhere.
  double worst_jacobian = 1;
  double curved_volume = 0;  // m³, with the curved edges
  int inverted = 0;          // elements without positive volume
};

TetQuality MeasureTets(const TetMesh& mesh);

// Returns worst_jacobian of one element; 1 for order 1.
double JacobianShare(const TetMesh& mesh, int element);

// Returns 1 for each node on the outer surface: corners of faces that only one element has, and the
// middles of their sides.
std::vector<std::uint8_t> SurfaceNodes(const TetMesh& mesh);

}  // namespace arthro::authoring
