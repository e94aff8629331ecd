// Exercises of the scene: choosing one, the attempt at it, what came of it, and the look back at
// it. Pages stand in the place of the practice's panel while a practice runs, and beside the
// picture in the editor.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/report/attempt_report.h"
#include "app/state/command.h"
#include "app/state/owned.h"
#include "simulation/scene/exercise/exercise.h"
#include "simulation/scene/scene.h"
#include "simulation/training/attempt_result.h"
#include "simulation/training/observe/attempt_frame.h"
#include "simulation/training/track/tissue_track.h"

namespace arthro::app {

struct Area;
struct Ui;
struct CohortBoard;     // instructor/cohort_board.h
struct Expert;          // lookback/expert.h
struct LessonRecords;   // keeping/lesson_records.h
struct RatingBoard;     // instructor/rating_board.h
struct RunningAttempt;  // running_attempt.h
struct StartBoard;      // keeping/start_board.h

// An attempt that has ended, with everything that was observed of it.
struct FinishedAttempt {
  Exercise exercise;
  std::string trainee;  // code
  bool is_test = false, is_robot = false;
  bool is_unscored = false;  // it counts for nothing, and is not kept
  simulation::AttemptResult result;
  // Standing in a reference group of the same rig, and its name; empty: there is none.
  std::vector<GroupStanding> standings;
  std::string group;
  std::vector<simulation::AttemptFrame> frames;
  // Tissue of the frames; null: it was not recorded, or in another scene. Shared by copies of this,
  // since it only remembers what it has read.
  std::shared_ptr<simulation::TissueTrack> track;
  std::string id;             // in the records; empty: it is not there
  std::string started;        // UTC; empty: it has just ended
  std::string kept;           // sentence about where it is kept
  bool is_of_scene = true;    // it was made in the scene that is open
  std::string notice;         // sentences about what cannot be shown, one per line
  std::filesystem::path log;  // its file beside the records; empty: it was not kept
};

// A place that a tool touched, from `t` s on.
enum class TouchGrade { kLight, kCare, kHarm };  // up to 3 N, up to the safe force, and over it
struct TouchMark {
  double t = 0;
  glm::dvec3 place{0.0};
  TouchGrade grade = TouchGrade::kLight;
};

// A position in the attempt that is looked back at, and the expert beside it.
struct Debrief {
  double at = 0;  // s
  bool plays = false;
  double speed = 1;
  std::shared_ptr<Expert> expert;  // null: none; shared, since its type is known elsewhere
  std::string expert_words;        // whose it is, or why there is none
  std::vector<TouchMark> touches;
};

// Targets of an exercise that no pose of the scope sees, in a scene with these tissues.
struct PoseCheck {
  Exercise exercise;
  std::vector<Tissue> tissues;
  std::vector<std::string> sentences;  // one per target; empty: each is seen
};

enum class LessonPage { kNone, kStart, kBriefing, kAttempt, kSummary, kDebrief, kInstructor };

// Picture of an exercise, as it was read last.
struct LessonPicture {
  std::filesystem::path name;
  int document = -1;  // EditorState::document_number
  std::shared_ptr<const ColourImage> picture;
  std::string fault;  // why it cannot be read; empty: it was
};
// Texture of a picture; 0: none.
using LessonTexture = std::function<unsigned(const std::shared_ptr<const ColourImage>&)>;

struct LessonsStep {
  bool is_test = false;
  bool is_unscored = false;  // holds for the attempt that runs
  std::string note;          // remark of the instructor that is typed
  LessonPicture picture;
  int chosen = -1;  // exercise of the scene
  LessonPage page = LessonPage::kNone;
  Owned<LessonRecords> records;
  Owned<StartBoard> start;
  Owned<CohortBoard> cohort;
  Owned<RatingBoard> rating;
  Owned<RunningAttempt> running;
  std::optional<FinishedAttempt> finished;
  Debrief debrief;
  // Author's part: what is selected in the lists of the exercise that is edited.
  int target = -1, step = -1, criterion = -1, zone = -1;
  bool takes_target = false;  // a click in the picture sets the place of the chosen target
  std::optional<PoseCheck> pose_check;
  std::string drag_key;                        // merge key of the last edit, while it is dragged
  std::map<std::string, int> newest_versions;  // edited exercises by their ids
};

// The chosen exercise; null: none.
const Exercise* ChosenExercise(const EditorState& state);

std::span<const Command> LessonCommands();

// Opens the records at `place`, or those of the user, and recovers attempts that were cut short. An
// empty place keeps nothing.
void OpenLessons(EditorState& state, const std::optional<std::string>& place);
// Shows what an exercise of the scene asks for, to a trainee who begins it next; an empty code: the
// attempt is not kept. The trainee's page takes its place where nobody has the code. Throws Error
// for an exercise that the scene does not have.
void OpenBriefing(EditorState& state, const std::string& exercise, const std::string& trainee,
                  bool is_test);
// The program ends: an attempt that runs is stopped and kept.
void EndLessons(EditorState& state);

// True while the attempt that runs is paused: its time stands still, and nothing counts.
bool IsPaused(const EditorState& state);

// Once per frame, after the practice has advanced: observes it and follows the steps. True when
// something changed.
bool FollowAttempt(EditorState& state);
// Reads the expert whose way the attempt that runs shows, where a step has a ghost as its cue.
void ReadGhost(EditorState& state);
// Opens the look back, with an expert where there is one.
void OpenDebrief(EditorState& state);
// Makes the attempt that is shown the recording of an expert that the scene names.
bool MayBeExpert(const EditorState& state);
void UseAsExpert(EditorState& state);
// Once per frame of the window: plays the look back.
void PlayDebrief(EditorState& state, double seconds);
// Frame that the look back shows; null: none.
const simulation::AttemptFrame* DebriefFrame(const EditorState& state);
// Tissues of that frame, but for those that never moved; null: none was recorded. Valid until the
// next call.
const simulation::WorldPicture* DebriefTissues(const EditorState& state);
// The same of the expert, at the same step; null: there is none.
const simulation::AttemptFrame* ExpertFrame(const EditorState& state);
const simulation::WorldPicture* ExpertTissues(const EditorState& state);
// Loose bodies of the attempt that runs or is looked back at, and of the expert; portal frame.
std::vector<Ball> ShownLooseBodies(const EditorState& state);
std::vector<Ball> ExpertLooseBodies(const EditorState& state);

// Sets the standing of an attempt in the group that its criteria name, or in the first one; groups
// of another rig are left out.
void SetStanding(EditorState& state, const std::string& rig, FinishedAttempt& attempt);
// Shows the result of an attempt in the records. Frames that cannot be read, and a scene that is
// not the one it was made in, leave FinishedAttempt::notice. Throws Error where the records do not
// have it.
void ShowStoredAttempt(EditorState& state, const std::string& id);
// Asks for the log of an attempt or recorded hands, and shows how they were done in the open scene:
// hands at the chosen exercise. True where nothing is under way and the scene has exercises.
bool MayOpenAttempt(const EditorState& state);
void BrowseForAttempt(EditorState& state);
// Throws Error where it may not be opened now; the job says what is wrong with the file.
void OpenAttemptFile(EditorState& state, const std::filesystem::path& file);
// Asks for a file, and writes the report of the attempt that is shown.
void SaveReport(EditorState& state);

// ---- Instructor (instructor/). ----
void ShowInstructorPage(EditorState& state);
// True where somebody and a reason stand on the page; both are kept in the audit.
bool MayOpenGate(const EditorState& state);
void OpenChosenGate(EditorState& state);
// Asks for a file, and writes every attempt of the records as a table (CSV).
void SaveAttemptTable(EditorState& state);
// True while the look back at an attempt of the records is shown.
bool MayRate(const EditorState& state);
// True while the attempt that is shown is rated blinded: nothing says whose it is and how it ended.
bool IsBlinded(const EditorState& state);
// True where an exercise is chosen on the instructor's page.
bool MayRateBlinded(const EditorState& state);
// Shows the look back at a random attempt at the chosen exercise that the rater has not rated, with
// the form. Throws Error where there is none.
void RateBlinded(EditorState& state);
// Shows the rating form, or takes it away.
void ToggleRating(EditorState& state);
bool ShowsRating(const EditorState& state);
// True where there is a rater and a score.
bool MayKeepRating(const EditorState& state);
void KeepRating(EditorState& state);

// ---- Author (author/). ----
// Looks for poses that see the targets of the chosen exercise, beside the window.
bool MayCheckTargets(const EditorState& state);
void CheckTargets(EditorState& state);
// Result for the chosen exercise; null: none, or the exercise has changed since.
const PoseCheck* PoseCheckOf(const EditorState& state);

void ExercisesPanel(Ui& ui, EditorState& state);  // the editor's step
// Inside of the page below.
void AttemptPage(Ui& ui, EditorState& state, const LessonTexture& texture_of);
void BriefingPage(Ui& ui, EditorState& state, const LessonTexture& texture_of);
void TraineePage(Ui& ui, EditorState& state);
void InstructorPage(Ui& ui, EditorState& state);
// In the place of the practice's panel while an attempt runs, else the whole page.
void LessonPagePanel(Ui& ui, EditorState& state, const Area& area, const LessonTexture& texture_of);
// The look back: beside the scope's picture, and in the place of the overview.
void RatingFields(Ui& ui, EditorState& state);  // inside of the next one
// Sentences about parts of the attempt that cannot be shown.
void Notices(Ui& ui, const FinishedAttempt& attempt);
void DebriefSide(Ui& ui, EditorState& state, const Area& area);
void DebriefPlots(Ui& ui, EditorState& state, const Area& area);

}  // namespace arthro::app
