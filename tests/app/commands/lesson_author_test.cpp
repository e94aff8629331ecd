// Exercises that an author makes in the window, without its pictures: every kind of target and step
// is valid where it lies, each edit is one step of the history, and what lacks is said in words.
#include <algorithm>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/scene_files.h"
#include "app/platform/resource_folder.h"
#include "app/state/edits.h"
#include "app/steps/lessons/attempt.h"
#include "app/steps/lessons/author/step_edit.h"
#include "app/steps/lessons/author/target_edit.h"
#include "app/steps/lessons/exercise_edit.h"
#include "app/steps/lessons/running_attempt.h"
#include "app/steps/practice/practice_step.h"
#include "authoring/project/document_io.h"
#include "simulation/scene/files/exercise_check.h"
#include "simulation/training/metrics/metrics.h"
#include "simulation/training/observe/exercise_targets.h"
#include "tests/app/commands/lesson_test.h"
#include "tests/app/commands/settle.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

// The page Exercises of the demo.
class LessonAuthor : public testing::Test {
 protected:
  LessonAuthor() {
    Prepare(state);
    state.step = Step::kExercises;
  }
  EditorState state = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
};

TEST_F(LessonAuthor, AnAuthoredExerciseCanBeUndoneStepByStepAndBegun) {
  const Scene before = state.document().scene;
  state.scope = {-0.3, 0.1, 0.2, 0.015};
  app::Run(state, "new-exercise");
  EXPECT_EQ(ChosenExercise(state)->setup.scope, (StartPose{-0.3, 0.1, 0.2, 0.015}))
      << "an attempt begins with the view of the author";
  AddTarget(state);
  ASSERT_TRUE(TakesTarget(state));
  PlaceTarget(state, {{0, 0, 0.01}, {0, 0, 1}}, std::nullopt);
  EXPECT_TRUE(ChosenExercise(state)->targets[0].bearing);
  AddStep(state, 0);
  AddCriterion(state);
  EXPECT_EQ(BaseOf(ChosenExercise(state)->steps[0]).targets,
            std::vector<std::string>{ChosenExercise(state)->targets[0].id});
  EXPECT_EQ(BaseOf(ChosenExercise(state)->steps[0]).cue, CueKind::kOutline);
  EXPECT_FALSE(CommandOf(state, "attempt-hint").enabled(state)) << "there is no attempt";
  app::Run(state, "begin-exercise");
  Settle(state);
  ASSERT_TRUE(state.practice);
  for (int i = 0; i < 5; ++i) Frame(state);
  EXPECT_TRUE(CommandOf(state, "attempt-hint").enabled(state));
  app::Run(state, "end-attempt");
  for (int steps = 0; !(state.document().scene == before); ++steps) {
    ASSERT_LT(steps, 5) << "one step of the history for each edit";
    app::Run(state, "undo");
  }
}

TEST_F(LessonAuthor, AStepWithoutAHintOffersNone) {
  app::Run(state, "new-exercise");
  AddTarget(state);
  PlaceTarget(state, {{0, 0, 0.01}, {0, 0, 1}}, std::nullopt);
  AddStep(state, 0);
  SetCue(state, 0, CueKind::kNone);
  app::Run(state, "begin-exercise");
  Settle(state);
  for (int i = 0; i < 5; ++i) Frame(state);
  EXPECT_FALSE(CommandOf(state, "attempt-hint").enabled(state));
  app::Run(state, "end-attempt");
  SetCue(state, 0, CueKind::kName);
  EXPECT_EQ(BaseOf(ChosenExercise(state)->steps[0]).cue_after, 20);
}

