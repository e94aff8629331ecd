// What one assembly and one product with the matrix cost, an instruction set at a time, with the
// largest difference to the scalar path beside it (all give the same bits), for the crescent as 576
// T10 and as 20,736 T4. Asked: 576 T10 (energy, force, true tangent) under 1 ms, 20,736 T4 under
// 4 ms on one core.
#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "app/bench/tissue/tissue_meshes.h"
#include "simulation/core/random.h"
#include "simulation/tissue/fem/element_kernel.h"
#include "simulation/tissue/fem/fem_model.h"
#include "tests/benchmark/bench_report.h"

namespace arthro::simulation {
namespace {

using test::BenchReport;
using test::KeepAlive;

struct Sums {
  Assembly assembly;
  std::vector<glm::dvec3> force, product;
  std::vector<glm::dmat3> rotation;
  BlockMatrix matrix;
};

double LargestDifference(const Sums& a, const Sums& b) {
  double off = 0, size = 0;
  for (std::size_t i = 0; i < a.matrix.block.size(); ++i)
    for (int k = 0; k < 9; ++k) {
      off = std::max(off, std::abs(a.matrix.block[i][k] - b.matrix.block[i][k]));
      size = std::max(size, std::abs(b.matrix.block[i][k]));
    }
  return off / size;
}

struct Case {
  const char* name;
  Law law;
  bool has_fibres;
  Tangent tangent;
};

void MeasureMesh(BenchReport& report, int order, const app::Cells& cells) {
  const TetMesh mesh = app::MeniscusMesh(order, app::MeniscusTicks(cells));
  Random random(1);
  std::vector<glm::dvec3> x = mesh.rest_positions;
  for (glm::dvec3& at : x)
    at += glm::dvec3(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1)) * 5e-5;
  for (const Case& c :
       {Case{"neo-Hookean, fibres, forces only", Law::kStableNeoHookean, true, Tangent::kNone},
        Case{"neo-Hookean, true", Law::kStableNeoHookean, false, Tangent::kTrue},
        Case{"neo-Hookean, fibres, true", Law::kStableNeoHookean, true, Tangent::kTrue},
        Case{"neo-Hookean, fibres, projected", Law::kStableNeoHookean, true, Tangent::kProjected},
        Case{"corotated, true", Law::kCorotated, false, Tangent::kTrue},
        Case{"corotated, fibres, projected", Law::kCorotated, true, Tangent::kProjected}}) {
    Material material;
    material.law = c.law;
    if (c.has_fibres) {
      material.fibre_stiffness = 2e7;
      material.fibre_axis = FibreAxis::kCircumferentialZ;
    }
    const FemModel model(mesh, material);
    Sums scalar;
    for (const InstructionSet set : {InstructionSet::kScalar, InstructionSet::kSse2,
                                     InstructionSet::kAvx2, InstructionSet::kAvx512}) {
      const ElementKernel* kernel = KernelOf(set);
      if (kernel == nullptr) continue;
      Sums sums;
      sums.force.resize(x.size());
      sums.product.resize(x.size());
      sums.rotation.resize(x.size());
      sums.matrix.pattern = model.pattern();
      sums.matrix.block.resize(model.pattern()->column.size());
      const auto assemble = [&] {
        sums.assembly = model.Assemble(x, c.law, c.tangent, sums.force, &sums.matrix, kernel);
        KeepAlive(sums.assembly);
      };
      const auto row = [&](const char* what, auto&& work) {
        const test::Timing time =
            test::TimeCalls(report.quick() ? 0 : 3, report.quick() ? 1 : 40, 1, work);
        if (set == InstructionSet::kScalar && c.tangent != Tangent::kNone) scalar = sums;
        report.Row(
            fmt::format("{} {}, {}, {}", mesh.ElementCount(), order == 2 ? "T10" : "T4", what,
                        kernel->name),
            time,
            fmt::format("{:.0f} ns/element; off scalar {:.0e}",
                        1e9 * time.median / mesh.ElementCount(),
                        c.tangent == Tangent::kNone ? 0.0 : LargestDifference(sums, scalar)));
      };
      row(c.name, assemble);
      if (c.has_fibres || c.tangent != Tangent::kTrue || c.law == Law::kCorotated) continue;
      row("matrix times vector",
          [&] { Multiply(sums.matrix, x, sums.product, kernel), KeepAlive(sums.product[0]); });
      row("node rotations",
          [&] { model.NodeRotations(x, sums.rotation, kernel), KeepAlive(sums.rotation[0]); });
    }
  }
}

}  // namespace
}  // namespace arthro::simulation

int main(int argc, char** argv) {
  arthro::test::BenchReport report("tissue kernels", argc, argv);
  arthro::simulation::MeasureMesh(report, 2, {24, 4, 1});
  arthro::simulation::MeasureMesh(
      report, 1, report.quick() ? arthro::app::Cells{24, 4, 2} : arthro::app::Cells{72, 12, 4});
}
