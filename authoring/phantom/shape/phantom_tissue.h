// Deformable models of the phantom: closed, outward-facing surfaces in frames of their own, and
// their true poses.
#pragma once

#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "authoring/phantom/shape/cavity.h"
#include "simulation/core/frames.h"
#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scene/mesh/tet_mesh.h"
#include "simulation/scene/scene.h"

namespace arthro::authoring {

struct Landmark {
  std::string name;
  glm::dvec3 x_in_portal{0.0};  // m
};

struct PhantomTissue {
  std::string name;
  SurfaceMesh surface;      // own frame, m
  Pose portal_from_tissue;  // scale 1
  std::vector<double>
      rims;  // one per vertex: 0 at the meniscus' free edge, 1 at its outer rim; otherwise empty
  TetMesh mesh;             // quadratic; empty for a thin layer, which needs no mesh
  std::vector<Ball> fixed;  // regions at which it is fixed
  std::vector<Landmark> landmarks;
};

// Medial meniscus: a crescent wedge on the plateau, thin at its free inner edge, thick at its outer
// rim. The origin of its frame is the crescent's middle, x medial and z up, rotated a little about
// z.
PhantomTissue MakeMeniscus(const Cavity& cavity);

// Layer of cartilage that fills the plateau's bed flush. The origin of its frame is the layer's
// middle, z up.
PhantomTissue MakeCartilage(const Cavity& cavity);

// Surface of a tissue in the portal frame.
SurfaceMesh InPortal(const PhantomTissue& tissue);

}  // namespace arthro::authoring
