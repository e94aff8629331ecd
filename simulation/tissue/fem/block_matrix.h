// Sparse symmetric matrix of 3×3 blocks: one block row per node, both triangles stored. The pattern
// is made once per mesh and shared; the values change every step.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace arthro::simulation {

// Axes of nodes that do not respond to forces: they are fixed or have a prescribed motion. One byte
// per node; bits 1, 2, 4 are x, y, z of the mesh's own frame. Empty: no fixed axes.
using FixedAxes = std::vector<std::uint8_t>;

struct BlockPattern {
  std::vector<int> row_begin;  // node_count + 1
  std::vector<int> column;     // rising within a row
  std::vector<int> diagonal;   // position of block (i, i)
  int node_count() const { return static_cast<int>(diagonal.size()); }
  // Returns the position of block (row, column), or −1 if the pattern has none.
  int Find(int row, int column) const;
  bool operator==(const BlockPattern&) const = default;
};

// Makes the pattern in which every two nodes of an element share a block.
BlockPattern MakePattern(std::span<const int> elements, int nodes_per_element, int node_count);

struct BlockMatrix {
  std::shared_ptr<const BlockPattern> pattern;
  std::vector<std::array<double, 9>> block;  // row-major, one per entry of pattern->column
};

struct ElementKernel;

// Computes y = A x without allocating. The result has the same bits with every kernel; a null
// `kernel` picks the fastest one for this processor.
void Multiply(const BlockMatrix& a, std::span<const glm::dvec3> x, std::span<glm::dvec3> y,
              const ElementKernel* kernel = nullptr) noexcept;

}  // namespace arthro::simulation