TEST_F(LessonAuthor, ARenamedTargetIsNamedAnewWhereverTheExerciseSpeaksOfIt) {
  app::Run(state, "new-exercise");
  AddTarget(state);
  AddTarget(state);
  EditExercise(state, "Steps", "", [](Exercise& exercise) {
    const std::string first = exercise.targets[0].id;
    SeeStep see;
    see.targets = {first, exercise.targets[1].id};
    TrackStep track;
    track.path = {exercise.targets[1].id, first};
    RecoverStep recover;
    recover.source = first;
    exercise.steps = {see, track, recover};
    exercise.avoid = {{first, AvoidBy::kInstrument, 0}};
  });
  const Exercise before = *ChosenExercise(state);
  RenameTarget(state, 0, before.targets[1].id);
  EXPECT_EQ(*ChosenExercise(state), before) << "the name is another one's";
  EXPECT_NE(state.message.find("Another target"), std::string::npos);
  RenameTarget(state, 0, "tibial spine");
  const Exercise& named = *ChosenExercise(state);
  EXPECT_EQ(named.targets[0].id, "tibial spine");
  EXPECT_EQ(BaseOf(named.steps[0]).targets[0], "tibial spine");
  EXPECT_EQ(std::get<TrackStep>(named.steps[1]).path[1], "tibial spine");
  EXPECT_EQ(std::get<RecoverStep>(named.steps[2]).source, "tibial spine");
  EXPECT_EQ(named.avoid[0].target, "tibial spine");
}

// A new exercise with points on the relief, a ball, a loose body and a region.
void AuthorTargets(EditorState& state) {
  app::Run(state, "new-exercise");
  for (int i = 0; i < 5; ++i) {
    AddTarget(state);
    PlaceTarget(state, {{0, 0, 0.01}, glm::normalize(glm::dvec3(0.1 * i, 0, 1))}, std::nullopt);
    EXPECT_FALSE(TakesTarget(state));
  }
  SetTargetPlacing(state, 2, TargetPlacing::kBall);
  SetTargetPlacing(state, 4, TargetPlacing::kRegions);
  EditExercise(state, "Loose", "", [](Exercise& e) { e.targets[3].is_loose = true; });
}

TEST_F(LessonAuthor, TargetsOfEveryKindAreMadeWhereTheyLay) {
  AuthorTargets(state);
  const auto targets = ChosenExercise(state)->targets;
  EXPECT_TRUE(targets[0].bearing);
  ASSERT_TRUE(targets[2].ball);
  EXPECT_TRUE(targets[3].is_loose);
  EXPECT_FALSE(targets[4].regions.empty());
  EXPECT_FALSE(targets[4].on.empty());
  const auto places = simulation::PlacesOfTargets(state.document(), *ChosenExercise(state));
  SetTargetPlacing(state, 2, TargetPlacing::kSurface);
  EXPECT_FALSE(ChosenExercise(state)->targets[2].ball);
  const auto again = simulation::PlacesOfTargets(state.document(), *ChosenExercise(state));
  // The ball lay on the relief, so its bearing leads back there; the relief is sampled.
  EXPECT_LT(glm::distance(places[2].point, again[2].point), 1e-3);
  SetTargetPlacing(state, 2, TargetPlacing::kBall);
  state.steps.lessons->target = 2;
  state.steps.lessons->takes_target = true;
  PlaceTarget(state, {{0, 0, 0.01}, glm::normalize(glm::dvec3(0, 0.2, 1))}, std::nullopt);
  EXPECT_TRUE(ChosenExercise(state)->targets[2].ball) << "a click moves a ball, which stays one";
}

TEST_F(LessonAuthor, ANewStepOfEachKindIsValidWhereTheExerciseHasItsTargets) {
  AuthorTargets(state);
  constexpr int kKinds = static_cast<int>(std::variant_size_v<ExerciseStep>);
  for (int kind = 0; kind < kKinds; ++kind) {
    AddStep(state, kind);
    const auto step = static_cast<std::size_t>(kind);
    for (const std::string& sentence : LacksOfStep(state, step))
      ADD_FAILURE() << KindOf(ChosenExercise(state)->steps[step]) << ": " << sentence;
  }
  EXPECT_TRUE(LacksOfExercise(state).empty());
  const test::TempFolder folder;
  authoring::SaveDocument(state.document(), folder / "twelve");
  const Scene saved = ReadScene(folder / "twelve");
  EXPECT_EQ(ExerciseFaults(saved).size(), 0u);
  EXPECT_EQ(saved.exercises.back().steps.size(), std::size_t{kKinds});
  app::Run(state, "begin-exercise");
  Settle(state);
  ASSERT_TRUE(state.practice);
  for (int i = 0; i < 30; ++i) Frame(state);
  ASSERT_TRUE(state.practice) << "no step fails at once";
  EXPECT_EQ(state.steps.lessons->running->engine.strip().step, 0);
  app::Run(state, "end-attempt");
}

