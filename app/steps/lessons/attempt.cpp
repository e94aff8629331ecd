#include "app/steps/lessons/attempt.h"

#include <algorithm>
#include <utility>

#include "app/steps/lessons/running_attempt.h"
#include "app/steps/practice/practice_step.h"
#include "app/steps/practice/start_practice.h"
#include "simulation/practice/hands/offered_instruments.h"
#include "simulation/training/metrics/exercise_metrics.h"
#include "simulation/training/observe/exercise_targets.h"
#include "simulation/training/score/criteria.h"

namespace arthro::app {
namespace {

// Strengths at the start of the exercise.
simulation::Disturbances DisturbancesOf(const StartDisturbances& start) {
  simulation::Disturbances now;
  now.haze = start.haze, now.bubbles = start.bubbles, now.debris = start.debris;
  now.fog = start.fog, now.near_blur = start.near_blur, now.far_blur = start.far_blur;
  now.overexposure = start.overexposure;
  return now;
}

void SetUp(EditorState& state, const ExerciseSetup& setup) {
  simulation::Practice& practice = *state.practice;
  PracticeStep& step = *state.steps.practice;
  if (!setup.view_angles.empty()) practice.SetViewAngle(setup.view_angles.front());
  if (setup.incision_spacing) practice.SetIncisionSpacing(*setup.incision_spacing);
  if (!setup.instruments.empty())
    practice.SetInstrument(simulation::ToolKindFromString(setup.instruments.front()));
  if (setup.head != HeadChoice::kAny)
    step.head = {.is_upright = setup.head == HeadChoice::kUpright};
  step.disturbing.now = DisturbancesOf(setup.disturbances);
  practice.scope().Set(
      {setup.scope.latitude, setup.scope.longitude, setup.scope.roll, setup.scope.insertion});
}

std::vector<std::string> SurfaceNames(const Scene& scene) {
  std::vector<std::string> names{"backdrop"};
  for (const Tissue& tissue : scene.tissues) names.push_back(tissue.name);
  return names;
}

// The practice ends before what watches it.
void EndAttempt(EditorState& state) {
  LessonsStep& step = *state.steps.lessons;
  RunningAttempt& running = *step.running;
  running.engine.Finish();
  FinishedAttempt finished{running.engine.exercise(), step.trainee, step.is_test, {}, {}};
  finished.frames = std::move(running.frames);
  finished.result = simulation::ResultOf(
      running.engine, simulation::MeasureExercise(finished.frames, running.engine,
                                                  SurfaceNames(state.document().scene)));
  state.practice.reset();
  step.running.reset();
  state.steps.practice->end_attempt = {};
  step.finished = std::move(finished);
  step.debrief = {};
  step.page = LessonPage::kSummary;
  state.steps.practice->disturbing.now = {};
  state.full_screen = false;
  state.message = "The attempt has ended.";
}

}  // namespace

RunningAttempt::RunningAttempt(const LoadedScene& loaded, const Exercise& exercise,
                               simulation::Practice& practice)
    : live(loaded, simulation::PlacesOfTargets(loaded, exercise), practice.relief(),
           practice.eye()),
      engine(exercise) {
  practice.AddWatch(live.watch());
}

const Exercise* ChosenExercise(const EditorState& state) {
  const auto& exercises = state.document().scene.exercises;
  const int chosen = state.steps.lessons->chosen;
  return chosen >= 0 && chosen < static_cast<int>(exercises.size())
             ? &exercises[static_cast<std::size_t>(chosen)]
             : nullptr;
}

bool MayBeginExercise(const EditorState& state) {
  return ChosenExercise(state) != nullptr && MayPractise(state);
}

void BeginExercise(EditorState& state) {
  const Exercise exercise = *ChosenExercise(state);
  StartPractice(state, [exercise](EditorState& now) {
    LessonsStep& step = *now.steps.lessons;
    try {
      SetUp(now, exercise.setup);
      step.running.emplace(now.document(), exercise, *now.practice);
    } catch (...) {
      now.practice.reset();
      throw;
    }
    now.steps.practice->end_attempt = StopAttempt;
    step.finished.reset();
    step.page = LessonPage::kAttempt;
    now.message = "The attempt runs. Esc ends it.";
  });
}

void Act(EditorState& state, const simulation::TraineeAct& act) {
  if (state.steps.lessons->running) state.steps.lessons->running->acts.push_back(act);
}

void StopAttempt(EditorState& state) { EndAttempt(state); }

bool FollowAttempt(EditorState& state) {
  LessonsStep& step = *state.steps.lessons;
  if (!step.running || !state.practice) return false;
  RunningAttempt& running = *step.running;
  bool is_changed = false;
  for (const simulation::AttemptFrame& frame : running.live.Update(state.practice->tissues())) {
    running.frames.push_back(frame);
    running.engine.Advance(frame, running.acts);
    running.acts.clear();
    is_changed = true;
  }
  const ExerciseSetup& setup = running.engine.exercise().setup;
  state.steps.practice->disturbing.now.haze =
      std::max(setup.disturbances.haze, running.engine.strip().haze);
  if (running.engine.end() != simulation::AttemptEnd::kRunning) EndAttempt(state);
  return is_changed;
}

}  // namespace arthro::app
