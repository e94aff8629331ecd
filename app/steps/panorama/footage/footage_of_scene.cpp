// The clip of a scene that was opened: its frames, the choice among them and the report, from the
// record in the document.
#include <algorithm>
#include <memory>
#include <utility>

#include "app/state/edits.h"
#include "app/steps/panorama/board/board_picture.h"
#include "app/steps/panorama/board/panorama_run.h"
#include "app/steps/panorama/footage_work.h"
#include "authoring/panorama/report_io.h"
#include "simulation/core/option_fields.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;
using authoring::FootageRecord;

void TakeChoices(FootageBoard& board, const std::shared_ptr<const FootageRecord>& record) {
  board.record = record;
  board.excluded.clear();
  for (const double frame : record->left_out) board.excluded.insert(static_cast<int>(frame));
  board.ties = record->ties;
  board.masked = record->masked;
}

// The lens that the panorama was made with, chosen.
void TakeLens(FootageBoard& board, const authoring::PanoramaReport& report) {
  FitPresets(board.lenses, board.width, board.height, report.lens.circle);
  if (report.is_lens_guessed) return;
  board.lenses.push_back(
      {"that of this panorama", "The lens that the scene's panorama was made with.", report.lens});
  board.lens = static_cast<int>(board.lenses.size()) - 1;
}

// Places of the clips now; the sentence about the first that is gone.
void TakePlaces(FootageBoard& board, const FootageRecord& record, const fs::path& scene) {
  for (std::size_t i = 0; i < record.clips.size(); ++i) {
    const fs::path file = FindClip(record.clips[i], scene);
    (i == 0 ? board.file : board.joined.emplace_back()) = file;
    if (file.empty() && board.missing.empty()) board.missing = WordsOfMissingClip(record.clips[i]);
  }
}

FootageBoard BoardOf(const EditorState& state, const std::shared_ptr<const FootageRecord>& record,
                     const authoring::PanoramaReport& report) {
  FootageBoard board;
  board.options.emplace();
  board.lenses = LensChoices(state.steps.panorama->lens_folder);
  for (const authoring::ClipFile& clip : record->clips)
    board.name += (board.name.empty() ? "" : " + ") + clip.name;
  board.width = report.lens.width;
  board.height = report.lens.height;
  board.thumbs.resize(std::max<std::size_t>(1, report.frames.size()));
  board.notes.resize(board.thumbs.size());
  TakeLens(board, report);
  TakePlaces(board, *record, state.document().folder);
  TakeChoices(board, record);
  // Options of another version are no reason not to show the frames.
  try {
    ReadOptionsText(report.options, {}, *board.options);
  } catch (const Error&) {
    board.options.emplace();
  }
  board.measures_relief = report.over_relief.has_value();
  board.view_angle = state.document().scene.scope.view_angle;
  board.wants_thumbs = board.missing.empty();

  auto made = std::make_shared<MadePanorama>();
  made->picture = state.document().panorama;
  made->shown = PictureFromColour(OrEmpty(state.document().panorama), kBoardEdge);
  made->projection = state.document().scene.backdrop.projection;
  made->report = report;
  made->excluded = board.excluded;
  made->record = record;
  board.made = made;
  ShowMade(board);
  board.wants_focus = false;
  return board;
}

}  // namespace

void KeepBoardOfScene(EditorState& state) {
  PanoramaStep& step = *state.steps.panorama;
  if (FootageIsUnderWay(state)) return;
  if (step.document_number != state.document_number) {
    step.document_number = state.document_number;
    step.footage.reset();
    step.shows_footage = false;
    step.seen.reset();
  }
  const auto& record = state.document().footage;
  if (record == step.seen) return;
  step.seen = record;
  if (!record || (step.footage && step.footage->record == record)) return;
  if (step.footage && step.footage->record && step.footage->record->clips == record->clips) {
    TakeChoices(*step.footage, record);  // undo and redo
    NoteNextRun(*step.footage);
    return;
  }
  // A clip that was opened since stays on the board.
  if (step.footage && !step.footage->record) return;
  try {
    step.footage = BoardOf(state, record, authoring::ReportFromJson(record->report));
  } catch (const Error& error) {
    state.message = "The report of the panorama cannot be shown: " + error.sentence();
  }
}

void KeepChoices(EditorState& state, const std::string& name) {
  FootageBoard& board = *state.steps.panorama->footage;
  if (!board.record || board.record != state.document().footage) return;
  FootageRecord record = *board.record;
  record.left_out.assign(board.excluded.begin(), board.excluded.end());
  record.ties = board.ties;
  record.masked = board.masked;
  board.record = state.steps.panorama->seen = Share(std::move(record));
  Edit(state, name, "", [&](auto& next) { next.footage = board.record; });
}

}  // namespace arthro::app