TEST_F(LessonAuthor, AStepWithoutItsTargetsSaysWhatItLacksAndCanBeSaved) {
  app::Run(state, "new-exercise");
  constexpr int kKinds = static_cast<int>(std::variant_size_v<ExerciseStep>);
  std::size_t added = 0;
  for (int kind = 0; kind < kKinds; ++kind) {
    AddStep(state, kind);
    const auto& steps = ChosenExercise(state)->steps;
    if (steps.size() == added) {
      EXPECT_NE(state.message.find("needs a target"), std::string::npos) << kind;
      continue;
    }
    const bool needs_none = std::holds_alternative<AnswerStep>(steps[added]);
    EXPECT_EQ(LacksOfStep(state, added).empty(), needs_none) << KindOf(steps[added]);
    ++added;
  }
  EXPECT_EQ(added, std::size_t{kKinds} - 2) << "transfer and recover name a target for certain";
  EXPECT_EQ(LacksOfStep(state, 6).front(), "\"Path\" names 0 targets; this kind of step needs 2.");
  EXPECT_EQ(LacksOfExercise(state).front(),
            "Step 1: \"Targets of the step\" names 0 targets; this kind of step needs 1.");
  const test::TempFolder folder;
  authoring::SaveDocument(state.document(), folder / "unfinished");
  EXPECT_EQ(ReadScene(folder / "unfinished").exercises.back().steps.size(), added);
}

TEST_F(LessonAuthor, ARemovedTargetIsTakenFromEveryListAndARequiredOneStays) {
  AuthorTargets(state);
  constexpr int kKinds = static_cast<int>(std::variant_size_v<ExerciseStep>);
  for (int kind = 0; kind < kKinds; ++kind) AddStep(state, kind);
  EditExercise(state, "Zone", "", [](Exercise& e) {
    e.avoid = {{e.targets[2].id, AvoidBy::kInstrument, 0}};
  });
  RenameTarget(state, 0, "goal");
  const auto& named = ChosenExercise(state)->steps;
  EXPECT_EQ(std::get<TransferStep>(named[8]).to, "goal");
  EXPECT_EQ(std::get<RecoverStep>(named[10]).source, "goal");
  RemoveTarget(state, 0);
  EXPECT_EQ(ChosenExercise(state)->targets[0].id, "goal");
  EXPECT_EQ(state.message, "Step 9 needs this target. Choose another one there first.");
  while (ChosenExercise(state)->targets.size() > 1) RemoveTarget(state, 1);
  const Exercise& left = *ChosenExercise(state);
  EXPECT_TRUE(left.avoid.empty());
  const std::vector<std::string> goal = {"goal"};
  EXPECT_EQ(BaseOf(left.steps[0]).targets, goal);
  EXPECT_EQ(std::get<TrackStep>(left.steps[4]).path, goal);
  EXPECT_EQ(std::get<FollowStep>(left.steps[6]).path, goal);
  EXPECT_TRUE(std::get<TransferStep>(left.steps[8]).bodies.empty());
  EXPECT_TRUE(std::get<ResectStep>(left.steps[9]).regions.empty());
}

