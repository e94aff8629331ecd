#include "simulation/scene/mesh/tet_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "simulation/core/error.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

constexpr double kNoVolume = 1e-15;     // relative; what rounding alone makes of a flat element
constexpr double kSliverVolume = 1e-9;  // relative; below this a solver's answer is not trusted

// Nodes at one place become the first of them.
int MergeNodes(TetMesh& mesh) {
  const auto& x = mesh.rest_positions;
  std::vector<int> order(x.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int i) { return std::array{x[i].x, x[i].y, x[i].z}; };
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return std::pair(key(a), a) < std::pair(key(b), b); });
  std::vector<int> first(x.size());
  int merged = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
    first[order[i]] = same ? first[order[i - 1]] : order[i];
    if (!same) continue;
    ++merged;
    for (auto& [name, flags] : mesh.sets) flags[first[order[i]]] |= flags[order[i]];
  }
  if (merged > 0)
    for (int& node : mesh.elements) node = first[node];
  return merged;
}

// Drops elements whose corners are those of an earlier one.
int DropRepeatedElements(TetMesh& mesh) {
  const int nodes = mesh.NodesPerElement();
  std::set<std::array<int, 4>> seen;
  std::vector<int> kept;
  kept.reserve(mesh.elements.size());
  for (auto element = mesh.elements.begin(); element != mesh.elements.end(); element += nodes) {
    std::array<int, 4> corners;
    std::copy_n(element, 4, corners.begin());
    std::sort(corners.begin(), corners.end());
    if (seen.insert(corners).second) kept.insert(kept.end(), element, element + nodes);
  }
  const int dropped = static_cast<int>(mesh.elements.size() - kept.size()) / nodes;
  mesh.elements = std::move(kept);
  return dropped;
}

int DropUnusedNodes(TetMesh& mesh) {
  std::vector<int> index(mesh.rest_positions.size(), -1);
  for (const int node : mesh.elements) index[node] = 0;
  int count = 0;
  for (std::size_t i = 0; i < index.size(); ++i) {
    if (index[i] < 0) continue;
    mesh.rest_positions[count] = mesh.rest_positions[i];
    for (auto& [name, flags] : mesh.sets) flags[count] = flags[i];
    index[i] = count++;
  }
  const int dropped = static_cast<int>(index.size()) - count;
  mesh.rest_positions.resize(count);
  for (auto& [name, flags] : mesh.sets) flags.resize(count);
  for (int& node : mesh.elements) node = index[node];
  return dropped;
}

// The same element with the other handedness: corners 0 and 1 change places, and with them the
// middles of 12 and 20, and of 03 and 13.
void TurnInsideOut(TetMesh& mesh, int element) {
  int* node = &mesh.elements[static_cast<std::size_t>(element) * mesh.NodesPerElement()];
  std::swap(node[0], node[1]);
  if (mesh.order == 2) {
    std::swap(node[5], node[6]);
    std::swap(node[7], node[8]);
  }
}

}  // namespace

double RelativeVolume(const TetMesh& mesh, int element) {
  const int* node = &mesh.elements[static_cast<std::size_t>(element) * mesh.NodesPerElement()];
  std::array<glm::dvec3, 4> x;
  for (int i = 0; i < 4; ++i) x[i] = mesh.rest_positions[node[i]];
  double longest = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j) longest = std::max(longest, glm::distance(x[i], x[j]));
  if (longest == 0) return 0;
  // Scaled first, so that neither tiny nor huge coordinates lose the cube.
  const double scale = 1.0 / longest;
  return glm::dot(glm::cross((x[1] - x[0]) * scale, (x[2] - x[0]) * scale), (x[3] - x[0]) * scale) /
         6.0;
}

void CheckAndRepair(TetMesh& mesh, const fs::path& file, TetReadReport* report) {
  for (std::size_t i = 0; i < mesh.rest_positions.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      if (!std::isfinite(mesh.rest_positions[i][axis]))
        throw Error(Code::kBadMesh,
                    fmt::format("node {} has a coordinate that is not a finite number; make the "
                                "mesh again",
                                i),
                    file);
  const auto say = [&](int count, const char* what) {
    if (count > 0) report->messages.push_back(fmt::format("{} {}", count, what));
  };
  say(MergeNodes(mesh), "nodes lay exactly on another node and were merged with it");
  say(DropRepeatedElements(mesh), "elements were there twice; the second ones were dropped");

  int turned = 0, slivers = 0;
  for (int i = 0; i < mesh.ElementCount(); ++i) {
    const double volume = RelativeVolume(mesh, i);
    if (std::abs(volume) < kNoVolume) {
      const int* node = &mesh.elements[static_cast<std::size_t>(i) * mesh.NodesPerElement()];
      const glm::dvec3 at = mesh.rest_positions[node[0]];
      throw Error(Code::kBadMesh,
                  fmt::format("element {} has no volume (near {:.6g}, {:.6g}, {:.6g} m); make the "
                              "mesh again with `arthroscene tetrahedralize`",
                              i, at.x, at.y, at.z),
                  file);
    }
    slivers += std::abs(volume) < kSliverVolume;
    if (volume < 0) {
      TurnInsideOut(mesh, i);
      ++turned;
    }
  }
  say(turned, "elements were listed inside out and were turned");
  say(slivers, "elements are nearly flat; answers near them are poor, make the mesh again");
  say(DropUnusedNodes(mesh), "nodes belong to no element and were dropped");
}

}  // namespace arthro
