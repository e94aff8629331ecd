// Lessons in the window, without its pictures: a robot passes a shipped exercise, an attempt that
// is stopped keeps what was observed, and an exercise that is authored can be undone and begun.
#include <algorithm>

#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/scene_files.h"
#include "app/platform/resource_folder.h"
#include "app/steps/lessons/attempt.h"
#include "app/steps/lessons/exercise_edit.h"
#include "app/steps/lessons/running_attempt.h"
#include "app/steps/practice/practice_step.h"
#include "app/steps/tissue/tissue_step.h"
#include "simulation/core/units.h"
#include "simulation/tissue/body/tissue_preset.h"
#include "simulation/training/metrics/metrics.h"
#include "simulation/training/observe/exercise_targets.h"
#include "simulation/training/robot/pose_search.h"
#include "tests/app/commands/settle.h"

namespace arthro::app {
namespace {

using simulation::AttemptOutcome;
using simulation::RodPose;

constexpr double kWindowFrame = 1.0 / 60;  // s

void Prepare(EditorState& state) {
  state.steps.practice->pace = simulation::TissuePace::kInline;
  state.steps.tissue->preset_folder = ResourceFolder() / "presets" / "tissues";
  LoadTissuePresets(state);
}

void Choose(EditorState& state, const std::string& id) {
  const auto& exercises = state.document().scene.exercises;
  const auto found = std::find_if(exercises.begin(), exercises.end(),
                                  [&](const Exercise& exercise) { return exercise.id == id; });
  ASSERT_NE(found, exercises.end()) << id;
  state.steps.lessons->chosen = static_cast<int>(found - exercises.begin());
}

void Frame(EditorState& state) {
  state.practice->Advance(kWindowFrame);
  FollowAttempt(state);
}

// Leads the scope along the shortest way in the angles, at the speed of a careful hand, and holds.
void LeadScope(EditorState& state, const RodPose& to, double seconds) {
  const RodPose from = state.practice->scope().pose();
  constexpr int kFrames = 120;
  for (int i = 1; i <= kFrames && state.practice; ++i) {
    const double share = static_cast<double>(i) / kFrames;
    const auto mix = [&](double a, double b) { return a + share * (b - a); };
    state.practice->scope().Set({mix(from.latitude, to.latitude), mix(from.longitude, to.longitude),
                                 mix(from.roll, to.roll), mix(from.depth, to.depth)});
    Frame(state);
  }
  for (double t = 0; t < seconds && state.practice; t += kWindowFrame) Frame(state);
}

TEST(Lessons, ARobotThatHoldsEachTargetInTheCentrePassesTheShippedExercise) {
  EditorState state = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
  Prepare(state);
  Choose(state, "centre-and-hold");
  app::Run(state, "begin-exercise");
  Settle(state);
  ASSERT_TRUE(state.practice) << (state.dialogs.empty() ? "" : "a dialog is open");
  const Exercise exercise = *ChosenExercise(state);
  const auto places = simulation::PlacesOfTargets(state.document(), exercise);
  // A step that holds asks for no angle to the surface, and for at most 30 mm.
  simulation::PoseSearchOptions options;
  options.nearest = 0.014;  // clear of the tissue, which would move the scope
  options.farthest = 0.029;
  options.most_incidence = RadiansFromDegrees(89);
  std::vector<RodPose> poses;
  for (const auto& place : places) {
    const auto pose =
        simulation::PoseThatSees(state.document(), place, state.practice->view_angle(),
                                 state.practice->relief(), state.practice->eye(), options);
    ASSERT_TRUE(pose) << "no pose sees target " << poses.size();
    poses.push_back(*pose);
  }
  RodPose away = state.practice->instrument().pose();  // the instrument hides targets
  away.depth = 0.001;
  state.practice->instrument().Set(away);
  for (std::size_t i = 0; i < poses.size() && state.practice; ++i) {
    LeadScope(state, poses[i], 5.5);
    if (!state.practice) break;
    const RunningAttempt& running = *state.steps.lessons->running;
    const auto& sight = running.frames.back().sight.target[i];
    EXPECT_EQ(running.engine.steps()[i].outcome, simulation::StepOutcome::kDone)
        << "target " << i << " at " << sight.centre << " of the radius, " << 1e3 * sight.distance
        << " mm off, clear: " << sight.is_clear;
  }
  ASSERT_FALSE(state.practice) << "the attempt ends with its last step";
  const FinishedAttempt& finished = *state.steps.lessons->finished;
  EXPECT_EQ(state.steps.lessons->page, LessonPage::kSummary);
  EXPECT_EQ(finished.result.outcome, AttemptOutcome::kPassed) << finished.result.reason;
  for (const auto& criterion : finished.result.criteria)
    EXPECT_TRUE(criterion.is_met) << criterion.metric;
  EXPECT_EQ(finished.result.steps.size(), exercise.steps.size());
}

TEST(Lessons, AnAttemptThatIsStoppedIsNotPassedAndKeepsItsFrames) {
  EditorState state = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
  Prepare(state);
  Choose(state, "centre-and-hold");
  app::Run(state, "begin-exercise");
  Settle(state);
  ASSERT_TRUE(state.practice);
  for (int i = 0; i < 60; ++i) Frame(state);
  app::Run(state, "leave-practice");  // Esc
  ASSERT_FALSE(state.practice);
  const FinishedAttempt& finished = *state.steps.lessons->finished;
  EXPECT_EQ(finished.result.outcome, AttemptOutcome::kStopped);
  EXPECT_NEAR(static_cast<double>(finished.frames.size()), 100, 4);
  app::Run(state, "attempt-debrief");
  ASSERT_NE(DebriefFrame(state), nullptr);
  state.steps.lessons->debrief.at = 1e9;
  EXPECT_EQ(DebriefFrame(state), &finished.frames.back());
  app::Run(state, "close-lesson");
  EXPECT_EQ(state.steps.lessons->page, LessonPage::kNone);
}

TEST(Lessons, LooseBodiesAreShownWhereTheAttemptHasThemAndInTheLookBack) {
  EditorState state = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
  Prepare(state);
  Choose(state, "loose-body");
  EXPECT_TRUE(ShownLooseBodies(state).empty());
  app::Run(state, "begin-exercise");
  Settle(state);
  ASSERT_TRUE(state.practice);
  for (int i = 0; i < 10; ++i) Frame(state);
  const std::vector<Ball> live = ShownLooseBodies(state);
  ASSERT_EQ(live.size(), 2U);
  EXPECT_EQ(live[0].radius, 0.002);
  EXPECT_EQ(glm::vec3(live[0].centre),
            state.steps.lessons->running->frames.back().sight.target[0].place);
  app::Run(state, "leave-practice");
  EXPECT_TRUE(ShownLooseBodies(state).empty());
  app::Run(state, "attempt-debrief");
  EXPECT_EQ(ShownLooseBodies(state), live) << "nothing has touched them";
  app::Run(state, "close-lesson");
  EXPECT_TRUE(ShownLooseBodies(state).empty());
}

TEST(Lessons, AnAuthoredExerciseCanBeUndoneStepByStepAndBegun) {
  EditorState state = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
  Prepare(state);
  const Scene before = state.document().scene;
  state.step = Step::kExercises;
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

TEST(Lessons, AStepWithoutAHintOffersNone) {
  EditorState state = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
  Prepare(state);
  state.step = Step::kExercises;
  app::Run(state, "new-exercise");
  AddTarget(state);
  PlaceTarget(state, {{0, 0, 0.01}, {0, 0, 1}}, std::nullopt);
  AddStep(state, 0);
  SetHint(state, 0, false);
  app::Run(state, "begin-exercise");
  Settle(state);
  for (int i = 0; i < 5; ++i) Frame(state);
  EXPECT_FALSE(CommandOf(state, "attempt-hint").enabled(state));
  app::Run(state, "end-attempt");
  SetHint(state, 0, true);
  EXPECT_EQ(BaseOf(ChosenExercise(state)->steps[0]).cue_after, 20);
}

TEST(Lessons, ARenamedTargetIsNamedAnewWhereverTheExerciseSpeaksOfIt) {
  EditorState state = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
  Prepare(state);
  state.step = Step::kExercises;
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

TEST(Lessons, ACriterionBeginsWithToolLimitAndSource) {
  for (const simulation::Metric& metric : simulation::EveryMetric()) {
    const Criterion criterion = StartCriterion(std::string(metric.id));
    EXPECT_NE(criterion.min.has_value(), criterion.max.has_value()) << metric.id;
    EXPECT_EQ(criterion.min.has_value(), metric.is_more_better) << metric.id;
    EXPECT_FALSE(criterion.source.empty()) << metric.id;
  }
  EXPECT_EQ(StartCriterion("peak_force").part, "instrument");
  EXPECT_EQ(StartCriterion("peak_force").max, simulation::kSafeProbingForce);
}

TEST(Lessons, ATargetThatLiesOnNothingIsRefusedInWordsAndNoPracticeIsLeftBehind) {
  EditorState state = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
  Prepare(state);
  state.step = Step::kExercises;
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
