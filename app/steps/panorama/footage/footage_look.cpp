// Selection of a frame, and messages of the jobs.
#include <algorithm>
#include <utility>

#include <opencv2/core.hpp>

#include "app/state/command.h"
#include "app/steps/panorama/board/board_picture.h"
#include "app/steps/panorama/board/footage_mail.h"
#include "app/steps/panorama/board/panorama_run.h"
#include "app/steps/panorama/footage_work.h"
#include "authoring/footage/footage.h"
#include "authoring/lens/rectifier.h"

namespace arthro::app {
namespace {

// News of a frame that nobody counted yet: containers lie about their length.
void MakeRoom(FootageBoard& board, int frame) {
  if (frame < board.frames()) return;
  board.thumbs.resize(static_cast<std::size_t>(frame) + 1);
  board.notes.resize(board.thumbs.size());
}

}  // namespace

void TakeFootageMail(EditorState& state) {
  if (!state.steps.panorama->footage_job.mail) return;
  FootageNews news = state.steps.panorama->footage_job.mail->Take();
  if (news.clip) BeginBoard(state, *news.clip);
  if (!state.steps.panorama->footage) return;
  FootageBoard& board = *state.steps.panorama->footage;
  for (auto& [frame, thumb] : news.thumbs) {
    if (frame < 0) continue;
    MakeRoom(board, frame);
    auto& place = board.thumbs[static_cast<std::size_t>(frame)];
    if (!place) place = std::move(thumb);
  }
  for (auto& [frame, note] : news.notes) {
    if (frame < 0) continue;
    MakeRoom(board, frame);
    board.notes[static_cast<std::size_t>(frame)] = std::move(note);
  }
  if (news.circle) {
    FitPresets(board.lenses, board.width, board.height, *news.circle);
    if (!board.lenses.at(static_cast<std::size_t>(board.lens)).problem.empty()) board.lens = 0;
    board.large = {};
    NoteNextRun(board);
  }
  if (news.motion) board.motion = std::move(news.motion);
  if (news.mosaic) board.mosaic = std::move(news.mosaic);
}

namespace {

// The frame at full size, as it was filmed and without the lens's bend.
void ReadFrame(const authoring::PanoramaRequest& request, LargeFrame& large,
               const Progress& progress) {
  authoring::Footage footage = authoring::Footage::Open(ClipsOf(request));
  for (int i = 0; i < large.frame; ++i) {
    progress.Step("frame", 0);
    if (!footage.Skip()) return;
  }
  cv::Mat raw, rectified;
  if (!footage.Next(raw)) return;
  if (raw.empty()) throw Error(Code::kBadImage, footage.fault());
  large.raw = PictureFromMat(raw, kBoardEdge);
  if (!request.lens) return;
  authoring::Rectifier(*request.lens, request.options.rectify).Rectify(raw, rectified);
  large.rectified = PictureFromMat(rectified, kBoardEdge);
}

// Fetches the frame with even light if the run got that far; not while a run holds the session.
void FetchEvenLight(LentSession* session, LargeFrame& large) {
  if (session == nullptr) return;
  const std::unique_lock lock(session->mutex, std::try_to_lock);
  if (!lock) return;
  if (const auto even = session->session.PictureOf(large.frame, authoring::FrameStage::kEvenLight))
    large.even_light = std::make_shared<const ColourImage>(*even);
}

// Has the selected frame read, the newest wish first.
void ReadLarge(EditorState& state) {
  FootageBoard& board = *state.steps.panorama->footage;
  if (board.selected < 0 || board.large.frame == board.selected) return;
  if (state.steps.panorama->frame_jobs.busy()) {  // with one that is not wanted any more
    board.large = {};
    return state.steps.panorama->frame_jobs.Stop();
  }
  board.large = {};
  board.large.frame = board.selected;
  state.steps.panorama->frame_jobs.Start(
      "Frame", [session = board.session, request = RequestOf(board), frame = board.selected,
                lens = board.lens](const Progress& progress) {
        LargeFrame large;
        large.frame = frame;
        try {
          FetchEvenLight(session.get(), large);
          ReadFrame(request, large, progress);
        } catch (const Error& error) {
          if (error.code() == Code::kCancelled) return Jobs::Apply();
          large.problem = error.sentence();
        }
        return Jobs::Apply([large, lens, file = request.footage](EditorState& now) {
          const bool same_clip =
              now.steps.panorama->footage && now.steps.panorama->footage->file == file;
          // Another frame or lens may be wanted by now; then it is read next.
          if (same_clip && now.steps.panorama->footage->large.frame == large.frame &&
              now.steps.panorama->footage->lens == lens)
            now.steps.panorama->footage->large = large;
        });
      });
}

}  // namespace

bool ShowsFootage(const EditorState& state) {
  return state.steps.panorama->footage && state.steps.panorama->shows_footage &&
         state.step == Step::kPanorama && !state.practice && !state.practice_only;
}

void SelectFrame(EditorState& state, int frame) {
  if (!state.steps.panorama->footage) return;
  state.steps.panorama->footage->selected =
      std::clamp(frame, -1, state.steps.panorama->footage->frames() - 1);
  state.steps.panorama->footage->scroll_to_selected = true;
  state.steps.panorama->footage->picked.reset();  // it was a point of another frame
}

void StepFrame(EditorState& state, int by) {
  if (!state.steps.panorama->footage) return;
  const int from = state.steps.panorama->footage->selected;
  SelectFrame(state, from < 0 ? (by > 0 ? 0 : state.steps.panorama->footage->frames() - 1)
                              : std::max(0, from + by));
}

void SetFrameView(EditorState& state, FrameView view) {
  if (state.steps.panorama->footage) state.steps.panorama->footage->view = view;
}

bool FinishFootage(EditorState& state) {
  bool changed = false;
  KeepBoardOfScene(state);
  TakeFootageMail(state);
  if (state.steps.panorama->footage_job.mail && !state.jobs.busy()) {
    state.steps.panorama->footage_job = {};
    changed = true;
  }
  if (state.steps.panorama->frame_jobs.busy()) {
    Guarded(state, "Frame", [&] { state.steps.panorama->frame_jobs.Finish(state); });
    const bool has_ended = !state.steps.panorama->frame_jobs.busy();
    // It had the session for a moment, in which nobody else could ask it.
    if (has_ended && state.steps.panorama->footage && !FootageIsUnderWay(state))
      NoteNextRun(*state.steps.panorama->footage);
    changed = changed || has_ended;
  }
  if (auto& footage = state.steps.panorama->footage;
      footage && footage->view_angle != state.document().scene.scope.view_angle) {
    footage->view_angle = state.document().scene.scope.view_angle;
    if (!FootageIsUnderWay(state)) NoteNextRun(*footage);
  }
  if (ShowsFootage(state) && state.steps.panorama->footage->wants_thumbs && !state.jobs.busy())
    ReadFootageAgain(state);
  if (ShowsFootage(state) && !state.steps.panorama->footage->file.empty()) ReadLarge(state);
  return changed;
}

}  // namespace arthro::app
