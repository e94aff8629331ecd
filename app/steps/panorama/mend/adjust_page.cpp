// Cropping, scaling, turning and mirroring of the backdrop: its fields, and its picture on the
// board.
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "app/state/command.h"
#include "app/state/edits.h"
#include "app/steps/panorama/adjust_board.h"
#include "app/steps/panorama/pages/shown_picture.h"

namespace arthro::app {
namespace {

const char* HintOf(AdjustTool tool) {
  switch (tool) {
    case AdjustTool::kCrop:
      return "Drag a rectangle over the part to keep";
    case AdjustTool::kLength:
      return "Drag from one end of the known length to the other";
    case AdjustTool::kUp:
      return "Drag towards what is up";
    case AdjustTool::kMedial:
      return "Drag towards the middle of the body";
    case AdjustTool::kNone:
      break;
  }
  return "";
}

void Arrow(Ui& ui, const ImVec2& from, const ImVec2& to, bool has_head) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddLine(from, to, 0xFF000000, ui.Px(5));
  draw->AddLine(from, to, kAccent, ui.Px(2.5));
  const float length = std::hypot(to.x - from.x, to.y - from.y);
  if (!has_head || length < 1) return;
  const ImVec2 along = {(to.x - from.x) / length, (to.y - from.y) / length};
  const float size = ui.Px(12);
  const auto corner = [&](float side) {
    return ImVec2(to.x - size * along.x - side * 0.5f * size * along.y,
                  to.y - size * along.y + side * 0.5f * size * along.x);
  };
  draw->AddTriangleFilled(to, corner(1), corner(-1), kAccent);
}

// Crops or scales by the two points, as a script would say it.
void ApplyByName(EditorState& state) {
  const AdjustBoard board = state.steps.panorama->adjust;  // a copy: the command resets it
  CommandArguments arguments;
  const bool is_crop = board.tool == AdjustTool::kCrop;
  if (!is_crop) arguments.push_back(fmt::format("{:g}", board.millimetres));
  for (const double pixel : {board.from->x, board.from->y, board.to->x, board.to->y})
    arguments.push_back(fmt::format("{}", pixel));
  Run(state, is_crop ? "crop" : "known-length", arguments, is_crop ? "Crop to it" : "Set the size");
}

}  // namespace

void AdjustFields(Ui& ui, EditorState& state) {
  AdjustBoard& board = state.steps.panorama->adjust;
  Gap(ui);
  Heading(ui, "Part, size and orientation");
  const float half = 0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
  const auto tool = [&](const char* words, AdjustTool chosen, const char* help,
                        bool is_enabled = true) {
    if (ToggleButton(ui, words, board.tool == chosen, is_enabled, {half, 0}, help))
      SetAdjustTool(state, chosen);
  };
  tool("Crop", AdjustTool::kCrop, "Keep a rectangle of the panorama and of its depth.");
  ImGui::SameLine();
  tool("Known length", AdjustTool::kLength,
       "Set the size of the scene by two points and a length.");
  tool("This is up", AdjustTool::kUp, "Turn the scene so that an arrow on the panorama points up.");
  ImGui::SameLine();
  const bool has_side = state.document().scene.side != BodySide::kUnknown;
  tool("This is medial", AdjustTool::kMedial,
       has_side ? "Turn the scene so that an arrow points to the middle of the body."
                : "State the side of the knee below first: medial is right in a right knee.",
       has_side);
  if (board.tool == AdjustTool::kLength)
    NumberField(ui, "Length", board.millimetres, 0.1, 0.5, 200, "%.1f mm",
                "Distance between the two points.");
  const bool waits = board.from && board.to &&
                     (board.tool == AdjustTool::kCrop || board.tool == AdjustTool::kLength);
  if (waits && Button(ui, board.tool == AdjustTool::kCrop ? "Crop to it" : "Set the size", true,
                      {-FLT_MIN, 0}))
    ApplyByName(state);

  int side = static_cast<int>(state.document().scene.side);
  if (Combo(ui, "Side", side, {"not stated", "left knee", "right knee"},
            "Side of the body that the scene shows."))
    SetSide(state, static_cast<BodySide>(side));
  CommandButton(ui, state, "mirror-scene", {-FLT_MIN, 0});
}

void AdjustBoardPage(Ui& ui, EditorState& state, const Area& area, const TextureOf& texture) {
  AdjustBoard& board = state.steps.panorama->adjust;
  KeepAdjustPicture(state);
  const FixedWindow window(ui, "board", area, kPictureWindow);
  ImGui::GetWindowDrawList()->AddRectFilled(
      {area.x, area.y}, {area.x + area.width, area.y + area.height}, 0xFF000000);
  const auto& panorama = state.document().panorama;
  if (!board.shown || !panorama) return;
  const ShownPicture shown{board.shown, area, {panorama->width, panorama->height}};
  HitPart(ui, "Panorama to change", area);
  const bool is_active = ImGui::IsItemActive(), is_pressed = ImGui::IsItemActivated(),
             is_let_go = ImGui::IsItemDeactivated();
  const auto pixel = shown.UnderPointer();
  if (is_pressed) {
    board.from = pixel;
    board.to.reset();
  }
  if ((is_active || is_let_go) && board.from && pixel) board.to = pixel;
  shown.Draw(texture);
  if (board.from && board.to) {
    if (board.tool == AdjustTool::kCrop)
      MarkBox(ui, shown, *board.from, *board.to, false);
    else
      Arrow(ui, shown.OnScreen(*board.from), shown.OnScreen(*board.to),
            board.tool != AdjustTool::kLength);
  }
  HintOver(ui, area, HintOf(board.tool));
  const bool is_arrow = board.tool == AdjustTool::kUp || board.tool == AdjustTool::kMedial;
  if (is_let_go && is_arrow) Guarded(state, "Turn the scene", [&] { ApplyAdjustment(state); });
}

}  // namespace arthro::app
