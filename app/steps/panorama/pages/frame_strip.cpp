// All frames of the clip: a line with one mark each, and a strip of small pictures of which only
// those in sight are drawn.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include "app/panels/fixed_window.h"
#include "app/steps/panorama/board/footage_words.h"
#include "app/steps/panorama/footage_work.h"
#include "app/steps/panorama/pages/footage_panels.h"

namespace arthro::app {
namespace {

constexpr float kThumbHeight = 84, kCellGap = 8, kMargin = 10;  // at scale 1
constexpr float kNotches = 2;                                   // cells that a wheel's notch moves

struct Cell {
  float width, thumb_height, step;
};
Cell CellOf(const Ui& ui, const FootageBoard& board) {
  const float aspect =
      board.height > 0 ? static_cast<float>(board.width) / static_cast<float>(board.height) : 1.25f;
  Cell cell;
  cell.thumb_height = ui.Px(kThumbHeight);
  cell.width = std::floor(cell.thumb_height * std::clamp(aspect, 1.0f, 2.0f));
  cell.step = cell.width + ui.Px(kCellGap);
  return cell;
}

// The small picture within its cell, whatever its shape.
void Thumb(const SharedPicture& picture, const ImVec2& low, const Cell& cell,
           const TextureOf& texture, bool is_out) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(low, {low.x + cell.width, low.y + cell.thumb_height}, 0xFF120F0E);
  const unsigned id = picture ? texture(picture) : 0;
  if (id == 0) return;
  const float scale = std::min(cell.width / static_cast<float>(picture->width),
                               cell.thumb_height / static_cast<float>(picture->height));
  const float w = std::round(scale * static_cast<float>(picture->width));
  const float h = std::round(scale * static_cast<float>(picture->height));
  const ImVec2 corner = {std::round(low.x + 0.5f * (cell.width - w)),
                         std::round(low.y + 0.5f * (cell.thumb_height - h))};
  draw->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(id)), corner,
                 {corner.x + w, corner.y + h}, {0, 0}, {1, 1}, is_out ? 0x50FFFFFF : 0xFFFFFFFF);
}

void DrawCell(Ui& ui, EditorState& state, int frame, const ImVec2& low, const Cell& cell,
              const TextureOf& texture) {
  FootageBoard& board = *state.steps.panorama->footage;
  const FrameStatus status = StatusOf(board, frame);
  const bool is_out = status == FrameStatus::kExcluded, is_selected = board.selected == frame;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  ImGui::PushID(frame);

  Thumb(board.thumbs[static_cast<std::size_t>(frame)], low, cell, texture, is_out);
  ImGui::SetCursorScreenPos(low);
  if (HitArea("thumb", {cell.width, cell.thumb_height})) SelectFrame(state, frame);
  RecordItem(ui, fmt::format("Frame {}", frame), true, ToString(status));
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0))
    SetFrameIncluded(state, frame, is_out);
  Tooltip(ui, WordsOfFrame(board, frame).c_str());
  const ImVec2 high = {low.x + cell.width, low.y + cell.thumb_height};
  if (is_selected || ImGui::IsItemHovered())
    draw->AddRect(low, high, is_selected ? kAccent : kQuiet, 0, 0, ui.Px(is_selected ? 3 : 1));

  // Below it: how it stands, its number, and whether it is used.
  const float bar = ui.Px(4);
  draw->AddRectFilled(
      {low.x, high.y}, {high.x, high.y + bar},
      status == FrameStatus::kNotYet ? ImGui::GetColorU32(ImGuiCol_FrameBg) : ColourOf(status));
  const float line = ImGui::GetTextLineHeight();
  const float y = std::round(high.y + bar + ui.Px(4));
  draw->AddText({low.x + ui.Px(2), y}, ColourOf(status), SignOf(status));
  draw->AddText({low.x + ui.Px(20), y}, ImGui::GetColorU32(ImGuiCol_Text),
                fmt::format("{}", frame).c_str());
  bool is_used = !is_out;
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.Px(1), ui.Px(1)});
  ImGui::SetCursorScreenPos({high.x - line - ui.Px(4), y});
  if (ImGui::Checkbox("##use", &is_used)) SetFrameIncluded(state, frame, is_used);
  RecordItem(ui, fmt::format("Use frame {}", frame), true, is_used ? "on" : "off");
  Tooltip(ui, "Use this frame. (Double-click, or space)");
  ImGui::PopStyleVar();
  ImGui::PopID();
}

}  // namespace

