// Reference cases solved by plain Newton with Eigen's direct solver, so that the comparison tests
// only elements and laws.
#include <cmath>
#include <fstream>
#include <ostream>
#include <string>
#include <vector>

#include <Eigen/SparseCholesky>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "simulation/scene/mesh/mesh_io.h"
#include "simulation/tissue/fem/fem_model.h"
#include "tests/support/shared_data.h"

namespace arthro::simulation {
namespace {

using nlohmann::json;

struct Solution {
  std::vector<glm::dvec3> x, force;  // elastic forces
  double energy = 0, residual = 0;
  int newton = 0;
};

glm::dvec3 VectorFrom(const json& j) { return {j.at(0), j.at(1), j.at(2)}; }

class Newton {
 public:
  Newton(const TetMesh& mesh, const json& the_case, const Material& material)
      : model_(mesh, material), load_(mesh.rest_positions.size(), glm::dvec3(0.0)) {
    const std::size_t n = mesh.rest_positions.size();
    fixed_.assign(n, false);
    target_ = mesh.rest_positions;
    for (const json& f : the_case.at("fixed"))
      for (std::size_t i = 0; i < n; ++i)
        if (mesh.sets.at(f.at("set"))[i]) {
          EXPECT_EQ(f.at("axes"), "xyz");
          fixed_[i] = true;
        }
    for (const json& d : the_case.value("displaced", json::array()))
      for (std::size_t i = 0; i < n; ++i)
        if (mesh.sets.at(d.at("set"))[i]) {
          fixed_[i] = true;
          target_[i] += VectorFrom(d.at("displacement"));
        }
    for (const json& l : the_case.value("loads", json::array()))
      AddSurfaceLoad(mesh, mesh.sets.at(l.at("set")), VectorFrom(l.at("total_force")), load_);
    if (the_case.contains("body_force"))
      model_.AddBodyForce(VectorFrom(the_case.at("body_force")), load_);
    matrix_.pattern = model_.pattern();
    matrix_.block.resize(matrix_.pattern->column.size());
  }

  // Applies the load in `steps` parts, each solved to a relative residual of 1e-11.
  Solution Solve(int steps) {
    Solution s;
    s.x = model_.mesh().rest_positions;
    s.force.resize(s.x.size());
    for (int step = 1; step <= steps; ++step) {
      const double part = static_cast<double>(step) / steps;
      for (std::size_t i = 0; i < s.x.size(); ++i)
        if (fixed_[i])
          s.x[i] = model_.mesh().rest_positions[i] +
                   part * (target_[i] - model_.mesh().rest_positions[i]);
      for (int iteration = 0; iteration < 60; ++iteration, ++s.newton) {
        s.energy =
            model_
                .Assemble(s.x, model_.material().law,
                          iteration < 1 ? Tangent::kProjected : Tangent::kTrue, s.force, &matrix_)
                .energy;
        double residual = 0, scale = 0;
        for (std::size_t i = 0; i < s.x.size(); ++i)
          for (int k = 0; k < 3; ++k) {
            scale = std::max(scale, std::abs(s.force[i][k]));
            if (!fixed_[i])
              residual = std::max(residual, std::abs(s.force[i][k] + part * load_[i][k]));
          }
        s.residual = residual / scale;
        if (s.residual < 1e-11) break;
        Move(part, s);
      }
    }
    return s;
  }

 private:
  void Move(double part, Solution& s) {
    std::vector<int> index(s.x.size(), -1);
    int free = 0;
    for (std::size_t i = 0; i < s.x.size(); ++i)
      if (!fixed_[i]) index[i] = 3 * free++;
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right(3 * free);
    const BlockPattern& p = *matrix_.pattern;
    for (int row = 0; row < p.node_count(); ++row) {
      if (index[row] < 0) continue;
      for (int k = 0; k < 3; ++k) right[index[row] + k] = s.force[row][k] + part * load_[row][k];
      for (int e = p.row_begin[row]; e < p.row_begin[row + 1]; ++e)
        if (const int column = index[p.column[e]]; column >= 0)
          for (int k = 0; k < 9; ++k)
            entries.emplace_back(index[row] + k / 3, column + k % 3, matrix_.block[e][k]);
    }
    Eigen::SparseMatrix<double> a(3 * free, 3 * free);
    a.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(a);
    ASSERT_EQ(factor.info(), Eigen::Success);
    const Eigen::VectorXd move = factor.solve(right);
    // Halves the step until no element is inverted.
    const std::vector<glm::dvec3> before = s.x;
    double step = 1;
    for (int tries = 0; tries < 20; ++tries, step *= 0.5) {
      for (std::size_t i = 0; i < s.x.size(); ++i)
        if (index[i] >= 0)
          for (int k = 0; k < 3; ++k) s.x[i][k] = before[i][k] + step * move[index[i] + k];
      std::vector<glm::dvec3> force(s.x.size());
      if (model_.Assemble(s.x, model_.material().law, Tangent::kNone, force, nullptr).inverted == 0)
        break;
    }
  }

