// The inner loops, once for each instruction set. All of them do the same arithmetic lane by lane,
// so that all give the same bits.
#pragma once

#include <array>
#include <span>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "simulation/tissue/fem/element_batches.h"
#include "simulation/tissue/fem/fem_model.h"

namespace arthro::simulation {

// What the laws need of the material, Pa.
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
  glm::dvec3* force;             // added to
  std::array<double, 9>* block;  // upper triangle, added to; null without a tangent
};

struct MultiplyJob {
  int rows;
  const int* row_begin;
  const int* column;
  const std::array<double, 9>* block;
  int vectors;  // 1 or 3
  std::array<const glm::dvec3*, 3> x;
  std::array<glm::dvec3*, 3> y;
};

struct PointJob {
  LawConstants constants;
  Law law;
  Tangent tangent;
  std::array<double, 9> f;  // row-major
  std::array<double, 3> fibre;
};
// Everything a quadrature point answers.
struct PointAnswer {
  double psi = 0, j = 0;           // J/m³
  std::array<double, 9> p{};       // Pa, row-major
  std::array<double, 81> dp_df{};  // Pa, entry (3i+k, 3j+l) = ∂P_ik/∂F_jl
};

struct ElementKernel {
  const char* name;
  Assembly (*assemble)(const AssemblyJob&) noexcept;
  // Each matrix becomes the rotation next to it (proper, whatever the matrix).
  void (*rotations)(std::span<glm::dmat3>) noexcept;
  // The mean gradient of each element, weighted by volume, added to its nodes.
  void (*add_gradients)(const ElementBatches&, const glm::dvec3* x, glm::dmat3* at_node) noexcept;
  // Fills the lower triangle; `mirror`: an entry of the pattern to the transposed one.
  void (*mirror)(const BlockPattern&, const int* mirror, std::array<double, 9>* block) noexcept;
  void (*multiply)(const MultiplyJob&) noexcept;
  PointAnswer (*point)(const PointJob&) noexcept;
};

// Null: this processor does not have it.
const ElementKernel* KernelOf(InstructionSet set) noexcept;
// The fastest this processor has.
const ElementKernel& BestKernel() noexcept;

}  // namespace arthro::simulation
