#include "tests/support/tissue/tissue_cases.h"

#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "simulation/core/error.h"

namespace arthro::test {
namespace {

using simulation::Law;

// Values for the stable neo-Hookean and the corotated law [benchmarks.md, Tissue references]. The
// displacement of the meniscus is that of its inner edge: a point, so the same on every mesh.
constexpr TissueCase kCases[] = {
    {"meniscus_load",
     TissueBody::kMeniscus,
     1e6,
     0.45,
     0,
     "horns",
     nullptr,
     "patch",
     {0, 0, -0.05},
     {},
     {},
     "inner",
     false,
     2,
     {-0.725265e-3, 3e-6},
     {-0.724408e-3, 3e-6}},
    {"meniscus_fibre",
     TissueBody::kMeniscus,
     1e6,
     0.45,
     20e6,
     "horns",
     nullptr,
     "patch",
     {0, 0, -0.2},
     {},
     {},
     "inner",
     false,
     2,
     {-0.481731e-3, 3.7e-7},
     {-0.480995e-3, 4.2e-6}},
    {"meniscus_push",
     TissueBody::kMeniscus,
     1e6,
     0.45,
     0,
     "horns",
     nullptr,
     "patch",
     {},
     {0, 0, -1e-3},
     {},
     "patch",
     true,
     2,
     {-0.0685123, 0.0015},
     {-0.0685201, 0.0015}},
    {"meniscus_indent",
     TissueBody::kMeniscus,
     1e6,
     0.45,
     0,
     "horns",
     "underside",
     "patch",
     {},
     {0, 0, -1e-3},
     {},
     "patch",
     true,
     2,
     {-7.66352, 0.7},
     {-6.16196, 0.86}},
    {"beam_gravity",
     TissueBody::kBeam,
     2e5,
     0.3,
     0,
     "clamp",
     nullptr,
     nullptr,
     {},
     {},
     {0, 0, -1100 * 9.81},
     "tip",
     false,
     2,
     {-58.3737e-3, 3.1e-5},
     {-58.2538e-3, 3.2e-5}},
    {"beam_tip",
     TissueBody::kBeam,
     1e6,
     0.3,
     0,
     "clamp",
     nullptr,
     "end",
     {0, 0, -0.15},
     {},
     {},
     "tip",
     false,
     2,
     {-46.5665e-3, 2.2e-5},
     {-46.5083e-3, 2.8e-5}},
    {"cook",
     TissueBody::kCook,
     1e6,
     0.3,
     0,
     "clamp",
     nullptr,
     "end",
     {0, 2, 0},
     {},
     {},
     "tip",
     false,
     1,
     {4.46817e-3, 8.9e-6},
     {4.43893e-3, 1.5e-5}},
    {"cook49",
     TissueBody::kCook,
     1e6,
     0.49,
     0,
     "clamp",
     nullptr,
     "end",
     {0, 2, 0},
     {},
     {},
     "tip",
     false,
     1,
     {4.48985e-3, 3.6e-5},
     {4.45272e-3, 3.5e-5}},
    {"block49",
     TissueBody::kBlock,
     1e6,
     0.49,
     0,
     "bottom",
     nullptr,
     "top",
     {},
     {0, 0, -1.5e-3},
     {},
     "top",
     true,
     2,
     {-21.59, 0.62},
     {-17.0628, 0.37}},
    {"block499",
     TissueBody::kBlock,
     1e6,
     0.499,
     0,
     "bottom",
     nullptr,
     "top",
     {},
     {0, 0, -1.5e-3},
     {},
     "top",
     true,
     2,
     {-22.3553, 1.1},
     {-17.1777, 0.82}},
};

constexpr std::uint8_t kAllAxes = 7, kAlongZ = 4;

std::vector<int> NodesOf(const TissueCase& c, const TetMesh& mesh, const char* set) {
  std::vector<int> nodes;
  if (const auto found = mesh.sets.find(set); found != mesh.sets.end())
    for (std::size_t i = 0; i < found->second.size(); ++i)
      if (found->second[i] != 0) nodes.push_back(static_cast<int>(i));
  if (nodes.empty())
    throw Error(Code::kBadArgument,
                fmt::format("the mesh for the case {} has no node in its set \"{}\"; give it ticks "
                            "on that set's border",
                            c.name, set));
  return nodes;
}

}  // namespace

std::span<const TissueCase> TissueCases() { return kCases; }

const TissueCase& TissueCaseOf(const std::string& name) {
  for (const TissueCase& c : kCases)
    if (name == c.name) return c;
  std::string names;
  for (const TissueCase& c : kCases) names += fmt::format(" {}", c.name);
  throw Error(Code::kBadArgument,
              fmt::format("there is no tissue case \"{}\"; there are{}", name, names));
}

const ContinuumValue& ContinuumOf(const TissueCase& c, Law law) {
  return law == Law::kCorotated ? c.corotated : c.stable_neo_hookean;
}

TissueProblem ProblemOf(const TissueCase& c, Law law, const TetMesh& mesh) {
  simulation::Material material;
  material.law = law;
  material.young_modulus = c.young_modulus;
  material.poisson_ratio = c.poisson_ratio;
  if (c.fibre_stiffness > 0) {
    material.fibre_stiffness = c.fibre_stiffness;
    material.fibre_axis = simulation::FibreAxis::kCircumferentialZ;
  }
  TissueProblem problem;
  problem.model = std::make_shared<simulation::FemModel>(mesh, material);
  problem.fixed.assign(mesh.rest_positions.size(), 0);
  problem.load.assign(mesh.rest_positions.size(), glm::dvec3(0.0));
  for (const int node : NodesOf(c, mesh, c.held))
    problem.fixed[static_cast<std::size_t>(node)] = kAllAxes;
  if (c.resting != nullptr)
    for (const int node : NodesOf(c, mesh, c.resting))
      problem.fixed[static_cast<std::size_t>(node)] |= kAlongZ;
  if (c.loaded != nullptr && c.displacement != glm::dvec3(0.0)) {
    problem.target = mesh.rest_positions;
    for (const int node : NodesOf(c, mesh, c.loaded)) {
      problem.fixed[static_cast<std::size_t>(node)] = kAllAxes;
      problem.target[static_cast<std::size_t>(node)] += c.displacement;
    }
  } else if (c.loaded != nullptr) {
    NodesOf(c, mesh, c.loaded);
    simulation::AddSurfaceLoad(mesh, mesh.sets.at(c.loaded), c.load, problem.load);
  }
  if (c.body_force != glm::dvec3(0.0)) problem.model->AddBodyForce(c.body_force, problem.load);
  problem.watched = NodesOf(c, mesh, c.watched);
  problem.watches_force = c.watches_force;
  problem.axis = c.axis;
  return problem;
}

double Watch(const TissueProblem& problem, std::span<const glm::dvec3> x,
             std::span<const glm::dvec3> reaction) {
  const auto& rest = problem.model->mesh().rest_positions;
  double sum = 0;
  for (const int node : problem.watched) {
    const auto i = static_cast<std::size_t>(node);
    sum += problem.watches_force ? reaction[i][problem.axis]
                                 : x[i][problem.axis] - rest[i][problem.axis];
  }
  return problem.watches_force ? sum : sum / static_cast<double>(problem.watched.size());
}

std::vector<glm::dvec3> TargetAt(const TissueProblem& problem, double share) {
  std::vector<glm::dvec3> target = problem.target;
  const auto& rest = problem.model->mesh().rest_positions;
  for (std::size_t i = 0; i < target.size(); ++i)
    target[i] = rest[i] + share * (target[i] - rest[i]);
  return target;
}

}  // namespace arthro::test
