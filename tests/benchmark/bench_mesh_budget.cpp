// Cost and stiffness error of a tissue's mesh, by its size: the digital knee's meniscus
// (resources/demo) under a probe's 0.2 N, spread over 1 mm of its surface, at three places of the
// free edge, held as in the scene with nothing under it. The reference is the same surface with
// some ten times as many elements as the finest mesh. Load and displacement refer to the same fine
// surface for all meshes, so that only the elements differ. With `probed`, the mesher knows the
// places. Errors are over five meshes within a tenth of the size: the mean per place, and the
// median and the range of the worst place.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <span>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "authoring/tissue/tetrahedra/mesh_budget.h"
#include "simulation/core/process_cost.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/mesh/held_nodes.h"
#include "simulation/tissue/body/body_options.h"
#include "simulation/tissue/body/tissue_preset.h"
#include "simulation/tissue/contact/embedded_skin.h"
#include "simulation/tissue/solver/implicit_solver.h"
#include "tests/benchmark/bench_report.h"
#include "tests/support/build_paths.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

constexpr double kForce = 0.2, kSpread = 1e-3;  // N, m
constexpr int kReferenceElements = 6500;
// Meshes per budget, so that the luck of one mesh does not say what a size is worth. --quick makes
// one.
constexpr std::array<double, 5> kSizes = {0.9, 0.95, 1.0, 1.05, 1.1};
constexpr std::array<double, 1> kQuickSizes = {1.0};

struct Place {
  const char* name;
  glm::dvec3 x_in_portal;  // landmarks of resources/demo/truth.json
};
constexpr std::array<Place, 3> kPlaces = {{{"body", {0.013897, 0.006804, 0.028469}},
                                           {"posterior", {0.006269, 0.005698, 0.034702}},
                                           {"anterior", {0.0098, 0.0085, 0.0195}}}};

// Part of the surface under a load: share of the load per place, and its direction.
struct Patch {
  glm::dvec3 centre{0.0}, direction{0.0};
  std::vector<std::size_t> vertex;
};

Patch PatchAt(const SurfaceMesh& surface, const glm::dvec3& near) {
  Patch patch;
  double best = INFINITY;
  for (const glm::dvec3& x : surface.vertices)
    if (const double d = glm::distance(x, near); d < best) best = d, patch.centre = x;
  patch.direction = {0, 0, -1};  // down onto the plateau, in the tissue's own frame
  for (std::size_t i = 0; i < surface.vertices.size(); ++i)
    if (glm::distance(surface.vertices[i], patch.centre) < kSpread) patch.vertex.push_back(i);
  return patch;
}

struct Body {
  Body(const SurfaceMesh& surface, const TetMesh& tets, const Tissue& tissue,
       const simulation::Material& material)
      : mesh(tets),
        skin(simulation::EmbedSkin(surface, mesh, simulation::ElementFinder(mesh))),
        model(std::make_shared<simulation::FemModel>(mesh, material)) {
    for (const std::uint8_t held : HeldNodes(mesh.rest_positions, tissue.fixed))
      fixed.push_back(held != 0 ? 7 : 0);
  }

  std::vector<glm::dvec3> LoadOf(const Patch& patch) const {
    std::vector<glm::dvec3> load(mesh.rest_positions.size(), glm::dvec3(0.0));
    for (const std::size_t vertex : patch.vertex)
      for (int k = 0; k < 10; ++k)
        load[NodeOf(vertex, k)] += skin.point[vertex].weight[k] * kForce /
                                   static_cast<double>(patch.vertex.size()) * patch.direction;
    return load;
  }

  // How far the patch goes along the force, m.
  double Gives(const Patch& patch) const {
    simulation::SolverOptions options;
    options.tolerance = 1e-8, options.max_newton = 60, options.max_iterations = 5000;
    simulation::ImplicitSolver solver(model, fixed, options);
    simulation::BodyState state = Rest();
    solver.SolveStatic(state, LoadOf(patch), {}, {}, 1e-7, {});
    double sum = 0;
    for (const std::size_t vertex : patch.vertex)
      for (int k = 0; k < 10; ++k) {
        const std::size_t node = NodeOf(vertex, k);
        sum += skin.point[vertex].weight[k] *
               glm::dot(state.x[node] - mesh.rest_positions[node], patch.direction);
      }
    return sum / static_cast<double>(patch.vertex.size());
  }