TEST_F(LessonAuthor, EveryEditRaisesTheVersionOncePerStepOfTheHistory) {
  Choose(state, "telescope");
  const int before = ChosenExercise(state)->version;
  const auto set_radius = [&](double radius) {
    EditExercise(state, "Radius of the target", "target-radius",
                 [&](Exercise& e) { e.targets[0].radius = radius; });
  };
  set_radius(0.004);
  set_radius(0.005);
  EXPECT_EQ(ChosenExercise(state)->version, before + 1) << "one drag is one version";
  EndDrag(state);
  set_radius(0.006);
  EXPECT_EQ(ChosenExercise(state)->version, before + 2);
  EndDrag(state);
  set_radius(0.006);
  EXPECT_EQ(ChosenExercise(state)->version, before + 2) << "nothing has changed";
  app::Run(state, "undo");
  EXPECT_EQ(ChosenExercise(state)->version, before + 1);
  set_radius(0.007);
  EXPECT_EQ(ChosenExercise(state)->version, before + 3)
      << "version " << before + 2 << " may be that of an attempt by now";
  app::Run(state, "new-exercise");
  const Exercise first = *ChosenExercise(state);
  app::Run(state, "remove-exercise");
  app::Run(state, "new-exercise");
  EXPECT_EQ(ChosenExercise(state)->id, first.id);
  EXPECT_GT(ChosenExercise(state)->version, first.version);
}

TEST_F(LessonAuthor, TheCheckOfPosesNamesATargetThatNoPoseSees) {
  app::Run(state, "new-exercise");
  AddTarget(state);
  PlaceTarget(state, {{0, 0, 0.01}, {0, 0, 1}}, std::nullopt);
  EXPECT_FALSE(CommandOf(state, "check-targets").enabled(state)) << "no step names the target";
  AddStep(state, 0);
  app::Run(state, "check-targets");
  Settle(state);
  ASSERT_NE(PoseCheckOf(state), nullptr);
  EXPECT_TRUE(PoseCheckOf(state)->sentences.empty());
  EditExercise(state, "Behind", "", [](Exercise& e) {
    e.targets[0].bearing.reset();
    e.targets[0].ball = glm::dvec3(0, 0, -0.05);  // behind the portal
  });
  EXPECT_EQ(PoseCheckOf(state), nullptr) << "the target lies elsewhere now";
  app::Run(state, "check-targets");
  Settle(state);
  ASSERT_NE(PoseCheckOf(state), nullptr);
  EXPECT_EQ(PoseCheckOf(state)->sentences,
            std::vector<std::string>{"No pose sees \"target-1\" with 30°."});
}

TEST_F(LessonAuthor, ACriterionBeginsWithToolLimitAndSource) {
  for (const simulation::Metric& metric : simulation::EveryMetric()) {
    const Criterion criterion = StartCriterion(std::string(metric.id));
    EXPECT_NE(criterion.min.has_value(), criterion.max.has_value()) << metric.id;
    EXPECT_EQ(criterion.min.has_value(), metric.is_more_better) << metric.id;
    EXPECT_FALSE(criterion.source.empty()) << metric.id;
  }
  EXPECT_EQ(StartCriterion("peak_force").part, "instrument");
  EXPECT_EQ(StartCriterion("peak_force").max, simulation::kSafeProbingForce);
}

TEST_F(LessonAuthor, ATargetThatLiesOnNothingIsRefusedInWordsAndNoPracticeIsLeftBehind) {
  app::Run(state, "new-exercise");
  EditExercise(state, "Target", "", [](Exercise& exercise) {
    ExerciseTarget target;
    target.id = "far";
    target.on = "medial meniscus";
    target.point = glm::dvec3(0.5, 0.5, 0.5);
    exercise.targets.push_back(target);
  });
  app::Run(state, "begin-exercise");
  Settle(state);
  EXPECT_FALSE(state.practice);
  ASSERT_FALSE(state.dialogs.empty());
  EXPECT_NE(std::get<ErrorDialog>(state.dialogs.back()).sentence.find("place it again"),
            std::string::npos);
}

}  // namespace
}  // namespace arthro::app
