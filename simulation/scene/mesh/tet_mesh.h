// A tetrahedral volume as a plain value, rest positions in metres. Order 1 has 4 nodes an element,
// order 2 has 10 in VTK's order: corners 0-3, then the middles of 01, 12, 20, 03, 13, 23. Elements
// are positive: det(x1-x0, x2-x0, x3-x0) > 0. A set is a 0/1 flag a node (CASE.json names them).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace arthro {

struct TetMesh {
  int order = 1;
  std::vector<glm::dvec3> rest_positions;                 // m
  std::vector<int> elements;                              // node indices, NodesPerElement() a row
  std::map<std::string, std::vector<std::uint8_t>> sets;  // name -> 0/1 a node

  int NodesPerElement() const { return order == 2 ? 10 : 4; }
  int ElementCount() const { return static_cast<int>(elements.size()) / NodesPerElement(); }
};

}  // namespace arthro
