// The board's large picture while tie points are clicked or masks are painted.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <imgui.h>

#include "app/state/command.h"
#include "app/steps/panorama/board/panorama_run.h"
#include "app/steps/panorama/footage_work.h"
#include "app/steps/panorama/pages/footage_panels.h"
#include "app/steps/panorama/pages/shown_picture.h"
#include "authoring/panorama/ties/clicked_tie.h"

namespace arthro::app {
namespace {

SharedPicture FrameOf(const FootageBoard& board) {
  if (board.large.frame == board.selected && board.large.raw) return board.large.raw;
  return board.thumbs.at(static_cast<std::size_t>(board.selected));
}

// Frame on the left, panorama on the right.
void TiePicture(Ui& ui, EditorState& state, const Area& area, const TextureOf& texture) {
  FootageBoard& board = *state.steps.panorama->footage;
  ShownPicture frame{FrameOf(board), area, {board.width, board.height}};
  ShownPicture panorama{
      board.made->shown, area, {board.made->picture->width, board.made->picture->height}};
  frame.area.width = panorama.area.width = std::floor(0.5f * (area.width - ui.Px(4)));
  panorama.area.x = area.x + area.width - panorama.area.width;

  const bool hits_frame = HitPart(ui, "Frame to tie", frame.area);
  if (hits_frame)
    if (const auto pixel = frame.UnderPointer()) board.picked = pixel;
  const bool hits_panorama = HitPart(ui, "Panorama to tie to", panorama.area);
  frame.Draw(texture);
  panorama.Draw(texture);
  int number = 0;
  for (const authoring::FrameTie& tie : board.ties) {
    if (tie.frame != board.selected) continue;
    const std::string words = fmt::format("{}", ++number);
    MarkPoint(ui, frame.OnScreen(tie.pixel), words);
    const auto other = tie.other ? PanoramaPixelOf(board.made->report, *tie.other)
                                 : std::optional(tie.panorama->pixel);
    if (other) MarkPoint(ui, panorama.OnScreen(ShownPixel(*board.made, *other)), words);
  }
  if (board.picked) MarkPoint(ui, frame.OnScreen(*board.picked), fmt::format("{}", number + 1));
  HintOver(ui, frame.area, fmt::format("Frame {}: click a point", board.selected));
  HintOver(
      ui, panorama.area,
      board.picked ? "Click the same point here" : "Panorama: click a point of the frame first");
  if (!hits_panorama || !board.picked) return;
  if (const auto pixel = panorama.UnderPointer())
    Guarded(state, "Tie a frame", [&] {
      AddTie(state, *board.picked, *pixel);
      board.picked.reset();
    });
}

void MaskPicture(Ui& ui, EditorState& state, const Area& area, const TextureOf& texture) {
  FootageBoard& board = *state.steps.panorama->footage;
  const ShownPicture frame{FrameOf(board), area, {board.width, board.height}};
  HitPart(ui, "Frame to mask", area);
  const bool is_active = ImGui::IsItemActive(), is_let_go = ImGui::IsItemDeactivated();
  frame.Draw(texture);
  for (const authoring::PixelBox& box : board.masked)
    MarkBox(ui, frame, {box.x, box.y}, {box.x + box.width - 1, box.y + box.height - 1}, true);
  HintOver(ui, area, "Drag a rectangle over what is no tissue");
  const auto pixel = frame.UnderPointer();
  if (is_active && !board.picked && pixel) board.picked = pixel;
  if (!board.picked || !pixel) return;
  if (is_active) MarkBox(ui, frame, *board.picked, *pixel, true);
  if (!is_let_go) return;
  AddMask(state, *board.picked, *pixel);
  board.picked.reset();
}

}  // namespace

bool ShowsMendPicture(const FootageBoard& board) {
  if (board.selected < 0 || board.tool == BoardTool::kLook || !FrameOf(board)) return false;
  return board.tool == BoardTool::kMask || (board.made && board.made->picture &&
                                            board.made->shown && !board.made->report.over_relief);
}

void MendPicture(Ui& ui, EditorState& state, const Area& area, const TextureOf& texture) {
  if (state.steps.panorama->footage->tool == BoardTool::kTie)
    TiePicture(ui, state, area, texture);
  else
    MaskPicture(ui, state, area, texture);
}

}  // namespace arthro::app
