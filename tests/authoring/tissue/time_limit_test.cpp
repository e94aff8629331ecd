// The time limit covers the stages before and after the mesher as well.
#include "authoring/tissue/surface/time_limit.h"

#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "authoring/tissue/tetrahedra/mesh_budget.h"
#include "authoring/tissue/tetrahedra/tetrahedralize.h"
#include "simulation/core/error.h"
#include "tests/support/build_paths.h"
#include "tests/support/shapes.h"

namespace arthro::authoring {
namespace {

using Clock = std::chrono::steady_clock;

// 131,072 triangles: seconds of checking and simplifying before the mesher begins.
const SurfaceMesh& LargeSurface() {
  static const SurfaceMesh sphere = test::Sphere({0, 0, 0}, 0.01, 7);
  return sphere;
}

struct TimedRun {
  std::string sentence;
  std::set<std::string> stages;
};

template <class Work>
TimedRun Watch(const Work& work, const std::atomic<bool>* stop = nullptr) {
  TimedRun outcome;
  Progress progress;
  progress.stop = stop;
  progress.report = [&](std::string_view stage, double) { outcome.stages.emplace(stage); };
  try {
    work(progress);
  } catch (const Error& error) {
    outcome.sentence = error.sentence();
  }
  return outcome;
}

TimedRun FillToBudget(double time_limit, std::optional<Clock::time_point> begun = {}) {
  MeshWish wish;
  wish.time_limit = time_limit;
  wish.begun = begun;
  return Watch([&](const Progress& progress) {
    TetrahedralizeToBudget(LargeSurface(), {}, wish, nullptr, progress, ARTHRO_PROGRAM);
  });
}

TEST(TimeLimit, EndsABudgetedMeshDuringTheSurfaceStages) {
  LargeSurface();
  const TimedRun outcome = FillToBudget(0.2);
  EXPECT_NE(outcome.sentence.find("did not finish in time (0.2 s)"), std::string::npos)
      << outcome.sentence;
  EXPECT_NE(outcome.sentence.find("131072"), std::string::npos) << outcome.sentence;
  EXPECT_FALSE(outcome.stages.contains("filling it with tetrahedra")) << "the mesher was reached";
}

TEST(TimeLimit, CountsFromTheStartOfTheJob) {
  const TimedRun outcome = FillToBudget(5.0, Clock::now() - std::chrono::seconds(6));
  EXPECT_NE(outcome.sentence.find("did not finish in time (5 s)"), std::string::npos)
      << outcome.sentence;
}

TEST(TimeLimit, EndsTheStagesBeforeTheMesher) {
  TetrahedralizeOptions options;
  options.max_triangles = 400;
  options.time_limit = 0.2;
  const TimedRun outcome = Watch([&](const Progress& progress) {
    Tetrahedralize(LargeSurface(), {}, options, nullptr, progress, ARTHRO_PROGRAM);
  });
  EXPECT_NE(outcome.sentence.find("did not finish in time (0.2 s)"), std::string::npos)
      << outcome.sentence;
}

TEST(TimeLimit, LongStagesReportProgressAndCanBeCancelled) {
  const SurfaceMesh sphere = test::Sphere({0, 0, 0}, 0.01, 6);
  const TimedRun outcome = Watch([&](const Progress& progress) {
    SurfaceMesh simple = RepairSurface(sphere, {}, progress).surface;
    CheckSurface(simple, progress);
    SimplifySurface(simple, 500, progress);
  });
  EXPECT_EQ(outcome.sentence, "");
  EXPECT_EQ(outcome.stages,
            (std::set<std::string>{"checking the surface", "looking for self-intersections",
                                   "repairing the surface", "simplifying the surface"}));
  const std::atomic<bool> stop = true;
  SurfaceMesh copy = sphere;
  for (const auto& work : {std::function<void(const Progress&)>([&](const Progress& progress) {
                             RepairSurface(sphere, {}, progress);
                           }),
                           std::function<void(const Progress&)>(
                               [&](const Progress& progress) { CheckSurface(sphere, progress); }),
                           std::function<void(const Progress&)>([&](const Progress& progress) {
                             SimplifySurface(copy, 500, progress);
                           })})
    EXPECT_NE(Watch(work, &stop).sentence.find("stopped"), std::string::npos);
}

}  // namespace
}  // namespace arthro::authoring
