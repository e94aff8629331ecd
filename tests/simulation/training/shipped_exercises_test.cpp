// The exercises of the demo scene, as they are installed.
#include <filesystem>
#include <set>

#include <gtest/gtest.h>

#include "simulation/scene/files/exercise_check.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/json/exercise_json.h"
#include "simulation/training/score/criteria.h"
#include "tests/support/build_paths.h"

namespace arthro::simulation {
namespace {

Scene DemoScene() { return ReadScene(std::filesystem::path(ARTHRO_SOURCE_DIR) / "resources/demo"); }

TEST(ShippedExercises, AreFourteenWithoutFaults) {
  const Scene scene = DemoScene();
  EXPECT_EQ(scene.exercises.size(), 14u);
  EXPECT_EQ(ExerciseFaults(scene), std::vector<std::string>());
  EXPECT_EQ(CriterionFaults(scene), std::vector<std::string>());
  std::set<std::string> hashes;
  for (const Exercise& exercise : scene.exercises) {
    EXPECT_FALSE(exercise.title.empty() || exercise.brief.empty()) << exercise.id;
    EXPECT_FALSE(exercise.steps.empty() || exercise.criteria.empty()) << exercise.id;
    for (const Criterion& criterion : exercise.criteria)
      EXPECT_FALSE(criterion.source.empty()) << exercise.id << " " << criterion.metric;
    hashes.insert(HashOf(exercise));
  }
  EXPECT_EQ(hashes.size(), 14u);
}

TEST(ShippedExercises, UseEveryKindOfStep) {
  std::set<std::string> kinds;
  for (const Exercise& exercise : DemoScene().exercises)
    for (const ExerciseStep& step : exercise.steps) kinds.insert(KindOf(step));
  EXPECT_EQ(kinds.size(), std::variant_size_v<ExerciseStep>);
}

}  // namespace
}  // namespace arthro::simulation
