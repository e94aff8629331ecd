// The part of the footage page about mending by hand: tie points of the selected frame, and masks.
#include <fmt/format.h>
#include <imgui.h>

#include "app/state/command.h"
#include "app/steps/panorama/board/panorama_run.h"
#include "app/steps/panorama/footage_work.h"
#include "app/steps/panorama/pages/footage_panels.h"

namespace arthro::app {
namespace {

void TieFields(Ui& ui, EditorState& state) {
  FootageBoard& board = *state.steps.panorama->footage;
  Heading(ui, "Tie points");
  const FrameStatus status =
      board.selected < 0 ? FrameStatus::kPlaced : StatusOf(board, board.selected);
  bool has_ties = false;
  for (const authoring::FrameTie& tie : board.ties)
    has_ties = has_ties || tie.frame == board.selected;
  const bool is_loose = board.made && board.selected >= 0 &&
                        (status == FrameStatus::kRejected || status == FrameStatus::kSeparate);
  if (!is_loose && !has_ties) {
    QuietText(ui, "A frame that was not placed can be tied in by hand: select it below.");
  } else {
    if (ToggleButton(ui, "Tie this frame", board.tool == BoardTool::kTie, true, {-FLT_MIN, 0},
                     "Click a point of the frame on the left, then the same point of the panorama "
                     "on the right; two pairs or more."))
      SetTool(state, BoardTool::kTie);
  }
  // Pairs are numbered in each frame, as messages name them.
  int number = 0;
  for (std::size_t i = 0; i < board.ties.size(); ++i) {
    const authoring::FrameTie& tie = board.ties[i];
    if (tie.frame != board.selected) continue;
    ImGui::AlignTextToFramePadding();
    const std::string other = tie.other ? fmt::format("frame {} ({:.0f}, {:.0f})", tie.other->frame,
                                                      tie.other->pixel.x, tie.other->pixel.y)
                                        : fmt::format("panorama ({:.0f}, {:.0f})",
                                                      tie.panorama->pixel.x, tie.panorama->pixel.y);
    QuietText(ui, fmt::format("Pair {}: ({:.0f}, {:.0f}) – {}", ++number, tie.pixel.x, tie.pixel.y,
                              other));
    if (Button(ui, fmt::format("Remove pair {}", number), true)) return RemoveTie(state, i);
  }
  if (number == 1) QuietText(ui, "One more pair is needed.");
}

void MaskFields(Ui& ui, EditorState& state) {
  FootageBoard& board = *state.steps.panorama->footage;
  Heading(ui, "Text in the picture");
  const float half = 0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
  if (ToggleButton(
          ui, "Mask by hand", board.tool == BoardTool::kMask, board.selected >= 0, {half, 0},
          "Drag a rectangle over text or a logo of the frame: no frame is matched or drawn "
          "there."))
    SetTool(state, BoardTool::kMask);
  ImGui::SameLine();
  if (Button(ui, "Mask proposals", CanProposeMasks(state), {half, 0},
             "Mask the areas that never changed in the last run while the picture moved."))
    ProposeMasks(state);
  for (std::size_t i = 0; i < board.masked.size(); ++i) {
    const authoring::PixelBox& box = board.masked[i];
    if (Button(ui, fmt::format("Remove mask {}", i + 1), true, {half, 0}))
      return RemoveMask(state, i);
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    QuietText(ui, fmt::format("{} × {} px at ({}, {})", box.width, box.height, box.x, box.y));
  }
}

}  // namespace

void MendFields(Ui& ui, EditorState& state) {
  Gap(ui, 2);
  TieFields(ui, state);
  Gap(ui, 1);
  MaskFields(ui, state);
}

}  // namespace arthro::app
