#include "app/steps/lessons/attempt.h"

#include <algorithm>
#include <utility>

#include "app/records/keeping/expert_attempt.h"
#include "app/steps/lessons/keeping/lesson_records.h"
#include "app/steps/lessons/keeping/start_board.h"
#include "app/steps/lessons/running_attempt.h"
#include "app/steps/lessons/trainee.h"
#include "app/steps/practice/practice_step.h"
#include "app/steps/practice/start_practice.h"
#include "simulation/core/error.h"
#include "simulation/training/metrics/exercise_metrics.h"
#include "simulation/training/observe/exercise_targets.h"
#include "simulation/training/observe/surface_names.h"
#include "simulation/training/score/criteria.h"
#include "simulation/training/steps/start_disturbances.h"

namespace arthro::app {
namespace {

void SetUp(EditorState& state, const ExerciseSetup& setup) {
  simulation::Practice& practice = *state.practice;
  if (!state.steps.lessons->is_unscored) {
    std::vector<simulation::ToolKind> instruments;
    for (const std::string& kind : setup.instruments)
      instruments.push_back(simulation::ToolKindFromString(kind));
    practice.Offer(std::move(instruments), setup.view_angles);
  }
  PracticeStep& step = *state.steps.practice;
  if (!setup.view_angles.empty()) practice.SetViewAngle(setup.view_angles.front());
  if (setup.incision_spacing) practice.SetIncisionSpacing(*setup.incision_spacing);
  if (!setup.instruments.empty())
    practice.SetInstrument(simulation::ToolKindFromString(setup.instruments.front()));
  if (setup.head != HeadChoice::kAny)
    step.head = {.is_upright = setup.head == HeadChoice::kUpright};
  step.disturbing.now = simulation::DisturbancesOf(setup.disturbances);
  practice.scope().Set(
      {setup.scope.latitude, setup.scope.longitude, setup.scope.roll, setup.scope.insertion});
}

// Words for what holds the hands: mouse, zero-force and force rigs never share a group.
std::string RigWords(const simulation::Hands& hands) {
  std::string words;
  for (const auto role : {simulation::DeviceRole::kScope, simulation::DeviceRole::kInstrument}) {
    const std::string hand = hands.Now(role).name;
    if (words != hand) words += (words.empty() ? "" : " and ") + hand;
  }
  return hands.is_zero_force() ? words + ", zero force" : words;
}

// Frames and events that the log does not hold yet.
void KeepNews(LessonsStep& step, std::span<const simulation::AttemptFrame> frames) {
  RunningAttempt& running = *step.running;
  const auto& events = running.engine.events();
  if (step.records->attempt)
    step.records->attempt->Add(frames, std::span(events).subspan(running.kept_events),
                               std::span(running.track).subspan(running.kept_pieces));
  running.kept_events = events.size();
  running.kept_pieces = running.track.size();
}

// `world`: null: nothing deforms.
void RecordTissue(RunningAttempt& running, const simulation::WorldPicture* world) {
  const double t = simulation::kFrameTime * static_cast<double>(running.frames.size());
  running.recorder.Record(t, world != nullptr ? *world : simulation::WorldPicture(), running.track);
}

// The practice ends before what watches it.
void EndAttempt(EditorState& state) {
  LessonsStep& step = *state.steps.lessons;
  RunningAttempt& running = *step.running;
  running.engine.Finish();
  KeepNews(step, {});
  FinishedAttempt finished;
  finished.exercise = running.engine.exercise();
  finished.trainee = step.records->trainee;
  finished.is_test = step.is_test;
  finished.is_unscored = step.is_unscored;
  finished.frames = std::move(running.frames);
  finished.track = std::make_shared<simulation::TissueTrack>(std::move(running.track));
  const auto expert = GhostOf(state.document(), finished.exercise);
  simulation::GhostPath ghost;
  if (expert) ghost = {expert->recording.frames, expert->result.steps};
  finished.result = simulation::ResultOf(
      running.engine,
      simulation::MeasureExercise(finished.frames, running.engine,
                                  simulation::SurfaceNames(state.document().scene), {},
                                  expert ? &ghost : nullptr),
      GroupsFor(*step.records, finished.exercise, running.rig));
  if (!finished.is_unscored) SetStanding(state, running.rig, finished);
  state.practice.reset();
  step.running.reset();
  state.steps.practice->end_attempt = {};
  state.steps.practice->note_reset = {};
  if (step.records->attempt) {
    const AttemptRecord& record = step.records->attempt->record();
    finished.id = record.id;
    finished.log = FolderOf(*step.records) / record.log;
  }
  step.finished = std::move(finished);
  step.debrief = {};
  step.page = LessonPage::kSummary;
  step.start->is_stale = true;
  state.steps.practice->disturbing.now = {};
  state.full_screen = false;
  state.message = "The attempt has ended.";
  KeepAttempt(state);
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
  return ChosenExercise(state) != nullptr && MayPractise(state) && WhyShut(state).empty();
}

namespace {

void BeginAttempt(EditorState& state, bool is_unscored) {
  if (HasUnkeptAttempt(state)) KeepAttempt(state);
  if (HasUnkeptAttempt(state))
    throw Error(Code::kFile,
                "the last attempt is not kept yet, and a new one would take its place; make room "
                "on the disk, then press Keep attempt");
  const Exercise exercise = *ChosenExercise(state);
  StartPractice(state, [exercise, is_unscored](EditorState& now) {
    LessonsStep& step = *now.steps.lessons;
    step.is_unscored = is_unscored;
    try {
      SetUp(now, exercise.setup);
      step.running.emplace(now.document(), exercise, *now.practice);
    } catch (...) {
      now.practice.reset();
      throw;
    }
    ReadGhost(now);
    now.steps.practice->end_attempt = StopAttempt;
    now.steps.practice->note_reset = [](EditorState& at, const std::string& what) {
      Act(at, {.kind = simulation::ActKind::kReset, .answer = 0, .note = what});
    };
    step.finished.reset();
    step.page = LessonPage::kAttempt;
    step.note.clear();
    if (is_unscored) {
      step.records->attempt.reset();
      now.message = "The attempt runs and is not scored. Esc ends it.";
      return;
    }
    step.running->rig = RigWords(*now.steps.practice->hands);
    const std::string notice =
        BeginKeeping(*step.records, exercise, now.document(),
                     step.is_test ? AttemptMode::kTest : AttemptMode::kPractice, step.running->rig);
    now.message = notice.empty() ? "The attempt runs. Esc ends it." : notice;
  });
}

}  // namespace

void BeginExercise(EditorState& state) { BeginAttempt(state, false); }
void BeginUnscored(EditorState& state) { BeginAttempt(state, true); }

void PauseAttempt(EditorState& state, bool is_paused) {
  LessonsStep& step = *state.steps.lessons;
  if (!step.running) return;
  step.running->is_paused = is_paused;
  step.running->live.watch().SetPaused(is_paused);
}

bool IsPaused(const EditorState& state) {
  const LessonsStep& step = *state.steps.lessons;
  return step.running.has_value() && step.running->is_paused;
}

void Act(EditorState& state, const simulation::TraineeAct& act) {
  if (state.steps.lessons->running) state.steps.lessons->running->acts.push_back(act);
}

void StopAttempt(EditorState& state) { EndAttempt(state); }

void KeepAttempt(EditorState& state) {
  LessonsStep& step = *state.steps.lessons;
  if (!step.records->attempt || !step.finished) return;
  step.finished->kept = EndKeeping(*step.records, step.finished->result);
  state.message = step.finished->kept;
}

bool HasUnkeptAttempt(const EditorState& state) {
  return state.steps.lessons->records->unwritten.has_value();
}

void OpenLessons(EditorState& state, const std::optional<std::string>& place) {
  LessonRecords& records = *state.steps.lessons->records;
  try {
    records.place = place ? *place : DefaultRecords();
  } catch (const Error& fault) {  // no home
    records.fault = fault.what();
  }
  if (records.place.empty()) return;
  // Records that are not there yet are made with their first trainee.
  std::error_code ignored;
  if (!IsServer(records.place) && !std::filesystem::exists(records.place, ignored)) return;
  for (const std::string& sentence : OpenRecords(records)) state.message = sentence;
}

void EndLessons(EditorState& state) {
  LessonsStep& step = *state.steps.lessons;
  if (step.running && state.practice) EndAttempt(state);
  if (HasUnkeptAttempt(state)) KeepAttempt(state);
  LeaveTrainee(*step.records);
}

bool FollowAttempt(EditorState& state) {
  LessonsStep& step = *state.steps.lessons;
  if (!step.running || !state.practice) return false;
  RunningAttempt& running = *step.running;
  bool is_changed = false;
  const auto ended = running.live.Update(state.practice->tissues());
  for (const simulation::AttemptFrame& frame : ended) {
    running.frames.push_back(frame);
    running.engine.Advance(frame, running.acts);
    running.acts.clear();
    is_changed = true;
  }
  if (!ended.empty()) RecordTissue(running, state.practice->tissues());
  KeepNews(step, ended);
  const ExerciseSetup& setup = running.engine.exercise().setup;
  state.steps.practice->disturbing.now.haze =
      std::max(setup.disturbances.haze, running.engine.strip().haze);
  if (running.engine.end() != simulation::AttemptEnd::kRunning) EndAttempt(state);
  return is_changed;
}

}  // namespace arthro::app
