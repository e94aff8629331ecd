#include "authoring/tissue/tetrahedra/mesh_budget.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "authoring/tissue/surface/fine_places.h"
#include "authoring/tissue/surface/time_limit.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

// Measured by tests/benchmark/bench_mesh_budget on the digital knee's meniscus (seed 1): worst of
// three places, 0.2 N of a probe over 1 mm of the free edge, against 6693 elements on the same
// surface, 1.7 to 2.8 mm. Medians of five meshes, which differ by 10 % in size; their worst places
// give way 12 to 56 % too little, and one coarse mesh 6 % too much. probed_error: with the three
// places given, 1.5 mm around each. Of 300 elements these places take so many that the rest of the
// edge is too stiff, and nothing is gained. step_ms: time of the thread with a new factor computed
// beside it, on a shared core with AVX-512.
constexpr std::array<MeshBudget, 3> kBudgets = {
    {{MeshSize::kCoarse, "coarse", 150, 0.47, 0.41, 0.6},
     {MeshSize::kDefault, "default", 300, 0.19, 0.32, 1.9},
     {MeshSize::kFine, "fine", 600, 0.21, 0.15, 3.8}}};

// Passes until the count is near the wish; elements grow slightly faster than triangles.
constexpr int kPasses = 6;
constexpr double kGrowth = 1.4;
constexpr double kNear = 0.12;
// Elements with a smaller dihedral angle are improved; ten degrees are asked for.
constexpr double kGoalDihedral = RadiansFromDegrees(12);

// Returns a weight of 1 where the tissue is held, up to kFree where it is freest.
std::function<double(const glm::dvec3&)> FreedomWeight(const SurfaceMesh& surface,
                                                       const std::vector<Ball>& fixed) {
  constexpr double kFree = 12.0;
  if (fixed.empty()) return [](const glm::dvec3&) { return 1.0; };
  const auto distance = [fixed](const glm::dvec3& x) {
    double least = INFINITY;
    for (const Ball& ball : fixed)
      least = std::min(least, std::max(0.0, glm::distance(x, ball.centre) - ball.radius));
    return least;
  };
  double farthest = 0;
  for (const glm::dvec3& x : surface.vertices) farthest = std::max(farthest, distance(x));
  if (!(farthest > 0)) return [](const glm::dvec3&) { return 1.0; };
  return [distance, farthest](const glm::dvec3& x) {
    const double t = std::min(distance(x) / farthest, 1.0);
    return 1.0 + (kFree - 1.0) * t * t * (3.0 - 2.0 * t);
  };
}

// Returns a weight of kProbed in a probed place, decreasing to 1 at kReach radii.
std::function<double(const glm::dvec3&)> ProbingWeight(const std::vector<Ball>& probed) {
  constexpr double kProbed = 16.0, kReach = 3.0;
  return [probed](const glm::dvec3& x) {
    double most = 1.0;
    for (const Ball& ball : probed) {
      const double radii = glm::distance(x, ball.centre) / ball.radius;
      const double t = std::clamp((kReach - radii) / (kReach - 1.0), 0.0, 1.0);
      most = std::max(most, std::pow(kProbed, t));
    }
    return most;
  };
}

}  // namespace

std::span<const MeshBudget> MeshBudgets() { return kBudgets; }

const MeshBudget& BudgetOf(MeshSize size) {
  return *std::find_if(kBudgets.begin(), kBudgets.end(),
                       [&](const MeshBudget& budget) { return budget.size == size; });
}

double StepTimeOf(int elements) {
  const MeshBudget* below = nullptr;
  for (const MeshBudget& budget : kBudgets) {
    if (elements <= budget.elements) {
      const double share = static_cast<double>(elements - (below ? below->elements : 0)) /
                           (budget.elements - (below ? below->elements : 0));
      return (below ? below->step_ms : 0) + share * (budget.step_ms - (below ? below->step_ms : 0));
    }
    below = &budget;
  }
  return below->step_ms * elements / below->elements;
}

