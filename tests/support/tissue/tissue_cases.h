// Tissue problems with known continuum answers: material, support, load, watched value, and the
// limit of that value on ever finer quadratic hexahedra [benchmarks.md, Tissue references]. SI.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/tissue/fem/fem_model.h"
#include "simulation/tissue/solver/implicit_solver.h"
#include "tests/support/tissue/tissue_meshes.h"

namespace arthro::test {

enum class TissueBody { kBeam, kCook, kBlock, kMeniscus };

// ± is the larger of the extrapolation's gap and a quarter of the last refinement's change.
struct ContinuumValue {
  double value, tolerance;
};

struct TissueCase {
  const char* name;
  TissueBody body;
  double young_modulus, poisson_ratio;  // Pa
  double fibre_stiffness;               // Pa, circumferential; 0: none
  const char* held;                     // set that does not move at all
  const char* resting;                  // set that does not move along z; null: none
  const char* loaded;                   // set with the load or the displacement; null: none
  glm::dvec3 load;                      // N on `loaded`
  glm::dvec3 displacement;              // m of `loaded`, when not zero
  glm::dvec3 body_force;                // N/m³
  const char* watched;                  // mean displacement of this set, or force that holds it
  bool watches_force;
  int axis;
  ContinuumValue stable_neo_hookean, corotated;
};
std::span<const TissueCase> TissueCases();
const TissueCase& TissueCaseOf(const std::string& name);  // throws Error(kBadArgument)

const ContinuumValue& ContinuumOf(const TissueCase& c, simulation::Law law);

// A case on a mesh of its body.
struct TissueProblem {
  std::shared_ptr<const simulation::FemModel> model;
  simulation::FixedAxes fixed;
  std::vector<glm::dvec3> load;    // N per node
  std::vector<glm::dvec3> target;  // m per node: displacement of fixed axes; empty: none
  std::vector<int> watched;        // nodes
  bool watches_force = false;
  int axis = 2;
};
// Throws Error(kBadArgument) when a set of the case has no node on this mesh.
TissueProblem ProblemOf(const TissueCase& c, simulation::Law law, const TetMesh& mesh);

// Watched value of the case, for nodes at x that are held by `reaction` (N per node).
double Watch(const TissueProblem& problem, std::span<const glm::dvec3> x,
             std::span<const glm::dvec3> reaction);

// `share` of the case's displacement; its load is the caller's to scale.
std::vector<glm::dvec3> TargetAt(const TissueProblem& problem, double share);

}  // namespace arthro::test
