// A tetrahedral mesh ready to be deformed: shape-function gradients and weights at the quadrature
// points (one of T4, four of isoparametric T10), lumped masses, the block pattern, and the kernels
// that turn positions into energy, forces and tangent. Positions in the mesh's own frame, m; N, J.
// A cut body is the same mesh with shares: what part of each quadrature point's volume is still
// there.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "simulation/scene/tet_mesh.h"
#include "simulation/tissue/fem/block_matrix.h"
#include "simulation/tissue/fem/element_batches.h"
#include "simulation/tissue/fem/material.h"

namespace arthro::simulation {

// How much of the tangent is asked for. kTrue is ∂²Ψ/∂F² as it is; kProjected has the negative
// eigenvalues of each quadrature point's 9×9 set to zero, those of the matrix and of the fibres
// each for themselves, so the sum is positive semidefinite.
enum class Tangent { kNone, kTrue, kProjected };

struct ElementKernel;  // element_kernel.h: the inner loops, once an instruction set

struct Assembly {
  double energy = 0;     // J, elastic
  int inverted = 0;      // elements with J ≤ 0 at a quadrature point
  double min_ratio = 1;  // smallest J = det F at a quadrature point
};

class FemModel {
 public:
  // `share`: points_per_element() an element, 0 to 1; empty: whole. Throws Error(kBadArgument) for
  // a material that cannot be computed with (ν ≥ 0.5, E ≤ 0, density ≤ 0, not finite) and
  // Error(kBadMesh) for an element without volume at a quadrature point.
  FemModel(const TetMesh& mesh, const Material& material, std::span<const double> share = {});

  const TetMesh& mesh() const { return mesh_; }
  const Material& material() const { return material_; }
  int node_count() const { return static_cast<int>(mesh_.rest_positions.size()); }
  int points_per_element() const { return mesh_.order == 2 ? 4 : 1; }
  const std::shared_ptr<const BlockPattern>& pattern() const { return pattern_; }
  std::span<const double> mass() const { return mass_; }  // kg a node, lumped (HRZ), positive
  double volume() const { return volume_; }               // m³, with the shares
  std::span<const double> shares() const { return share_; }
  std::vector<double> NodeShares() const;  // a node: what part of its elements is still there

  // New shares on the same elements; masses follow.
  void SetShares(std::span<const double> share);

  // Elastic energy, forces (−gradient; overwritten) and, unless kNone, the tangent −∂force/∂x
  // (overwritten; its pattern must be pattern()). `law` may differ from the material's own: the
  // fallback that recovers from any start is corotated. Allocates nothing, fixed order of sums: the
  // same bits on every processor. Not finite in, not finite out, no crash. `kernel`: null is the
  // fastest of this processor.
  Assembly Assemble(std::span<const glm::dvec3> x, Law law, Tangent tangent,
                    std::span<glm::dvec3> force, BlockMatrix* stiffness,
                    const ElementKernel* kernel = nullptr) const noexcept;

  // Rotation of each node's neighbourhood, from the volume-weighted mean F of its elements (proper,
  // also where that is inverted or flat).
  void NodeRotations(std::span<const glm::dvec3> x, std::span<glm::dmat3> rotation,
                     const ElementKernel* kernel = nullptr) const noexcept;

  // ∫ N b dV of a constant force a volume (N/m³), consistently integrated, with the shares.
  void AddBodyForce(const glm::dvec3& per_volume, std::span<glm::dvec3> force) const;

 private:
  TetMesh mesh_;
  Material material_;
  std::shared_ptr<const BlockPattern> pattern_;
  std::vector<double> mass_;
  double volume_ = 0;
  ElementBatches batches_;
  std::vector<double> whole_volume_;  // m³ a quadrature point, without shares
  std::vector<double> share_;         // a quadrature point
  std::vector<int> mirror_;           // an entry of the pattern: where the transposed one is
};

// `total` (N) as uniform traction over the surface triangles whose corners are all in `set` (0/1 a
// node), consistently integrated, added to `force`. Returns the triangles' area, m²; 0: none.
double AddSurfaceLoad(const TetMesh& mesh, std::span<const unsigned char> set,
                      const glm::dvec3& total, std::span<glm::dvec3> force);

}  // namespace arthro::simulation
