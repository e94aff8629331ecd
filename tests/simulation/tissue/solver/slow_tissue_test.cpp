// Static answers of the solver against forces that tests/reference/slow_tissue.h computes from the
// energy's formula: every law, both orders, fibres, loads, prescribed displacements and weight.
#include "tests/reference/slow_tissue.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "simulation/tissue/solver/implicit_solver.h"
#include "tests/support/tissue/tissue_cases.h"

namespace arthro::test {
namespace {

using simulation::Law;

TetMesh SmallMesh(TissueBody body, int order) {
  const bool is_quadratic = order == 2;
  switch (body) {
    case TissueBody::kBeam:
      return BeamMesh(order, is_quadratic ? Cells{6, 1, 1} : Cells{12, 2, 2});
    case TissueBody::kCook:
      return CookMesh(order, is_quadratic ? Cells{3, 3, 1} : Cells{6, 6, 1});
    case TissueBody::kBlock:
      return BlockMesh(order, is_quadratic ? Cells{2, 2, 2} : Cells{4, 4, 4});
    case TissueBody::kMeniscus:
      break;
  }
  return MeniscusMesh(order, MeniscusTicks(is_quadratic ? Cells{24, 4, 1} : Cells{24, 4, 2}));
}

double Largest(const std::vector<glm::dvec3>& vectors) {
  double largest = 0;
  for (const glm::dvec3& v : vectors)
    for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(v[k]));
  return largest;
}

class SlowTissue : public testing::TestWithParam<std::string> {};

// 1e-7 of the largest force on a node: the solver stops at 1e-10 of the load, the differences are
// good to 1e-9.
TEST_P(SlowTissue, AgreesThatTheSolversAnswerIsInBalance) {
  const TissueCase& c = TissueCaseOf(GetParam());
  for (const int order : {1, 2})
    for (const Law law : {Law::kStableNeoHookean, Law::kCorotated}) {
      const TissueProblem problem = ProblemOf(c, law, SmallMesh(c.body, order));
      simulation::SolverOptions options;
      options.tolerance = 1e-10;
      options.max_newton = 100;
      options.max_iterations = 5000;
      simulation::ImplicitSolver solver(problem.model, problem.fixed, options);
      const TetMesh& mesh = problem.model->mesh();
      simulation::BodyState state{mesh.rest_positions,
                                  std::vector<glm::dvec3>(mesh.rest_positions.size())};
      const auto report =
          solver.SolveStatic(state, problem.load, {}, problem.target, options.tolerance, {});
      ASSERT_TRUE(report.converged) << c.name;

      // The load of a case is either weight, which the slow method integrates itself, or traction.
      const auto& material = problem.model->material();
      std::vector<glm::dvec3> balance = SlowForces(mesh, material, state.x, c.body_force);
      const double scale = Largest(balance);
      if (c.body_force == glm::dvec3(0.0))
        for (std::size_t i = 0; i < balance.size(); ++i) balance[i] += problem.load[i];
      for (std::size_t i = 0; i < balance.size(); ++i) balance[i] += solver.reactions()[i];
      std::printf("%s, order %d, %s: out of balance by %.1e of %.2g N\n", c.name, order,
                  law == Law::kCorotated ? "corotated" : "neo-Hookean", Largest(balance) / scale,
                  scale);
      EXPECT_LT(Largest(balance), 1e-7 * scale) << c.name << ", order " << order;
    }
}

std::vector<std::string> CaseNames() {
  std::vector<std::string> names;
  for (const TissueCase& c : TissueCases()) names.emplace_back(c.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Cases, SlowTissue, testing::ValuesIn(CaseNames()),
                         [](const auto& which) { return which.param; });

}  // namespace
}  // namespace arthro::test
