// Lessons in the window, without its pictures: a robot passes a shipped exercise, and an attempt
// that is stopped keeps what was observed.
#include <algorithm>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/scene_files.h"
#include "app/platform/resource_folder.h"
#include "app/steps/lessons/attempt.h"
#include "app/steps/lessons/cues/shown_cues.h"
#include "app/steps/lessons/lookback/touches.h"
#include "app/steps/lessons/pages/setup_words.h"
#include "app/steps/lessons/running_attempt.h"
#include "authoring/project/document_io.h"
#include "simulation/core/units.h"
#include "simulation/training/observe/exercise_targets.h"
#include "simulation/training/robot/pose_search.h"
#include "tests/app/commands/lesson_test.h"
#include "tests/app/commands/settle.h"

namespace arthro::app {
namespace {

using simulation::AttemptOutcome;
using simulation::RodPose;

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

}  // namespace
}  // namespace arthro::app
