// The elements of a mesh as the kernels read them: eight side by side, structure of arrays, so that
// one vector instruction does the same step for several elements. Rest gradients in 1/m, weights in
// m³. Within an element the nodes stand in rising order: each pair a ≤ b of them is then a block of
// the upper triangle.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/tissue/fem/material.h"

namespace arthro::simulation {

constexpr int kLanes = 8;
struct alignas(64) Lanes {
  std::array<double, kLanes> v;
};

struct ElementBatches {
  int nodes = 4, points = 1;  // an element
  int elements = 0, batches = 0;
  std::vector<std::array<int, kLanes>> node;   // [batch][a]
  std::vector<std::array<int, kLanes>> block;  // [batch][pair]: (0,0), (0,1), … (1,1), …
  std::vector<Lanes> gradient;                 // [batch][point][a][3]
  std::vector<Lanes> weight;                   // [batch][point], with the share
  std::vector<Lanes> fibre;                    // [batch][point][3], unit; empty: no fibres
  int pairs() const { return nodes * (nodes + 1) / 2; }
  // The last batch repeats its last element in the lanes that are left over.
  int lanes_used(int batch) const {
    return elements - batch * kLanes < kLanes ? elements - batch * kLanes : kLanes;
  }
};

}  // namespace arthro::simulation
