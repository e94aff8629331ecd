// A tetrahedral body in Bullet's implicit deformable world, as a peer of ours: same nodes,
// elements, masses, held nodes and forces. Bullet's stopping rules are absolute, so it computes in
// centimetres, grams and seconds, where they suit a piece of tissue; this class takes and gives SI.
#pragma once

#include <memory>
#include <span>

#include <glm/vec3.hpp>

#include "simulation/scene/mesh/tet_mesh.h"
#include "simulation/tissue/fem/material.h"

namespace arthro::test {

// Options of btDeformableBodySolver. The defaults are Bullet's own (3.24).
struct BulletOptions {
  int max_cg_iterations = 300;
  double cg_tolerance = 1.1920929e-7;  // r·z over min(1, r₀·z₀): SIMD_EPSILON
  double damping = 0;                  // stiffness-proportional, s
};

class BulletBody {
 public:
  // Linear elements, corotated law. `held`: nodes that do not move (mass 0). `force` in N a node.
  BulletBody(const TetMesh& mesh, const simulation::Material& material,
             std::span<const double> mass, std::span<const unsigned char> held,
             std::span<const glm::dvec3> force, const BulletOptions& options);
  ~BulletBody();

  void Step(double dt);
  glm::dvec3 Position(int node) const;  // m

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace arthro::test
