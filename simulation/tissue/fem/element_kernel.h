// Inner loops of the elements, one set per instruction set. All sets do the same arithmetic lane by
// lane, so all give the same bits.
#pragma once

#include <array>
#include <span>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "simulation/tissue/fem/element_batches.h"
#include "simulation/tissue/fem/fem_model.h"

namespace arthro::simulation {

// Material constants of the laws, Pa.
struct LawConstants {
  double mu = 0, lambda = 0;
  double fibre = 0;
  bool fibres_bear_compression = true;
};

enum class InstructionSet { kScalar, kSse2, kAvx2, kAvx512 };

struct AssemblyJob {
  const ElementBatches* batches;
  LawConstants constants;
  Law law;
  Tangent tangent;
  const glm::dvec3* x;
  glm::dvec3* force;             // output, added to
  std::array<double, 9>* block;  // output, upper triangle, added to; null without a tangent
};

struct MultiplyJob {
  int rows;
  const int* row_begin;
  const int* column;
  const std::array<double, 9>* block;
  const glm::dvec3* x;
  glm::dvec3* y;  // output
};

struct PointJob {
  LawConstants constants;
  Law law;
  Tangent tangent;
  std::array<double, 9> f;  // row-major
  std::array<double, 3> fibre;
};
// Response of a quadrature point.
struct PointResponse {
  double psi = 0, j = 0;           // J/m³
  std::array<double, 9> p{};       // Pa, row-major
  std::array<double, 81> dp_df{};  // Pa, entry (3i+k, 3j+l) = ∂P_ik/∂F_jl
};

struct ElementKernel {
  const char* name;
  Assembly (*assemble)(const AssemblyJob&) noexcept;
  // Replaces each matrix by the rotation nearest to it (proper for every matrix).
  void (*rotations)(std::span<glm::dmat3>) noexcept;
  // Adds the mean gradient of each element, weighted by volume, to its nodes.
  void (*add_gradients)(const ElementBatches&, const glm::dvec3* x, glm::dmat3* at_node) noexcept;
  // Fills the lower triangle; `mirror` maps an entry of the pattern to the transposed entry.
  void (*mirror)(const BlockPattern&, const int* mirror, std::array<double, 9>* block) noexcept;
  void (*multiply)(const MultiplyJob&) noexcept;
  PointResponse (*point)(const PointJob&) noexcept;
};

// Returns null if this processor lacks the instruction set.
const ElementKernel* KernelOf(InstructionSet set) noexcept;
// Returns the fastest kernel of this processor.
const ElementKernel& BestKernel() noexcept;

}  // namespace arthro::simulation
