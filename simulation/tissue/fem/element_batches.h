// Elements in the layout that the kernels read: eight side by side, structure of arrays, so that
// one vector instruction handles several elements. Rest gradients are in 1/m, weights in m³. The
// nodes of an element stand in rising order, so each pair a ≤ b is a block of the upper triangle.
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
  int nodes = 4, points = 1;  // per element
  int elements = 0, batches = 0;
  std::vector<std::array<int, kLanes>> node;   // [batch][a]
  std::vector<std::array<int, kLanes>> block;  // [batch][pair]: (0,0), (0,1), … (1,1), …
  std::vector<Lanes> gradient;                 // [batch][point][a][3]
  std::vector<Lanes> weight;                   // [batch][point], including the share
  std::vector<Lanes> fibre;                    // [batch][point][3], unit vector; empty: no fibres
  int pairs() const { return nodes * (nodes + 1) / 2; }
  // Number of lanes in use. The last batch repeats its last element in the unused lanes.
  int lanes_used(int batch) const {
    return elements - batch * kLanes < kLanes ? elements - batch * kLanes : kLanes;
  }
};

}  // namespace arthro::simulation
