// Lessons in the window, without its pictures: a robot passes a shipped exercise, an attempt that
// is stopped keeps what was observed, and an exercise that is authored can be undone and begun.
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
#include "app/steps/lessons/cues/shown_cues.h"
#include "app/steps/lessons/exercise_edit.h"
#include "app/steps/lessons/lookback/touches.h"
#include "app/steps/lessons/pages/setup_words.h"
#include "app/steps/lessons/running_attempt.h"
#include "app/steps/practice/practice_step.h"
#include "app/steps/tissue/tissue_step.h"
#include "authoring/project/document_io.h"
#include "simulation/core/units.h"
#include "simulation/scene/files/exercise_check.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/tissue/body/tissue_preset.h"
#include "simulation/training/metrics/metrics.h"
#include "simulation/training/observe/exercise_targets.h"
#include "simulation/training/robot/pose_search.h"
#include "tests/app/commands/settle.h"
#include "tests/support/temp_folder.h"

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

// An attempt at a shipped exercise after some frames; with a hint where that is asked for.
void Attempt(EditorState& state, const std::string& id, bool has_hint) {
  Prepare(state);
  Choose(state, id);
  app::Run(state, "begin-exercise");
  Settle(state);
  EXPECT_TRUE(state.practice) << id;
  for (int i = 0; i < 3; ++i) Frame(state);
  if (has_hint) app::Run(state, "attempt-hint");
  for (int i = 0; i < 3; ++i) Frame(state);
}

std::vector<std::string> NamesOf(const std::vector<CueMark>& marks) {
  std::vector<std::string> names;
  for (const CueMark& mark : marks) names.push_back(mark.name);
  return names;
}

TEST(Lessons, AHintShowsBodiesToCarryAndTheSourceOfABleeding) {
  EditorState loose = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
  Attempt(loose, "loose-body", true);
  EXPECT_EQ(NamesOf(CuesOf(loose).cues), (std::vector<std::string>{"first-body", "second-body"}));
  EXPECT_EQ(NamesOf(CuesOf(loose).spare), std::vector<std::string>{"condyle"});
  EditorState bleeding = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
  Attempt(bleeding, "bleeding", true);
  EXPECT_EQ(NamesOf(CuesOf(bleeding).cues), std::vector<std::string>{"posterior-edge"});
}

TEST(Lessons, APartToRemoveIsMarkedOnTheTissueFromTheBegin) {
  EditorState state = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
  Attempt(state, "trim", false);
  const ShownCues shown = CuesOf(state);
  EXPECT_EQ(NamesOf(shown.spare), std::vector<std::string>{"condyle"});
  ASSERT_GT(shown.remove.size(), 20U);
  const Tissue& meniscus = state.document().scene.tissues.at(0);
  const Ball& flap = meniscus.regions.at(0).ball;
  for (const OutlinePiece& piece : shown.remove)
    for (const glm::dvec3& end : {piece.a, piece.b}) {
      const glm::dvec3 at =
          glm::conjugate(meniscus.pose.quaternion) * (end - meniscus.pose.position);
      // 0.2 mm: triangles are not as round as the ball, and the tissue lives.
      EXPECT_NEAR(glm::distance(at, meniscus.pose.scale * flap.centre),
                  meniscus.pose.scale * flap.radius, 2e-4);
    }
}

TEST(Lessons, AWholePathIsShownFromTheBegin) {
  for (const auto& [id, corners] :
       {std::pair{"straight-line", 3U}, {"trace-edge", 4U}, {"track", 3U}}) {
    EditorState state = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
    Attempt(state, id, false);
    const ShownCues shown = CuesOf(state);
    ASSERT_EQ(shown.paths.size(), 1U) << id;
    EXPECT_EQ(shown.paths[0].size(), corners) << id;
    const auto& frame = state.steps.lessons->running->frames.back();
    EXPECT_EQ(glm::vec3(shown.paths[0].front()), frame.sight.target[0].place) << id;
    // Zones to keep off are shown with the hints, which two of these exercises give at once.
    EXPECT_EQ(shown.spare.empty(), shown.cues.empty()) << id;
  }
}

bool MayRun(const EditorState& state, const char* command) {
  return CommandOf(state, command).enabled(state);
}

TEST(Lessons, AnAttemptOffersTheLensesAndInstrumentsOfItsExerciseAlone) {
  EditorState state = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
  Attempt(state, "periscope-70-90", false);
  EXPECT_TRUE(MayRun(state, "view-70"));
  EXPECT_TRUE(MayRun(state, "view-90"));
  EXPECT_FALSE(MayRun(state, "view-30"));
  app::Run(state, "end-attempt");
  Attempt(state, "trim", false);
  EXPECT_TRUE(MayRun(state, "instrument-punch"));
  EXPECT_TRUE(MayRun(state, "instrument-shaver"));
  EXPECT_FALSE(MayRun(state, "instrument-probe"));
  EXPECT_EQ(state.practice->offered(),
            (std::vector{simulation::ToolKind::kPunch, simulation::ToolKind::kShaver}))
      << "the button of a device changes between these two";
  app::Run(state, "end-attempt");
  app::Run(state, "practise");
  Settle(state);
  EXPECT_TRUE(MayRun(state, "instrument-probe"));
  EXPECT_TRUE(MayRun(state, "view-30"));
  app::Run(state, "leave-practice");
}