float FrameStripHeight(const Ui& ui) {
  return std::ceil(ui.Px(kMargin + kThumbHeight + 4 + 4 + 4) + ImGui::GetTextLineHeight() +
                   ui.Px(6) + ImGui::GetStyle().ScrollbarSize);
}

void FrameStrip(Ui& ui, EditorState& state, const Area& area, const TextureOf& texture) {
  FootageBoard& board = *state.steps.panorama->footage;
  const Cell cell = CellOf(ui, board);
  const float margin = ui.Px(kMargin);
  const float total = 2 * margin + cell.step * static_cast<float>(board.frames()) - ui.Px(kCellGap);
  ImGui::SetCursorScreenPos({area.x, area.y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::SetNextWindowContentSize({total, 0});
  ImGui::BeginChild("strip", {std::max(area.width, 1.0f), std::max(area.height, 1.0f)}, false,
                    ImGuiWindowFlags_AlwaysHorizontalScrollbar |
                        ImGuiWindowFlags_HorizontalScrollbar | ImGuiWindowFlags_NoScrollWithMouse |
                        ImGuiWindowFlags_NoNavInputs | ImGuiWindowFlags_NoNavFocus);
  ImGui::PopStyleVar();
  float scroll = ImGui::GetScrollX();
  const float room = ImGui::GetScrollMaxX();
  if (ImGui::IsWindowHovered() && ImGui::GetIO().MouseWheel != 0)
    scroll -= ImGui::GetIO().MouseWheel * kNotches * cell.step;
  if (std::exchange(board.scroll_to_selected, false) && board.selected >= 0) {
    // The selected one in sight, with its neighbour.
    const float x = margin + cell.step * static_cast<float>(board.selected);
    scroll = std::min(scroll, x - cell.step);
    scroll = std::max(scroll, x + 2 * cell.step - area.width);
  }
  scroll = std::clamp(scroll, 0.0f, std::max(room, 0.0f));
  if (scroll != ImGui::GetScrollX()) ImGui::SetScrollX(scroll);

  const float origin = std::floor(area.x + margin - ImGui::GetScrollX());
  const int first = std::max(0, static_cast<int>((area.x - origin) / cell.step));
  const int last =
      std::min(board.frames() - 1, static_cast<int>((area.x + area.width - origin) / cell.step));
  for (int frame = first; frame <= last; ++frame)
    DrawCell(ui, state, frame,
             {std::floor(origin + cell.step * static_cast<float>(frame)), area.y + margin}, cell,
             texture);
  ImGui::EndChild();
}

void FrameLine(Ui& ui, EditorState& state, const Area& area) {
  FootageBoard& board = *state.steps.panorama->footage;
  const int frames = board.frames();
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float left = area.x + ui.Px(kMargin),
              width = std::max(1.0f, area.width - 2 * ui.Px(kMargin));
  const float top = area.y + ui.Px(5), bottom = area.y + area.height - ui.Px(1);
  const auto x_of = [&](int frame) {
    return std::round(left + width * static_cast<float>(frame) / static_cast<float>(frames));
  };
  // Neighbours of one colour are one mark; with more frames than pixels some are passed over.
  const int stride = std::max(1, static_cast<int>(static_cast<float>(frames) / width));
  for (int from = 0; from < frames;) {
    const FrameStatus status = StatusOf(board, from);
    int to = from + stride;
    while (to < frames && StatusOf(board, to) == status) to += stride;
    to = std::min(to, frames);
    const unsigned colour =
        status == FrameStatus::kNotYet ? ImGui::GetColorU32(ImGuiCol_FrameBg) : ColourOf(status);
    draw->AddRectFilled({x_of(from), top}, {x_of(to), bottom}, colour);
    from = to;
  }
  if (board.selected >= 0) {
    const float x = std::round(0.5f * (x_of(board.selected) + x_of(board.selected + 1)));
    draw->AddRectFilled({x - ui.Px(2), area.y + ui.Px(1)}, {x + ui.Px(2), bottom}, kAccent);
  }
  ImGui::SetCursorScreenPos({left, area.y});
  HitArea("All frames", {width, area.height});
  RecordItem(ui, "All frames", true, "", WidgetKind::kPicture);
  if (ImGui::IsItemActive()) {
    const float share = (ImGui::GetIO().MousePos.x - left) / width;
    const int frame =
        std::clamp(static_cast<int>(share * static_cast<float>(frames)), 0, frames - 1);
    if (frame != board.selected) SelectFrame(state, frame);
  }
}

}  // namespace arthro::app
