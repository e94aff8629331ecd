// A sparse symmetric matrix of 3×3 blocks, one row a node, both triangles stored. The pattern is
// shared and made once a mesh; the values change every step. Multiply allocates nothing.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace arthro::simulation {

struct BlockPattern {
  std::vector<int> row_begin;  // node_count + 1
  std::vector<int> column;     // rising within a row
  std::vector<int> diagonal;   // where block (i, i) is
  int node_count() const { return static_cast<int>(diagonal.size()); }
  // Where block (row, column) is; −1: not there.
  int Find(int row, int column) const;
  bool operator==(const BlockPattern&) const = default;
};

// Every two nodes of one element meet.
BlockPattern PatternOf(std::span<const int> elements, int nodes_per_element, int node_count);

struct BlockMatrix {
  std::shared_ptr<const BlockPattern> pattern;
  std::vector<std::array<double, 9>> block;  // row-major, one an entry of pattern->column
};

struct ElementKernel;

// y = A x. Vectorised for the processor it runs on (`kernel`: null is the fastest); the same bits
// on all of them.
void Multiply(const BlockMatrix& a, std::span<const glm::dvec3> x, std::span<glm::dvec3> y,
              const ElementKernel* kernel = nullptr) noexcept;
// Three products, the matrix read once for all; each is what Multiply gives.
void MultiplyThree(const BlockMatrix& a, const std::array<std::span<const glm::dvec3>, 3>& x,
                   const std::array<std::span<glm::dvec3>, 3>& y,
                   const ElementKernel* kernel = nullptr) noexcept;

}  // namespace arthro::simulation