TEST(Lessons, AnUnscoredAttemptOffersEverythingAndCountsForNothing) {
  EditorState state = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
  Prepare(state);
  Choose(state, "trim");
  app::Run(state, "begin-unscored");
  Settle(state);
  ASSERT_TRUE(state.practice);
  for (int i = 0; i < 3; ++i) Frame(state);
  EXPECT_TRUE(MayRun(state, "instrument-probe"));
  EXPECT_TRUE(MayRun(state, "view-70"));
  app::Run(state, "end-attempt");
  EXPECT_TRUE(state.steps.lessons->finished->is_unscored);
  EXPECT_FALSE(MayRun(state, "attempt-report"));
  EXPECT_TRUE(MayRun(state, "attempt-debrief"));
}

int CountOf(const FinishedAttempt& attempt, simulation::EventKind kind, const std::string& note) {
  return static_cast<int>(std::ranges::count_if(attempt.result.events, [&](const auto& event) {
    return event.kind == kind && event.note == note;
  }));
}

TEST(Lessons, APauseStopsTheTimeAndIsAnEventAsResetsAndNotesAre) {
  EditorState state = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
  Attempt(state, "trim", false);
  const auto time = [&] { return state.steps.lessons->running->engine.strip().time; };
  app::Run(state, "attempt-pause");
  EXPECT_TRUE(IsPaused(state));
  for (int i = 0; i < 3; ++i) Frame(state);  // frames that had begun before
  const double paused = time();
  for (int i = 0; i < 30; ++i) Frame(state);
  EXPECT_EQ(time(), paused);
  app::Run(state, "attempt-pause");
  for (int i = 0; i < 30; ++i) Frame(state);
  EXPECT_NEAR(time() - paused, 0.5, 0.05);
  app::Run(state, "reset-tissues");
  EXPECT_FALSE(MayRun(state, "attempt-note"));
  state.steps.lessons->note = "steady";
  app::Run(state, "attempt-note");
  EXPECT_TRUE(state.steps.lessons->note.empty());
  for (int i = 0; i < 3; ++i) Frame(state);
  app::Run(state, "end-attempt");
  const FinishedAttempt& finished = *state.steps.lessons->finished;
  using simulation::EventKind;
  EXPECT_EQ(CountOf(finished, EventKind::kPause, ""), 1);
  EXPECT_EQ(CountOf(finished, EventKind::kResume, ""), 1);
  EXPECT_EQ(CountOf(finished, EventKind::kReset, "tissue"), 1);
  EXPECT_EQ(CountOf(finished, EventKind::kNote, "steady"), 1);
  EXPECT_NEAR(finished.result.duration, 0.01 * static_cast<double>(finished.frames.size()) - 0.5,
              0.1);
}

TEST(Lessons, TheBriefingSaysLensAndInstrument) {
  const Scene scene = OpenSceneDocument(ResourceFolder() / "demo").scene;
  const auto words = [&](const std::string& id) {
    return SetupWords(std::ranges::find(scene.exercises, id, &Exercise::id)->setup);
  };
  EXPECT_EQ(words("periscope-70-90"), "Scope: 70° or 90°");
  EXPECT_EQ(words("trim"), "Scope: 30°   Instrument: punch or shaver");
  EXPECT_EQ(SetupWords({}), "");
}

TEST(Touches, OfOnePlaceAreOneUntilTheForceGrows) {
  std::vector<simulation::AttemptFrame> frames(6);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    simulation::ToolFrame& tool = frames[k].tool[1];
    tool.is_valid = true;
    tool.depth = 0.01F;
    tool.drawn_tip = {0.01F, 0, 0.02F};
    tool.contact = simulation::kBackdropContact;
    tool.peak_force = k < 3 ? 1.0F : 9.0F;
  }
  frames[0].tool[1].contact = simulation::kNoContact;
  frames[5].tool[1].drawn_tip.x += 0.001F;
  const std::vector<TouchMark> touches = TouchesOf(frames);
  ASSERT_EQ(touches.size(), 3U);
  EXPECT_EQ(touches[0].grade, TouchGrade::kLight);
  EXPECT_NEAR(touches[0].t, 0.01, 1e-12);
  EXPECT_EQ(touches[1].grade, TouchGrade::kHarm);
  EXPECT_NEAR(touches[1].t, 0.03, 1e-12);
  EXPECT_NEAR(touches[2].place.x, 0.011, 1e-6);
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
  SetCue(state, 0, CueKind::kNone);
  app::Run(state, "begin-exercise");
  Settle(state);
  for (int i = 0; i < 5; ++i) Frame(state);
  EXPECT_FALSE(CommandOf(state, "attempt-hint").enabled(state));
  app::Run(state, "end-attempt");
  SetCue(state, 0, CueKind::kName);
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

// A new exercise with points on the relief, a ball, a loose body and a region.
void AuthorTargets(EditorState& state) {
  state.step = Step::kExercises;
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

TEST(LessonAuthor, TargetsOfEveryKindAreMadeWhereTheyLay) {
  EditorState state = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
  Prepare(state);
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

TEST(LessonAuthor, ANewStepOfEachKindIsValidWhereTheExerciseHasItsTargets) {
  EditorState state = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
  Prepare(state);
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

TEST(LessonAuthor, AStepWithoutItsTargetsSaysWhatItLacksAndCanBeSaved) {
  EditorState state = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
  Prepare(state);
  state.step = Step::kExercises;
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

TEST(LessonAuthor, ARemovedTargetIsTakenFromEveryListAndARequiredOneStays) {
  EditorState state = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
  Prepare(state);
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

TEST(LessonAuthor, EveryEditRaisesTheVersionOncePerStepOfTheHistory) {
  EditorState state = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
  Prepare(state);
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

TEST(LessonAuthor, TheCheckOfPosesNamesATargetThatNoPoseSees) {
  EditorState state = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
  Prepare(state);
  state.step = Step::kExercises;
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
