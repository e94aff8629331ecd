// Tetrahedral mesh ready for deformation. It holds shape-function gradients and weights at the
// quadrature points (one per T4, four per isoparametric T10), lumped masses and the block pattern.
// Its kernels turn positions into energy, forces and tangent. Positions are in the mesh's own
// frame, m; forces in N, energy in J.
// A cut body is the same mesh with a share per quadrature point: the fraction of its volume that
// remains.
// there.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "simulation/scene/mesh/tet_mesh.h"
#include "simulation/tissue/fem/block_matrix.h"
#include "simulation/tissue/fem/element_batches.h"
#include "simulation/tissue/fem/material.h"

namespace arthro::simulation {

// Kind of tangent to compute. kTrue is ∂²Ψ/∂F² itself. kProjected sets the negative eigenvalues of
// each quadrature point's 9×9 to zero, separately for matrix and fibres, so the sum is positive
// semidefinite.
enum class Tangent { kNone, kTrue, kProjected };

struct ElementKernel;  // element_kernel.h: the inner loops, one per instruction set

struct Assembly {
  double energy = 0;     // J, elastic
  int inverted = 0;      // elements with J ≤ 0 at a quadrature point
  double min_ratio = 1;  // smallest J = det F at a quadrature point
};

class FemModel {
 public:
  // `share` has points_per_element() values per element, each from 0 to 1; empty means 1
  // everywhere. Throws Error(kBadArgument) for a material that cannot be computed with (ν ≥ 0.5, E
  // ≤ 0, density ≤ 0, not finite). Throws Error(kBadMesh) for an element without volume at a
  // quadrature point.
  FemModel(const TetMesh& mesh, const Material& material, std::span<const double> share = {});

  const TetMesh& mesh() const { return mesh_; }
  const Material& material() const { return material_; }
  int node_count() const { return static_cast<int>(mesh_.rest_positions.size()); }
  int points_per_element() const { return mesh_.order == 2 ? 4 : 1; }
  const std::shared_ptr<const BlockPattern>& pattern() const { return pattern_; }
  std::span<const double> mass() const { return mass_; }  // kg per node, lumped (HRZ), positive
  double volume() const { return volume_; }               // m³, including the shares
  std::span<const double> shares() const { return share_; }
  std::vector<double> NodeShares() const;  // per node: remaining volume fraction of its elements

  // Sets new shares on the same elements and recomputes the masses.
  void SetShares(std::span<const double> share);

  // Computes the elastic energy, the forces (−gradient) and, unless kNone, the tangent −∂force/∂x.
  // Overwrites `force` and `stiffness`; the pattern of `stiffness` must be pattern(). `law` may
  // differ from the material's own: the fallback that recovers from any start is corotated.
  // Allocates nothing and sums in a fixed order, so every processor gives the same bits. Input that
  // is not finite gives output that is not finite, without a crash. A null `kernel` picks the
  // fastest one.
  Assembly Assemble(std::span<const glm::dvec3> x, Law law, Tangent tangent,
                    std::span<glm::dvec3> force, BlockMatrix* stiffness,
                    const ElementKernel* kernel = nullptr) const noexcept;

  // Computes the rotation of each node's neighbourhood from the volume-weighted mean F of its
  // elements. The rotation is proper even where that mean is inverted or flat.
  void NodeRotations(std::span<const glm::dvec3> x, std::span<glm::dmat3> rotation,
                     const ElementKernel* kernel = nullptr) const noexcept;

  // Adds ∫ N b dV for a constant force per volume b (N/m³), integrated consistently and with the
  // shares.
  void AddBodyForce(const glm::dvec3& per_volume, std::span<glm::dvec3> force) const;

 private:
  TetMesh mesh_;
  Material material_;
  std::shared_ptr<const BlockPattern> pattern_;
  std::vector<double> mass_;
  double volume_ = 0;
  ElementBatches batches_;
  std::vector<double> whole_volume_;  // m³ per quadrature point, without shares
  std::vector<double> share_;         // per quadrature point
  std::vector<int> mirror_;           // per pattern entry: position of the transposed entry
};

// Adds `total` (N) to `force` as a uniform traction, integrated consistently. It acts on the
// surface triangles whose corners are all in `set` (0/1 per node). Returns the area of these
// triangles in m², 0 if there are none.
double AddSurfaceLoad(const TetMesh& mesh, std::span<const unsigned char> set,
                      const glm::dvec3& total, std::span<glm::dvec3> force);

}  // namespace arthro::simulation
