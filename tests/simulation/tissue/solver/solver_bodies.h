// Meniscus for the solver tests: horns fixed, 1 MPa, nu 0.45.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "simulation/tissue/solver/implicit_solver.h"
#include "tests/support/tissue/tissue_meshes.h"

namespace arthro::test {

struct SolverBody {
  TetMesh mesh;
  std::shared_ptr<const simulation::FemModel> model;
  simulation::FixedAxes fixed;
  std::vector<glm::dvec3> load;

  simulation::BodyState Rest() const {
    return {mesh.rest_positions, std::vector<glm::dvec3>(mesh.rest_positions.size())};
  }
  // m, of the bounding box
  double Diagonal() const {
    glm::dvec3 low = mesh.rest_positions[0], high = low;
    for (const glm::dvec3& x : mesh.rest_positions) {
      low = glm::min(low, x);
      high = glm::max(high, x);
    }
    return glm::distance(low, high);
  }
  double MeanZ(const char* set, const std::vector<glm::dvec3>& x) const {
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (mesh.sets.at(set)[i]) {
        sum += x[i].z - mesh.rest_positions[i].z;
        ++count;
      }
    return sum / count;
  }
};

inline SolverBody MakeBody(TetMesh mesh, const char* held, const simulation::Material& material) {
  SolverBody body;
  body.mesh = std::move(mesh);
  body.model = std::make_shared<const simulation::FemModel>(body.mesh, material);
  body.fixed.assign(body.mesh.rest_positions.size(), 0);
  if (*held)
    for (std::size_t i = 0; i < body.fixed.size(); ++i)
      if (body.mesh.sets.at(held)[i]) body.fixed[i] = 7;
  body.load.assign(body.fixed.size(), glm::dvec3(0.0));
  return body;
}

inline simulation::Material MeniscusMaterial(double nu = 0.45) {
  simulation::Material material;
  material.young_modulus = 1e6;
  material.poisson_ratio = nu;
  return material;
}

inline SolverBody Meniscus(int order, const Cells& cells, double force_z = 0,
                           const simulation::Material& material = MeniscusMaterial()) {
  SolverBody body = MakeBody(MeniscusMesh(order, MeniscusTicks(cells)), "horns", material);
  if (force_z != 0)
    simulation::AddSurfaceLoad(body.mesh, body.mesh.sets.at("patch"), {0, 0, force_z}, body.load);
  return body;
}

inline double LargestDistance(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double distance = glm::distance(a[i], b[i]);
    if (!(distance <= most)) most = distance;  // NaN stays
  }
  return most;
}

// Spring of stiffness `k` at the centre of the element nearest to `place`, which pushes along
// `normal` with the initial depth `depth`.
inline simulation::ContactPoint PressAt(const SolverBody& body, const std::vector<glm::dvec3>& x,
                                        const glm::dvec3& place, const glm::dvec3& normal, double k,
                                        double depth) {
  const int n = body.mesh.NodesPerElement();
  simulation::ContactPoint contact;
  double nearest = 1e300;
  for (int e = 0; e < body.mesh.ElementCount(); ++e) {
    glm::dvec3 centre(0.0);
    for (int a = 0; a < 4; ++a)
      centre += 0.25 * body.mesh.rest_positions[body.mesh.elements[n * e + a]];
    if (glm::distance(centre, place) >= nearest) continue;
    nearest = glm::distance(centre, place);
    contact.count = 4;
    for (int a = 0; a < 4; ++a) {
      contact.node[a] = body.mesh.elements[n * e + a];
      contact.weight[a] = 0.25;
    }
  }
  glm::dvec3 point(0.0);
  for (int a = 0; a < 4; ++a) point += contact.weight[a] * x[contact.node[a]];
  contact.normal = normal;
  contact.foot = point + depth * normal;
  contact.start = point;
  contact.stiffness = k;
  contact.owner = 0;
  return contact;
}

}  // namespace arthro::test
