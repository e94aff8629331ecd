// Mending a panorama by hand: pairs of points for frames that did not register, and rectangles that
// show no tissue.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/steps/panorama/board/panorama_run.h"
#include "app/steps/panorama/footage_work.h"
#include "authoring/panorama/ties/clicked_tie.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

FootageBoard* OpenFootage(EditorState& state) {
  auto& footage = state.steps.panorama->footage;
  return footage ? &*footage : nullptr;
}

// The pixel of the panorama that the report describes, for one of the picture that the board shows.
glm::dvec2 InReport(const MadePanorama& made, glm::dvec2 pixel) {
  if (!made.record) return pixel;
  if (made.record->is_mirrored) pixel.x = made.picture->width - 1 - pixel.x;
  if (made.record->crop) pixel += glm::dvec2(made.record->crop->x, made.record->crop->y);
  return pixel;
}

}  // namespace

glm::dvec2 ShownPixel(const MadePanorama& made, glm::dvec2 in_report) {
  if (!made.record) return in_report;
  if (made.record->crop) in_report -= glm::dvec2(made.record->crop->x, made.record->crop->y);
  if (made.record->is_mirrored) in_report.x = made.picture->width - 1 - in_report.x;
  return in_report;
}

void SetTool(EditorState& state, BoardTool tool) {
  FootageBoard* board = OpenFootage(state);
  if (!board) return;
  board->tool = board->tool == tool ? BoardTool::kLook : tool;
  board->picked.reset();
  if (board->tool != BoardTool::kLook) board->view = FrameView::kRaw;
}

void AddTie(EditorState& state, const glm::dvec2& raw, const glm::dvec2& panorama) {
  FootageBoard* board = OpenFootage(state);
  if (!board || !board->made || board->selected < 0) return;
  const auto other = FrameAt(board->made->report, InReport(*board->made, panorama));
  if (!other)
    throw Error(Code::kBadArgument,
                "no frame of the panorama shows that place; choose a point of the tissue");
  authoring::FrameTie tie;
  tie.frame = board->selected;
  tie.pixel = raw;
  tie.other = other;
  board->ties.push_back(tie);
  KeepChoices(state, fmt::format("Tie a point of frame {}", tie.frame));
  NoteNextRun(*board);
  state.message = fmt::format("A point of frame {} is tied to frame {}.", tie.frame, other->frame);
}

void RemoveTie(EditorState& state, std::size_t tie) {
  FootageBoard* board = OpenFootage(state);
  if (!board || tie >= board->ties.size()) return;
  board->ties.erase(board->ties.begin() + static_cast<std::ptrdiff_t>(tie));
  KeepChoices(state, "Remove a tie point");
  NoteNextRun(*board);
}

void AddMask(EditorState& state, const glm::dvec2& corner, const glm::dvec2& opposite) {
  FootageBoard* board = OpenFootage(state);
  if (!board) return;
  const auto pixel = [](double value, int size) {
    return std::clamp(static_cast<int>(std::lround(value)), 0, size - 1);
  };
  const int left = pixel(std::min(corner.x, opposite.x), board->width),
            right = pixel(std::max(corner.x, opposite.x), board->width),
            top = pixel(std::min(corner.y, opposite.y), board->height),
            bottom = pixel(std::max(corner.y, opposite.y), board->height);
  constexpr int kLeast = 2;  // px; a mere click is no rectangle
  if (right - left < kLeast || bottom - top < kLeast) return;
  board->masked.push_back({left, top, right - left + 1, bottom - top + 1});
  KeepChoices(state, "Mask a rectangle");
  NoteNextRun(*board);
}

void RemoveMask(EditorState& state, std::size_t mask) {
  FootageBoard* board = OpenFootage(state);
  if (!board || mask >= board->masked.size()) return;
  board->masked.erase(board->masked.begin() + static_cast<std::ptrdiff_t>(mask));
  KeepChoices(state, "Remove a mask");
  NoteNextRun(*board);
}

bool CanProposeMasks(const EditorState& state) {
  const auto& board = state.steps.panorama->footage;
  return board && board->made && !board->made->report.text_boxes.empty();
}

void ProposeMasks(EditorState& state) {
  if (!CanProposeMasks(state)) return;
  FootageBoard& board = *OpenFootage(state);
  int added = 0;
  for (const authoring::PixelBox& box : board.made->report.text_boxes)
    if (std::find(board.masked.begin(), board.masked.end(), box) == board.masked.end()) {
      board.masked.push_back(box);
      ++added;
    }
  if (added == 0) return;
  KeepChoices(state, "Mask what never changes");
  NoteNextRun(board);
}

}  // namespace arthro::app
