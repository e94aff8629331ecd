// The phantom's deformable models: closed, outward-facing surfaces in frames of their own, and
// where they truly lie.
#pragma once

#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "authoring/phantom/cavity.h"
#include "simulation/core/frames.h"
#include "simulation/scene/scene.h"
#include "simulation/scene/surface_mesh.h"
#include "simulation/scene/tet_mesh.h"

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
      rims;      // a vertex: 0 at the meniscus' free edge, 1 at its outer rim; else empty
  TetMesh mesh;  // quadratic; empty: a thin layer, which needs none
  std::vector<Ball> fixed;  // where it is held
  std::vector<Landmark> landmarks;
};

// The medial meniscus: a crescent wedge on the plateau, thin at its free inner edge, thick at its
// outer rim. Its frame stands in the crescent's middle, x medial and z up, turned a little about z.
PhantomTissue MakeMeniscus(const Cavity& cavity);

// The layer of cartilage that fills the plateau's bed flush. Its frame stands in the layer's
// middle, z up.
PhantomTissue MakeCartilage(const Cavity& cavity);

// A surface as it lies in the scene.
SurfaceMesh InPortal(const PhantomTissue& tissue);

}  // namespace arthro::authoring