  // In the thread's own time: what else runs on the machine is not the tissue's. A factor that grew
  // old is made anew beside it, untimed, as a living tissue has it made on another thread.
  test::Timing Step(const Patch& patch, bool quick) const {
    constexpr int kWarmUp = 12, kPause = 10;
    const simulation::BodyOptions options;
    simulation::ImplicitSolver solver(model, fixed, options.solver);
    simulation::BodyState state = Rest();
    const std::vector<glm::dvec3> full = LoadOf(patch);
    std::vector<glm::dvec3> load(full.size());
    std::vector<double> seconds;
    int since_refresh = 0;
    for (int frame = 0; frame < kWarmUp + (quick ? 3 : 240); ++frame) {
      // Always on the move, 1.5 times per second: a body at rest would cost nothing.
      const double share = 0.75 + 0.25 * std::cos(2 * std::numbers::pi * 1.5 * frame / 60);
      for (std::size_t i = 0; i < load.size(); ++i) load[i] = share * full[i];
      const double start = ThreadCpuMs();
      const simulation::StepReport report = solver.Step(state, load, {}, {}, 1.0 / 60, {});
      if (frame >= kWarmUp) seconds.push_back(1e-3 * (ThreadCpuMs() - start));
      if (++since_refresh < kPause ||
          report.iterations <= options.refresh_iterations * std::max(1, report.newton))
        continue;
      solver.BeginRefresh();
      solver.RunRefresh();
      solver.TakeRefreshed();
      since_refresh = 0;
    }
    std::sort(seconds.begin(), seconds.end());
    return {seconds[seconds.size() / 2], seconds[(seconds.size() * 99 + 99) / 100 - 1]};
  }

  simulation::BodyState Rest() const {
    return {mesh.rest_positions,
            std::vector<glm::dvec3>(mesh.rest_positions.size(), glm::dvec3(0.0))};
  }
  std::size_t NodeOf(std::size_t vertex, int k) const {
    return static_cast<std::size_t>(
        mesh.elements[static_cast<std::size_t>(skin.point[vertex].element * 10 + k)]);
  }

  TetMesh mesh;
  simulation::EmbeddedSkin skin;
  std::shared_ptr<simulation::FemModel> model;
  simulation::FixedAxes fixed;
};

void Run(test::BenchReport& bench) {
  const LoadedScene loaded = LoadScene(fs::path(ARTHRO_SOURCE_DIR) / "resources/demo");
  const Tissue& tissue = loaded.scene.tissues.at(0);
  const SurfaceMesh& surface = *loaded.surfaces.at(0);
  const simulation::Material material =
      simulation::FindTissuePreset(fs::path(ARTHRO_SOURCE_DIR) / "resources/presets/tissues",
                                   tissue.material)
          .material;
  std::vector<Patch> patches;
  for (const Place& place : kPlaces)
    patches.push_back(PatchAt(surface, glm::conjugate(tissue.pose.quaternion) *
                                           (place.x_in_portal - tissue.pose.position)));
  const auto fill = [&](int elements, bool is_probed) {
    authoring::MeshWish wish;
    wish.elements = elements;
    wish.fixed = tissue.fixed;
    if (is_probed)
      for (const Patch& patch : patches) wish.probed.push_back({patch.centre, 1.5e-3});
    authoring::SurfaceSource source;
    source.file = "resources/demo/meniscus.ply";
    source.unit = "m";
    return authoring::TetrahedralizeToBudget(surface, source, wish, nullptr, {}, ARTHRO_PROGRAM);
  };
  const Body reference(surface, fill(bench.quick() ? 600 : kReferenceElements, true), tissue,
                       material);
  std::vector<double> truth;
  for (const Patch& patch : patches) truth.push_back(reference.Gives(patch));
  std::printf("reference: %d elements, %.3f %.3f %.3f mm\n", reference.mesh.ElementCount(),
              1e3 * truth[0], 1e3 * truth[1], 1e3 * truth[2]);
  const std::span<const double> sizes =
      bench.quick() ? std::span<const double>(kQuickSizes) : kSizes;
  for (const authoring::MeshBudget& budget : authoring::MeshBudgets())
    for (const bool is_probed : {false, true}) {
      std::array<double, kPlaces.size()> mean{};
      std::vector<double> worst;
      test::Timing step;
      for (const double size : sizes) {
        const Body body(surface,
                        fill(static_cast<int>(std::lround(size * budget.elements)), is_probed),
                        tissue, material);
        worst.push_back(0);
        for (std::size_t i = 0; i < patches.size(); ++i) {
          const double off = body.Gives(patches[i]) / truth[i] - 1;
          mean[i] += off / static_cast<double>(sizes.size());
          if (std::abs(off) > std::abs(worst.back())) worst.back() = off;
        }
        if (size == 1.0) step = body.Step(patches[0], bench.quick());
      }
      std::ranges::sort(worst);
      std::string error;
      for (std::size_t i = 0; i < patches.size(); ++i)
        error += fmt::format("{} {:+.0f} % ", kPlaces[i].name, 100 * mean[i]);
      bench.Row(fmt::format("{}{}, {} elements", budget.name, is_probed ? ", probed" : "",
                            budget.elements),
                step,
                error + fmt::format("(worst {:+.0f} %, {:+.0f} to {:+.0f})",
                                    100 * worst[worst.size() / 2], 100 * worst.back(),
                                    100 * worst.front()));
    }
}

}  // namespace
}  // namespace arthro

int main(int argc, char** argv) {
  arthro::test::BenchReport bench("size of a tissue's mesh", argc, argv);
  arthro::Run(bench);
}