  FemModel model_;
  std::vector<glm::dvec3> load_, target_;
  std::vector<bool> fixed_;
  BlockMatrix matrix_;
};

struct Reference {
  const char* name;
  int load_steps;
};
void PrintTo(const Reference& r, std::ostream* out) { *out << r.name; }

class ReferenceCase : public testing::TestWithParam<Reference> {};

// 1e-6 is the accuracy of the reference values, which have 8 digits.
TEST_P(ReferenceCase, MatchesTheReferenceToOneInAMillion) {
  ARTHRO_REQUIRE_SHARED(folder, "reference/tissue");
  const std::string name = GetParam().name;
  const json the_case = json::parse(std::ifstream(folder / (name + ".json")));
  const json expected = json::parse(std::ifstream(folder / "expected.json"));
  const TetMesh mesh = ReadTetMesh(folder / the_case.at("mesh").get<std::string>());
  Material material;
  const json& m = the_case.at("material");
  material.law = m.at("model") == "corotated" ? Law::kCorotated : Law::kStableNeoHookean;
  material.young_modulus = m.at("young_modulus");
  material.poisson_ratio = m.at("poisson_ratio");
  material.density = m.at("density");
  material.fibre_stiffness = m.value("fibre_stiffness", 0.0);
  if (m.contains("fibre_axis")) material.fibre_axis = FibreAxis::kCircumferentialZ;
  const Solution s = Newton(mesh, the_case, material).Solve(GetParam().load_steps);
  EXPECT_LT(s.residual, 1e-11) << s.newton << " iterations";
  int compared = 0;
  for (const json& q : expected.at(name + ".json")) {
    if (!q.contains("discrete")) continue;
    const double discrete = q.at("discrete");
    double ours = s.energy;
    if (q.at("what") != "energy") {
      const auto& set = mesh.sets.at(q.at("set"));
      const int axis = q.at("axis");
      double sum = 0, count = 0;
      for (std::size_t i = 0; i < set.size(); ++i)
        if (set[i]) {
          // The reaction is minus the force of the elements.
          sum += q.at("what") == "reaction" ? -s.force[i][axis]
                                            : s.x[i][axis] - mesh.rest_positions[i][axis];
          count += 1;
        }
      ours = q.at("what") == "reaction" ? sum : sum / count;
    }
    std::printf("%s %s %s: %.9g, reference %.9g, off by %.1e\n", name.c_str(),
                q.at("what").get<std::string>().c_str(), q.at("axis").dump().c_str(), ours,
                discrete, ours / discrete - 1);
    EXPECT_NEAR(ours / discrete, 1, 1e-6);
    ++compared;
  }
  EXPECT_GT(compared, 0);
}

INSTANTIATE_TEST_SUITE_P(
    , ReferenceCase,
    testing::Values(Reference{"beam_tip_T4_S_snh", 2}, Reference{"beam_tip_T4_S_cor", 2},
                    Reference{"beam_gravity_T10_S_snh", 4}, Reference{"meniscus_load_T10_S_snh", 1},
                    Reference{"meniscus_fibre_T4_S_cor", 1},
                    Reference{"meniscus_fibre_T10_S_snh", 1}, Reference{"block49_T4_S_snh", 2},
                    Reference{"block49_T10_S_snh", 6}),
    [](const auto& which) { return std::string(which.param.name); });

}  // namespace
}  // namespace arthro::simulation
