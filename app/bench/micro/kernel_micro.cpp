// One assembly and one product with the matrix, per instruction set, for the crescent as 576 T10
// and as 20,736 T4. Asked of one core: 576 T10 (energy, force, true tangent) under 1 ms, 20,736 T4
// under 4 ms.
#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "app/bench/micro/micro_bench.h"
#include "simulation/core/random.h"
#include "simulation/tissue/fem/element_kernel.h"
#include "simulation/tissue/fem/fem_model.h"
#include "tests/support/tissue/tissue_meshes.h"

namespace arthro::app {
namespace {

using namespace simulation;

struct KernelCase {
  const char* name;
  Law law;
  bool has_fibres;
  Tangent tangent;
};

constexpr KernelCase kCases[] = {
    {"neo-Hookean, fibres, forces only", Law::kStableNeoHookean, true, Tangent::kNone},
    {"neo-Hookean, true", Law::kStableNeoHookean, false, Tangent::kTrue},
    {"neo-Hookean, fibres, true", Law::kStableNeoHookean, true, Tangent::kTrue},
    {"neo-Hookean, fibres, projected", Law::kStableNeoHookean, true, Tangent::kProjected},
    {"corotated, true", Law::kCorotated, false, Tangent::kTrue},
    {"corotated, fibres, projected", Law::kCorotated, true, Tangent::kProjected}};

// A body in a random shape near its rest shape, with what one instruction set computes of it.
struct KernelWork {
  std::shared_ptr<const FemModel> model;
  const KernelCase* c = nullptr;
  const ElementKernel* kernel = nullptr;
  std::vector<glm::dvec3> x, force, product;
  std::vector<glm::dmat3> rotation;
  BlockMatrix matrix;

  void Assemble() { KeepAlive(model->Assemble(x, c->law, c->tangent, force, &matrix, kernel)); }
};

KernelWork MakeWork(int order, const test::Cells& cells, const KernelCase& c,
                    const ElementKernel* kernel) {
  const TetMesh mesh = test::MeniscusMesh(order, test::MeniscusTicks(cells));
  Material material;
  material.law = c.law;
  if (c.has_fibres) {
    material.fibre_stiffness = 2e7;
    material.fibre_axis = FibreAxis::kCircumferentialZ;
  }
  KernelWork work{
      std::make_shared<FemModel>(mesh, material), &c, kernel, mesh.rest_positions, {}, {}, {}, {}};
  Random random(1);
  for (glm::dvec3& at : work.x)
    at += glm::dvec3(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1)) * 5e-5;
  work.force.resize(work.x.size());
  work.product.resize(work.x.size());
  work.rotation.resize(work.x.size());
  work.matrix.pattern = work.model->pattern();
  work.matrix.block.resize(work.model->pattern()->column.size());
  return work;
}

double LargestDifference(const BlockMatrix& a, const BlockMatrix& b) {
  double off = 0, size = 0;
  for (std::size_t i = 0; i < a.block.size(); ++i)
    for (int k = 0; k < 9; ++k) {
      off = std::max(off, std::abs(a.block[i][k] - b.block[i][k]));
      size = std::max(size, std::abs(b.block[i][k]));
    }
  return off / size;
}

void AddMesh(std::vector<MicroFunction>& functions, int order, const test::Cells& cells) {
  const std::string mesh =
      fmt::format("{} {}", 6 * cells[0] * cells[1] * cells[2], order == 2 ? "T10" : "T4");
  for (const KernelCase& c : kCases)
    for (const InstructionSet set : {InstructionSet::kScalar, InstructionSet::kSse2,
                                     InstructionSet::kAvx2, InstructionSet::kAvx512}) {
      const ElementKernel* kernel = KernelOf(set);
      if (kernel == nullptr) continue;
      const auto work = MadeOnce([=, &c] { return MakeWork(order, cells, c, kernel); });
      const auto name = [&](const char* what) {
        return fmt::format("{} {}, {}", mesh, what, kernel->name);
      };
      functions.push_back(
          {name(c.name), [=] { work().Assemble(); },
           [=, &c] {
             if (c.tangent == Tangent::kNone) return MicroError{};
             KernelWork scalar = MakeWork(order, cells, c, KernelOf(InstructionSet::kScalar));
             scalar.Assemble();
             work().Assemble();
             return MicroError{.text =
                                   fmt::format("off scalar {:.0e}",
                                               LargestDifference(work().matrix, scalar.matrix))};
           }});
      if (c.has_fibres || c.tangent != Tangent::kTrue || c.law == Law::kCorotated) continue;
      functions.push_back({name("matrix times vector"),
                           [=] {
                             KernelWork& w = work();
                             Multiply(w.matrix, w.x, w.product, w.kernel);
                             KeepAlive(w.product[0]);
                           },
                           {}});
      functions.push_back({name("node rotations"),
                           [=] {
                             KernelWork& w = work();
                             w.model->NodeRotations(w.x, w.rotation, w.kernel);
                             KeepAlive(w.rotation[0]);
                           },
                           {}});
    }
}

}  // namespace

MicroGroup KernelMicro(bool quick) {
  MicroGroup group{"kernel", "", "scalar kernel, to whose bits all others agree", {}};
  AddMesh(group.functions, 2, {24, 4, 1});
  AddMesh(group.functions, 1, quick ? test::Cells{24, 4, 2} : test::Cells{72, 12, 4});
  return group;
}

}  // namespace arthro::app
