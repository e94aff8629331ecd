// Attempts of the records in the window: the result and the look back as right after the practice.

#include <algorithm>

#include <fmt/format.h>

#include "app/records/attempts/records_file.h"
#include "app/records/people/reference_groups.h"
#include "app/report/make_report.h"
#include "app/state/capital.h"
#include "app/steps/lessons/instructor/rating_board.h"
#include "app/steps/lessons/keeping/lesson_records.h"
#include "app/steps/lessons/lessons_step.h"
#include "simulation/core/error.h"
#include "simulation/scene/json/exercise_json.h"
#include "simulation/training/scene_of_attempt.h"

namespace arthro::app {
namespace {

void AddNotice(std::string& notice, const std::string& sentence) {
  notice += (notice.empty() ? "" : "\n") + sentence;
}

// Sets frames and tissue of the attempt; none, with a notice, where its log is damaged or on
// another station.
void TakeRecording(const EditorState& state, const Records& records, const AttemptRecord& record,
                   FinishedAttempt& shown) {
  try {
    auto recording = simulation::ReadAttempt(records.folder() / record.log);
    shown.frames = std::move(recording.frames);
    if (!recording.torn.empty()) AddNotice(shown.notice, Capital(recording.torn) + ".");
    if (!simulation::IsOfScene(simulation::AttemptHeadOf(recording.head), state.document())) {
      AddNotice(shown.notice,
                fmt::format("This attempt was made in the scene \"{}\" as it was then; open that "
                            "one to look back in it. The picture shows the scene that is open.",
                            record.scene));
      shown.is_of_scene = false;
      return;
    }
    const auto track = std::make_shared<simulation::TissueTrack>(std::move(recording.track));
    if (track->has_begun())
      shown.track = track;
    else
      AddNotice(shown.notice,
                "The tissue of this attempt was not recorded; the picture shows it at rest.");
    if (!recording.track_fault.empty())
      AddNotice(shown.notice, Capital(recording.track_fault) + ".");
  } catch (const Error& fault) {
    shown.frames.clear();
    shown.notice = fmt::format("The look back is not there, and the result is: {}", fault.what());
  }
}

}  // namespace

void SetStanding(EditorState& state, const std::string& rig, FinishedAttempt& attempt) {
  LessonRecords& records = *state.steps.lessons->records;
  if (!records.open) return;
  try {
    const auto groups = ReferenceGroupsAt(*records.open, HashOf(attempt.exercise),
                                          simulation::kMetricsVersion, rig);
    if (groups.empty()) return;
    const ReferenceGroup* chosen = &groups.front();
    for (const Criterion& criterion : attempt.exercise.criteria)
      if (criterion.max_from)
        if (const auto named =
                std::ranges::find(groups, criterion.max_from->group, &ReferenceGroup::name);
            named != groups.end())
          chosen = &*named;
    AttemptRecord record;
    SetResult(record, attempt.result);
    attempt.standings = StandingsIn(*records.open, *chosen, record);
    attempt.group = chosen->name;
  } catch (const Error& fault) {
    records.fault = fault.what();
  }
}

void ShowStoredAttempt(EditorState& state, const std::string& id) {
  LessonsStep& step = *state.steps.lessons;
  if (!ReachRecords(*step.records)) throw Error(Code::kFile, step.records->fault);
  Records& records = *step.records->open;
  const RecordsBundle bundle = ReadBundleOf(records, id);
  const AttemptRecord& record = bundle.attempts.at(0);
  FinishedAttempt shown;
  shown.exercise = ExerciseFromJson(bundle.exercises.at(0).json);
  shown.trainee = bundle.trainees.at(0).code;
  shown.is_test = record.mode == AttemptMode::kTest;
  shown.is_robot = record.mode == AttemptMode::kRobot;
  AttemptRecord sorted = record;
  SortMetrics(sorted.metrics);
  shown.result = ResultOf(sorted);
  SetStanding(state, bundle.sessions.at(0).rig, shown);
  TakeRecording(state, records, record, shown);
  shown.id = id;
  shown.log = records.folder() / record.log;
  shown.started = record.started;
  const auto& exercises = state.document().scene.exercises;
  const auto own = std::ranges::find(exercises, shown.exercise.id, &Exercise::id);
  step.chosen = own == exercises.end() ? -1 : static_cast<int>(own - exercises.begin());
  step.finished = std::move(shown);
  step.debrief = {};
  step.rating->blinded_attempt.clear();
  step.page = LessonPage::kSummary;
}

}  // namespace arthro::app
