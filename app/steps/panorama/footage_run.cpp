// The run: footage to panorama beside the window, and its result as the backdrop.
#include <exception>

#include <opencv2/core.hpp>

#include "app/state/edits.h"
#include "app/steps/panorama/board_picture.h"
#include "app/steps/panorama/footage_mail.h"
#include "app/steps/panorama/footage_words.h"
#include "app/steps/panorama/footage_work.h"
#include "app/steps/panorama/panorama_run.h"

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

std::shared_ptr<const MadePanorama> MadeOf(authoring::PanoramaResult result,
                                           const std::set<int>& excluded) {
  auto made = std::make_shared<MadePanorama>();
  made->picture = PictureFromRgba(result.picture);
  made->shown = PictureFromRgba(result.picture, kBoardEdge);
  const auto& view = result.report.panorama;
  made->projection.type = ProjectionType::kGnomonic;
  made->projection.focal_px = view.focal_px;
  made->projection.centre_px = {view.cx, view.cy};
  made->report = std::move(result.report);
  made->excluded = excluded;
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
  return request;
}

void NoteNextRun(FootageBoard& board) {
  if (!board.session) return;
  // Not while a run or a reader has it: their end asks again.
  const std::unique_lock lock(board.session->mutex, std::try_to_lock);
  if (lock) board.next_stage = board.session->session.NextStage(RequestOf(board));
}

bool CanRun(const EditorState& state) {
  return state.steps.panorama->footage && !state.jobs.busy() && !state.practice &&
         (!state.steps.panorama->footage->made ||
          !state.steps.panorama->footage->next_stage.empty());
}

bool FootageIsUnderWay(const EditorState& state) {
  return state.steps.panorama->footage_job.mail != nullptr && state.jobs.busy();
}

void RunFootage(EditorState& state) {
  if (!CanRun(state)) return;
  FootageBoard& board = *state.steps.panorama->footage;
  if (!board.session) board.session = std::make_shared<LentSession>();
  auto mail = std::make_shared<FootageMail>();
  state.jobs.Start("Panorama of " + board.name, [mail, run = state.steps.panorama->makers->run,
                                                 session = board.session,
                                                 request =
                                                     RequestOf(board)](const Progress& progress) {
    std::shared_ptr<const MadePanorama> made;
    std::exception_ptr fault;
    try {
      const auto lock = Borrow(*session, progress);
      made = MadeOf(run(session->session, request, ObserverOf(mail, request.excluded), progress),
                    request.excluded);
    } catch (const cv::Exception& error) {
      // Not said by us, so hardly fit to be shown; but it must not take the window with it.
      fault = std::make_exception_ptr(
          Error(Code::kBadData, "this clip could not be worked on (" + error.err + ")"));
    } catch (...) {
      fault = std::current_exception();
    }
    return [made, fault, session](EditorState& now) {
      TakeFootageMail(now);
      if (!now.steps.panorama->footage || now.steps.panorama->footage->session != session) return;
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
  for (const FrameReport& row : board.made->report.frames)
    if (row.index >= 0 && row.index < board.frames())
      board.notes[static_cast<std::size_t>(row.index)] =
          NoteOf(row, board.made->excluded.contains(row.index));
}

void UseMadePanorama(EditorState& state) {
  if (!state.steps.panorama->footage || !state.steps.panorama->footage->made || state.jobs.busy())
    return;
  const MadePanorama& made = *state.steps.panorama->footage->made;
  state.step = Step::kDepth;
  if (state.document().panorama == made.picture) return;  // it is the backdrop already
  SetPanorama(state, "Use the panorama of " + state.steps.panorama->footage->name, made.picture,
              made.projection, made.report.lens, made.report.is_lens_guessed);
}

}  // namespace arthro::app