std::string BudgetWords(const MeshBudget& budget) {
  return fmt::format(
      "About {} elements, {:.2g} ms per step. The demo's meniscus, pressed at its free edge with "
      "0.2 N, yields up to {:.0f} % too little with so many; {:.0f} % where the probed place is "
      "marked.",
      budget.elements, budget.step_ms, 100 * budget.error, 100 * budget.probed_error);
}

TetMesh TetrahedralizeToBudget(const SurfaceMesh& surface, const SurfaceSource& source,
                               const MeshWish& wish, TetrahedralizeReport* report,
                               const Progress& whole, const std::filesystem::path& program) {
  TetrahedralizeReport own_report;
  TetrahedralizeReport& result = report ? *report : own_report;
  TetrahedralizeOptions options;
  options.order = 2;
  options.keep_surface = true;
  options.min_dihedral = 0;  // the simplified triangles decide the angles here
  options.time_limit = wish.time_limit;
  options.begun = wish.begun.value_or(TimeLimit::Clock::now());
  options.memory_limit = wish.memory_limit;
  const int wanted = std::clamp(wish.elements, kFewestElements, kMostBudgetElements);

  const TimeLimit limit(options.time_limit, *options.begun);
  const Progress progress = limit.Watch(whole, source.file, surface.triangles.size());

  // Checks and reports the author's own surface, before it is simplified.
  RepairedSurface repaired = RepairSurface(surface, {}, progress);
  SurfaceSource repaired_source = source;
  repaired_source.triangle_in_file = repaired.source_triangle;
  const SurfaceCheck check = CheckSurface(repaired.surface, progress);
  RequireTissueSize(check, repaired_source);
  RequireMeshable(check, repaired_source);

  RequireTouching(wish.probed, repaired.surface, "a probed place", source);

  const auto weight = [free = FreedomWeight(repaired.surface, wish.fixed),
                       probing = ProbingWeight(wish.probed)](const glm::dvec3& x) {
    return free(x) * probing(x);
  };
  TetMesh best;
  double best_off = INFINITY, triangles = 0.85 * wanted, fewest = 0;
  for (int pass = 0; pass < kPasses && best_off > kNear; ++pass) {
    SurfaceMesh coarse = repaired.surface;
    TetrahedralizeReport attempt;
    attempt.reading = result.reading;
    attempt.simplification = SimplifyEvenly(coarse, static_cast<int>(triangles), weight, progress);
    if (CheckSurface(coarse, progress).self_intersections.count > 0) {
      triangles = fewest = 1.08 * triangles;  // so few triangles intersect one another
      continue;
    }
    TetMesh mesh = Tetrahedralize(coarse, source, options, &attempt, whole, program);
    const double off = std::abs(std::log(static_cast<double>(attempt.elements) / wanted));
    const bool is_whole =
        attempt.simplification.triangles_after == attempt.simplification.triangles_before;
    triangles = std::max(
        fewest,
        triangles * std::pow(static_cast<double>(wanted) / attempt.elements, 1.0 / kGrowth));
    if (off >= best_off) continue;
    best_off = off;
    best = std::move(mesh);
    const SurfaceReadReport reading = result.reading;
    result = attempt;
    result.reading = reading;
    if (is_whole && attempt.elements < wanted) break;  // the surface has no more triangles
  }
  if (best.elements.empty())
    throw Error(Code::kBadMesh,
                "this surface runs through itself when it is made coarse enough for a tissue that "
                "deforms; fill it with `arthroscene tetrahedralize` and a longer edge",
                source.file);
  result.repairs = repaired.repairs;
  result.improvement = ImproveTets(best, repaired.surface, kGoalDihedral, progress);
  PullMiddles(best, repaired.surface, progress);
  result.quality = MeasureTets(best);
  result.nodes = static_cast<int>(best.rest_positions.size());
  result.elements = best.ElementCount();
  result.surface_nodes = static_cast<int>(
      std::count(best.sets["surface"].begin(), best.sets["surface"].end(), std::uint8_t{1}));
  result.volume_error = std::abs(result.quality.curved_volume - check.volume) / check.volume;
  return best;
}

}  // namespace arthro::authoring
