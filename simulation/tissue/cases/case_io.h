// CASE.json and result.json of the job `solve` [method.md, File formats]: one body, its fixed and
// displaced sets and loads, and its solution. SI units, mesh's own frame.
// A set is a 0/1 point array of the VTU. A mid-edge node is in it when both ends are. A load
// spreads over the surface triangles whose corners are all in the set.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/scene/mesh/tet_mesh.h"
#include "simulation/tissue/fem/material.h"

namespace arthro::simulation {

struct CaseFixed {
  std::string set;
  std::uint8_t axes = 7;  // bits 1, 2, 4: x, y, z
};
struct CaseDisplaced {
  std::string set;
  glm::dvec3 displacement{0.0};  // m
};
struct CaseLoad {
  std::string set;
  glm::dvec3 total_force{0.0};  // N
};

struct TissueCase {
  std::filesystem::path mesh_file;
  TetMesh mesh;
  std::vector<std::string> messages;  // changes made while the mesh was read
  Material material;
  std::vector<CaseFixed> fixed;
  std::vector<CaseDisplaced> displaced;
  std::vector<CaseLoad> loads;
  glm::dvec3 body_force{0.0};  // N/m³
  bool is_dynamic = false;
  double dt = 1.0 / 60;  // s
  int steps = 60;
  double tolerance = 1e-8;  // relative residual of every equilibrium or step
};

// Reads the case and its mesh, whose name is relative to the case's folder. Throws Error with one
// sentence for each fault in the file, naming its key.
TissueCase ReadCase(const std::filesystem::path& file);

struct SetResult {
  glm::dvec3 mean_displacement{0.0};  // m, plain mean over the nodes
  glm::dvec3 reaction{0.0};           // N, sum of the forces that hold its fixed axes
};
using SetResults = std::map<std::string, SetResult>;

struct CaseMoment {
  double t = 0;        // s
  double wall_ms = 0;  // for this step
  SetResults sets;
};

struct CaseResult {
  bool converged = false;     // to the tolerance, without inverted elements
  double residual = 0;        // relative; dynamic: the largest of all steps
  int iterations = 0;         // Newton iterations
  int linear_iterations = 0;  // conjugate-gradient iterations
  double wall_ms = 0;         // includes factoring, excludes reading and writing
  SetResults sets;
  double energy = 0;                // J, elastic
  int inverted_elements = 0;        // dynamic: the largest of all steps
  bool used_fallback = false;       // elements were inverted during the solve
  std::vector<CaseMoment> history;  // dynamic: one per step
  std::vector<glm::dvec3> x;        // m, final node positions; not in the file
};

// Returns the text of result.json.
std::string JsonFromResult(const CaseResult& result);

}  // namespace arthro::simulation
