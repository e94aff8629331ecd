#include "app/steps/panorama/board/footage_words.h"

#include <algorithm>

#include <fmt/format.h>

#include "app/state/capital.h"
#include "app/steps/panorama/board/panorama_run.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

std::string Frames(int count) { return count == 1 ? "1 frame" : fmt::format("{} frames", count); }

}  // namespace

FrameNote NoteOf(const authoring::FrameReport& report, bool is_excluded) {
  FrameNote note{FrameStatus::kNotYet, report.reason, report.rms_px, report.expected_error_px};
  if (is_excluded)
    note.status = FrameStatus::kExcluded;
  else if (report.is_placed)
    note.status = FrameStatus::kPlaced;
  else if (report.component > 0)
    note.status = FrameStatus::kSeparate;
  else if (!report.reason.empty())  // none yet while the clip is read
    note.status = report.is_usable ? FrameStatus::kRejected : FrameStatus::kUnused;
  return note;
}

FrameStatus StatusOf(const FootageBoard& board, int frame) {
  if (board.excluded.contains(frame)) return FrameStatus::kExcluded;
  const auto at = static_cast<std::size_t>(frame);
  if (at >= board.notes.size()) return FrameStatus::kNotYet;
  // Left out in the last run, taken in again since: the next run will say.
  const FrameStatus status = board.notes[at].status;
  return status == FrameStatus::kExcluded ? FrameStatus::kNotYet : status;
}

std::string WordsOfClip(const FootageBoard& board) {
  std::string words =
      fmt::format("{} · {} × {} px", Frames(board.frames()), board.width, board.height);
  if (board.frames_per_second > 0)
    words += fmt::format(" · {:.3g} per second", board.frames_per_second);
  return words;
}

std::string WordsOfFrame(const FootageBoard& board, int frame) {
  const auto at = static_cast<std::size_t>(frame);
  const FrameNote note = at < board.notes.size() ? board.notes[at] : FrameNote{};
  const std::string why = note.reason.empty() ? "" : ": " + note.reason;
  switch (StatusOf(board, frame)) {
    case FrameStatus::kPlaced:
      if (note.pose_sigma > 0)
        return fmt::format("Its camera pose was found to ±{:.2f} mm; its points fit to {:.1f} px",
                           MmFromMetres(note.pose_sigma), note.rms_px);
      return fmt::format("Placed; fits to {:.1f} px, expected error {:.1f} px", note.rms_px,
                         note.expected_error_px);
    case FrameStatus::kRejected:
      return "Not placed" + why;
    case FrameStatus::kSeparate:
      return "In a separate piece" + why;
    case FrameStatus::kUnused:
      return "Not used" + why;
    case FrameStatus::kExcluded:
      return "Left out by you";
    case FrameStatus::kNotYet:
      break;
  }
  return "Not looked at yet";
}

std::vector<std::string> WordsOfResult(const FootageBoard& board) {
  if (!board.made) return {};
  if (board.made->is_measured()) return WordsOfRelief(*board.made->relief);
  const authoring::PanoramaReport& report = board.made->report;
  int placed = 0;
  double residual = 0;
  for (const auto& row : report.frames)
    if (row.is_placed) ++placed, residual += row.rms_px;
  if (placed > 0) residual /= placed;
  const int frames = static_cast<int>(report.frames.size());
  std::vector<std::string> lines = {fmt::format("{} of {} placed", placed, Frames(frames))};
  if (placed < frames) lines.push_back(Capital(report.summary) + ".");
  lines.push_back(
      fmt::format("Frames fit to {:.2f} px on average. Expected error: {:.1f} px on average, "
                  "{:.1f} px at most. Drift: {:.1f} px.",
                  residual, report.mean_error_px, report.max_error_px, report.drift_px));
  return lines;
}

std::vector<std::string> WarningsOfResult(const FootageBoard& board) {
  if (!board.made) return {};
  std::vector<std::string> warnings = board.made->report.warnings;
  for (std::string& warning : warnings) warning = Capital(std::move(warning)) + ".";
  return warnings;
}

std::string WordsOfNextRun(const FootageBoard& board) {
  if (!board.session) return "";
  if (board.next_stage.empty()) return board.made ? "Nothing changed since the last run." : "";
  if (board.next_stage == "measure")
    return "The next run measures the relief from the motion of the scope.";
  if (board.next_stage == "register")
    return "The next run begins with placing the frames; earlier stages are kept.";
  if (board.next_stage == "tie")
    return "The next run places the tied frames and draws the panorama; all other places are kept.";
  if (board.next_stage == "compose")
    return "The next run begins with drawing the panorama; earlier stages are kept.";
  return "The next run begins with reading the frames.";
}

std::string WordsOfStage(const std::string& stage) { return Capital(stage); }

Showing ShowingOf(const FootageBoard& board) {
  Showing showing;
  if (board.selected < 0) {
    showing.picture = board.mosaic;
    return showing;
  }
  const auto at = static_cast<std::size_t>(board.selected);
  const bool is_read = board.large.frame == board.selected;
  const LargeFrame none;
  const LargeFrame& large = is_read ? board.large : none;
  switch (board.view) {
    case FrameView::kRaw:
      showing.picture = large.raw;
      break;
    case FrameView::kRectified:
      showing.picture = large.rectified;
      if (board.compares) showing.before = large.raw;
      break;
    case FrameView::kEvenLight:
      showing.picture = large.even_light;
      if (board.compares) showing.before = large.rectified ? large.rectified : large.raw;
      break;
  }
  // Until it is read, and where there is no such step, what there is.
  if (!showing.picture) {
    showing.before = nullptr;
    showing.picture = large.raw ? large.raw : at < board.thumbs.size() ? board.thumbs[at] : nullptr;
    showing.is_stand_in = true;
  }
  return showing;
}

}  // namespace arthro::app
