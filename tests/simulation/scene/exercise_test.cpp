// Exercises of a scene: what the check names, and the hash that records keep.
#include "simulation/scene/exercise/exercise.h"

#include <functional>

#include <gtest/gtest.h>

#include "simulation/scene/exercise/mirrored_exercise.h"
#include "simulation/scene/files/exercise_check.h"
#include "simulation/scene/json/exercise_json.h"
#include "simulation/scene/json/scene_json.h"
#include "tests/support/example_scene.h"

namespace arthro {
namespace {

Scene FullScene() {
  std::vector<JsonFault> faults;
  Scene scene = SceneFromJson(test::FullSceneJson(), faults);
  EXPECT_TRUE(faults.empty());
  return scene;
}

TEST(ExerciseCheck, AcceptsTheFullScene) { EXPECT_EQ(ExerciseFaults(FullScene()).size(), 0u); }

TEST(ExerciseCheck, NamesEachFaultByItsKey) {
  struct Case {
    std::function<void(Exercise&)> change;
    const char* key;
    const char* says;
  };
  const Case cases[] = {
      {[](Exercise& e) { e.targets[1].on = "bone"; }, ".targets[1].on", "no tissue"},
      {[](Exercise& e) { e.targets[1].on = ""; }, ".targets[1].on", "missing"},
      {[](Exercise& e) { e.targets[3].regions = {"tail"}; }, ".targets[3].regions", "no region"},
      {[](Exercise& e) { e.targets[0].ball = glm::dvec3(0); }, ".targets[0]", "several places"},
      {[](Exercise& e) { e.targets[0].bearing.reset(); }, ".targets[0]", "no places"},
      {[](Exercise& e) { e.targets[0].on = "medial meniscus"; }, ".targets[0].on", "remove"},
      {[](Exercise& e) { e.targets.resize(17, e.targets[0]); }, ".targets", "at most 16"},
      {[](Exercise& e) { BaseOf(e.steps[1]).targets = {"x"}; }, ".steps[1].targets", "\"x\""},
      {[](Exercise& e) { BaseOf(e.steps[1]).targets = {}; }, ".steps[1].targets", "needs 1"},
      {[](Exercise& e) { std::get<TelescopeStep>(e.steps[2]).near = 1; }, ".steps[2].near", "far"},
      {[](Exercise& e) { std::get<TrackStep>(e.steps[4]).path = {"edge"}; }, ".steps[4].path",
       "needs 2"},
      {[](Exercise& e) {
         std::get<ProbeStep>(e.steps[5]).force = {3, 1};
       },
       ".steps[5].force", "smaller value first"},
      {[](Exercise& e) { BaseOf(e.steps[7]).targets.push_back("zone"); }, ".steps[7].targets",
       "two targets"},
      {[](Exercise& e) { std::get<TransferStep>(e.steps[8]).bodies = {"edge"}; },
       ".steps[8].bodies", "not loose"},
      {[](Exercise& e) { std::get<ResectStep>(e.steps[9]).regions = {"edge"}; },
       ".steps[9].regions", "without regions"},
      {[](Exercise& e) { std::get<RecoverStep>(e.steps[10]).source = "x"; }, ".steps[10].source",
       "\"x\""},
      {[](Exercise& e) { std::get<AnswerStep>(e.steps[11]).right = 2; }, ".steps[11].right",
       "2 answers"},
      {[](Exercise& e) { BaseOf(e.steps[3]).next.done = "s99"; }, ".steps[3].next.done", "s99"},
      {[](Exercise& e) {
         e.order = StepOrder::kFixed;
         BaseOf(e.steps[3]).next.done = "s2";
       },
       ".steps[1].next", "loop"},
      {[](Exercise& e) { e.avoid[0].target = "x"; }, ".avoid[0].target", "\"x\""},
      {[](Exercise& e) { e.criteria[0].max.reset(); }, ".criteria[0]", "no limit"},
      {[](Exercise& e) { e.criteria[1].max = 0.5; }, ".criteria[1].min", "more than max"},
      {[](Exercise& e) { e.setup.instruments = {"hammer"}; }, ".setup.instruments", "hammer"},
      {[](Exercise& e) { e.needs = {"x"}; }, ".needs", "does not exist"},
      {[](Exercise& e) { e.needs = {"all-kinds"}; }, ".needs", "never opens"},
  };
  for (const Case& one : cases) {
    Scene scene = FullScene();
    one.change(scene.exercises[1]);
    const std::vector<std::string> faults = ExerciseFaults(scene);
    ASSERT_EQ(faults.size(), 1u) << one.key;
    EXPECT_TRUE(faults[0].starts_with(std::string("exercises[1]") + one.key + " ")) << faults[0];
    EXPECT_NE(faults[0].find(one.says), std::string::npos) << faults[0];
  }
}

// The order of the keys in the file does not count; every value does.
TEST(ExerciseHash, ChangesWithEveryValueAndWithNothingElse) {
  const Exercise exercise = FullScene().exercises[1];
  const std::string hash = HashOf(exercise);
  EXPECT_EQ(hash.size(), 64u);
  nlohmann::json file = test::FullSceneJson();
  const nlohmann::json before = file["exercises"][1].flatten();
  int changed = 0;
  for (const auto& [pointer, value] : before.items()) {
    if (!value.is_number()) continue;
    nlohmann::json other = test::FullSceneJson();
    other["exercises"][1][nlohmann::json::json_pointer(pointer)] =
        value.is_number_integer() ? nlohmann::json(value.get<int>() == 1 ? 0 : 1)
                                  : nlohmann::json(value.get<double>() * 0.75);
    std::vector<JsonFault> faults;
    const Scene scene = SceneFromJson(other, faults);
    if (!faults.empty()) continue;
    EXPECT_NE(HashOf(scene.exercises[1]), hash) << pointer;
    ++changed;
  }
  EXPECT_GT(changed, 40);
  EXPECT_EQ(HashOf(FullScene().exercises[1]), hash);
  Exercise with_expert = exercise;
  with_expert.ghost = "another.attempt";
  EXPECT_EQ(HashOf(with_expert), hash) << "an expert is recorded of the exercise as it is";
}

TEST(MirroredExercise, TwiceIsTheSameWithoutItsRecording) {
  Exercise exercise = FullScene().exercises[1];
  const Exercise mirrored = Mirrored(exercise);
  EXPECT_EQ(*mirrored.setup.incision_spacing, 0.018);
  EXPECT_EQ(mirrored.targets[0].bearing->y, -exercise.targets[0].bearing->y);
  exercise.ghost.clear();
  EXPECT_EQ(Mirrored(mirrored), exercise);
}

}  // namespace
}  // namespace arthro
