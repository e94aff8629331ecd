// The run: footage to panorama beside the window, and its result as the backdrop.
#include <exception>

#include <opencv2/core.hpp>

#include "app/state/command.h"
#include "app/state/edits.h"
#include "app/state/footage/footage_source.h"
#include "app/state/footage/measured_backdrop.h"
#include "app/state/measured_depth.h"
#include "app/steps/panorama/board/board_picture.h"
#include "app/steps/panorama/board/footage_mail.h"
#include "app/steps/panorama/board/footage_words.h"
#include "app/steps/panorama/board/panorama_run.h"
#include "app/steps/panorama/footage_work.h"

namespace arthro::app {
namespace {

using authoring::FrameReport;

authoring::PanoramaObserver ObserverOf(const std::shared_ptr<FootageMail>& mail,
                                       const std::set<int>& excluded) {
  authoring::PanoramaObserver observer;
  observer.frame = [mail, excluded](const FrameReport& row, const ColourImage& small) {
    mail->PutNote(row.index, NoteOf(row, excluded.contains(row.index)));
    if (!small.empty()) mail->PutThumb(row.index, std::make_shared<const ColourImage>(small));
  };
  observer.mosaic = [mail](const authoring::RgbaPicture& small) {
    mail->PutMosaic(PictureFromRgba(small, kBoardEdge));
  };
  return observer;
}

std::shared_ptr<MadePanorama> MadeOf(authoring::PanoramaResult result,
                                     const std::set<int>& excluded) {
  auto made = std::make_shared<MadePanorama>();
  if (!result.picture.empty())
    made->picture = std::make_shared<const ColourImage>(OnBlack(result.picture));
  made->shown = PictureFromRgba(result.picture, kBoardEdge);
  made->projection = ProjectionOf(result.report.panorama);
  made->report = std::move(result.report);
  made->excluded = excluded;
  return made;
}

// Rows of a measurement as those of a panorama, for the record that a scene keeps.
FrameReport RowOf(const authoring::PosedFrame& frame) {
  FrameReport row;
  row.index = frame.index;
  row.is_placed = frame.is_posed;
  row.is_usable = frame.is_posed || frame.tracks > 0;
  row.component = frame.is_posed ? 0 : -1;
  row.reason = frame.reason;
  row.rms_px = frame.rms_px;
  return row;
}

std::shared_ptr<MadePanorama> MadeFrom(const std::shared_ptr<const MadeRelief>& relief,
                                       const ReliefSettings& settings) {
  auto made = std::make_shared<MadePanorama>();
  made->picture = relief->backdrop.panorama;
  made->shown = relief->shown;
  made->projection = relief->backdrop.projection;
  made->report.lens = settings.lens;
  made->report.warnings = relief->report.warnings;
  made->report.summary = WordsOfRelief(*relief).front();
  made->report.over_relief = relief->backdrop.projection;
  made->report.relief_radius = relief->backdrop.radius;
  made->report.panorama.width = made->picture->width;
  made->report.panorama.height = made->picture->height;
  for (const authoring::PosedFrame& frame : relief->report.frames)
    made->report.frames.push_back(RowOf(frame));
  made->excluded = settings.excluded;
  made->relief = relief;
  return made;
}

std::shared_ptr<MadePanorama> WithRecord(std::shared_ptr<MadePanorama> made,
                                         const authoring::PanoramaRequest& request) {
  made->record = Share(RecordOf(request, made->report));
  return made;
}

// A frame may just be fetched from the session; that takes a moment, and Stop must not wait for it.
std::unique_lock<std::timed_mutex> Borrow(LentSession& session, const Progress& progress) {
  std::unique_lock lock(session.mutex, std::defer_lock);
  while (!lock.try_lock_for(std::chrono::milliseconds(50))) progress.Step("wait", 0);
  return lock;
}

}  // namespace

PanoramaStep::PanoramaStep(std::function<void()> wake) : frame_jobs(std::move(wake)) {
  makers.emplace();
}

authoring::PanoramaRequest RequestOf(const FootageBoard& board) {
  authoring::PanoramaRequest request;
  request.footage = board.file;
  const auto lens = static_cast<std::size_t>(board.lens);
  if (lens < board.lenses.size()) request.lens = board.lenses[lens].lens;
  request.options = *board.options;
  request.excluded = board.excluded;
  request.joined = board.joined;
  request.masked = board.masked;
  request.ties = board.ties;
  return request;
}

void NoteNextRun(FootageBoard& board) {
  if (!board.session) return;
  // Not while a run or a reader has it: their end asks again.
  const std::unique_lock lock(board.session->mutex, std::try_to_lock);
  if (!lock) return;
  const bool shows_measured = board.made && board.made->is_measured();
  if (const auto settings = ReliefSettingsOf(board)) {
    const bool is_known = board.session->relief && board.session->relief_settings == settings;
    if (!is_known || board.session->relief->is_measured()) {
      board.next_stage = !is_known ? "measure" : shows_measured ? "" : "compose";
      return;
    }
  }
  board.next_stage = board.session->session.NextStage(RequestOf(board));
  if (board.next_stage.empty() && shows_measured) board.next_stage = "compose";
}

void SetMeasuresRelief(EditorState& state, bool measures) {
  if (!state.steps.panorama->footage) return;
  state.steps.panorama->footage->measures_relief = measures;
  NoteNextRun(*state.steps.panorama->footage);
}

bool CanRun(const EditorState& state) {
  const auto& board = state.steps.panorama->footage;
  if (!board || !board->missing.empty() || state.jobs.busy() || state.practice) return false;
  // The panorama of a reopened scene was made in another session.
  return !board->made || !board->session || !board->next_stage.empty();
}

bool FootageIsUnderWay(const EditorState& state) {
  return state.steps.panorama->footage_job.mail != nullptr && state.jobs.busy();
}

void RunFootage(EditorState& state) {
  if (!CanRun(state)) return;
  FootageBoard& board = *state.steps.panorama->footage;
  if (!board.session) board.session = std::make_shared<LentSession>();
  board.motion.reset();
  board.mosaic.reset();
  auto mail = std::make_shared<FootageMail>();
  state.jobs.Start(
      "Panorama of " + board.name,
      [mail, makers = *state.steps.panorama->makers, session = board.session,
       settings = ReliefSettingsOf(board), request = RequestOf(board)](const Progress& progress) {
        std::shared_ptr<const MadePanorama> made;
        std::exception_ptr fault;
        try {
          const auto lock = Borrow(*session, progress);
          std::shared_ptr<const MadeRelief> relief;
          if (settings)
            relief =
                MeasureOnce(*session, makers.relief, request.footage, *settings, mail, progress);
          if (relief && relief->is_measured()) {
            made = WithRecord(MadeFrom(relief, *settings), request);
          } else {
            // The clip does not determine depth: frames are placed on a plane, as without a lens.
            const auto placed = MadeOf(
                makers.run(session->session, request, ObserverOf(mail, request.excluded), progress),
                request.excluded);
            placed->relief = relief;
            made = WithRecord(placed, request);
          }
        } catch (const cv::Exception& error) {
          // Not said by us, so hardly fit to be shown; but it must not take the window with it.
          fault = std::make_exception_ptr(
              Error(Code::kBadData, "this clip could not be worked on (" + error.err + ")"));
        } catch (...) {
          fault = std::current_exception();
        }
        return [made, fault, session](EditorState& now) {
          TakeFootageMail(now);
          if (!now.steps.panorama->footage || now.steps.panorama->footage->session != session)
            return;
          FootageBoard& of_run = *now.steps.panorama->footage;
          if (made) of_run.made = made;
          of_run.large = {};  // even light may be another one
          NoteNextRun(of_run);
          ShowMade(of_run);
          if (fault) std::rethrow_exception(fault);
          now.message = WordsOfResult(of_run).front();
        };
      });
  board.selected = -1;
  board.wants_focus = true;
  state.steps.panorama->footage_job = {std::move(mail), true};
}

void ShowMade(FootageBoard& board) {
  board.notes.assign(board.thumbs.size(), {});
  board.mosaic = board.made ? board.made->shown : nullptr;
  if (!board.made) return;
  if (board.made->is_measured())
    for (const auto& frame : board.made->relief->report.frames)
      if (frame.index >= 0 && frame.index < board.frames())
        board.notes[static_cast<std::size_t>(frame.index)] =
            NoteOf(frame, board.made->excluded.contains(frame.index));
  if (board.made->is_measured()) return;  // the report has the same frames without their poses
  for (const FrameReport& row : board.made->report.frames)
    if (row.index >= 0 && row.index < board.frames())
      board.notes[static_cast<std::size_t>(row.index)] =
          NoteOf(row, board.made->excluded.contains(row.index));
}

namespace {

// The record of the board's panorama, in the step that has just made that the backdrop.
void AmendRecord(EditorState& state) {
  FootageBoard& board = *state.steps.panorama->footage;
  authoring::Document document = state.document();
  PutFootage(document, board.made->record);
  board.record = state.steps.panorama->seen = board.made->record;
  state.history.Amend(std::move(document));
}

// The picture, its relief, and what is known of it, as the backdrop.
void UseRelief(EditorState& state, const MadeRelief& relief) {
  const FootageBoard& board = *state.steps.panorama->footage;
  const bool is_backdrop = state.document().panorama == relief.backdrop.panorama;
  if (!is_backdrop) {
    SetMeasuredPanorama(state, "Use the measured relief of " + board.name, relief.backdrop,
                        board.lenses.at(static_cast<std::size_t>(board.lens)).lens);
    AmendRecord(state);
  }
  Run(state, "depth-map");
}

}  // namespace

bool HasMeasuredPart(const EditorState& state) {
  const auto& footage = state.steps.panorama->footage;
  return footage && footage->made && footage->made->relief && footage->made->relief->is_partial();
}

void UseMeasuredPart(EditorState& state) {
  if (HasMeasuredPart(state) && !state.jobs.busy())
    UseRelief(state, *state.steps.panorama->footage->made->relief);
}

void UseMadePanorama(EditorState& state) {
  if (!state.steps.panorama->footage || !state.steps.panorama->footage->made || state.jobs.busy())
    return;
  const MadePanorama& made = *state.steps.panorama->footage->made;
  if (made.is_measured()) return UseRelief(state, *made.relief);
  state.step = Step::kDepth;
  if (state.document().panorama == made.picture) return;  // it is the backdrop already
  const std::string& clip = state.steps.panorama->footage->name;
  SetPanorama(state, "Use the panorama of " + clip, made.picture, made.projection, made.report.lens,
              made.report.is_lens_guessed);
  state.message = "The panorama of " + clip + " is the backdrop now.";
  AmendRecord(state);
}

}  // namespace arthro::app
