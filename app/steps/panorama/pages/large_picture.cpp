// Large picture of the board, or two side by side; wheel and drags zoom and shift it.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

#include "app/steps/panorama/board/footage_words.h"
#include "app/steps/panorama/footage_work.h"
#include "app/steps/panorama/pages/footage_panels.h"
#include "authoring/relief/make/make_relief.h"

namespace arthro::app {
namespace {

void DrawIn(const FootageBoard& board, const Area& area, const SharedPicture& picture,
            const TextureOf& texture) {
  const PicturePlace place =
      PlaceOf(board.zoom, {area.width, area.height}, {picture->width, picture->height});
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImVec2 low = {std::round(area.x + static_cast<float>(place.corner.x)),
                      std::round(area.y + static_cast<float>(place.corner.y))};
  const ImVec2 high = {std::round(low.x + static_cast<float>(place.size.x)),
                       std::round(low.y + static_cast<float>(place.size.y))};
  ImGui::PushClipRect({area.x, area.y}, {area.x + area.width, area.y + area.height}, true);
  if (const unsigned id = texture(picture); id != 0)
    draw->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(id)), low, high);
  ImGui::PopClipRect();
}

struct Line {
  std::string words;
  unsigned colour;
};

// Lines over the picture's lower left corner.
void Caption(Ui& ui, const Area& area, const std::vector<Line>& lines) {
  const float width = std::max(1.0f, area.width - ui.Px(40));
  ImVec2 size = {0, 0};
  for (const Line& line : lines) {
    const ImVec2 of_line = ImGui::CalcTextSize(ui.In(line.words).c_str(), nullptr, false, width);
    size = {std::max(size.x, of_line.x), size.y + of_line.y};
  }
  const ImVec2 low = {area.x + ui.Px(10), area.y + area.height - size.y - ui.Px(20)};
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(low, {low.x + size.x + ui.Px(16), low.y + size.y + ui.Px(10)}, 0xD0231E1B,
                      ui.Px(4));
  float y = low.y + ui.Px(5);
  for (const Line& line : lines) {
    ui.widgets.RecordText(line.words);
    draw->AddText(ImGui::GetFont(), ImGui::GetFontSize(), {low.x + ui.Px(8), y}, line.colour,
                  ui.In(line.words).c_str(), nullptr, width);
    y += ImGui::CalcTextSize(ui.In(line.words).c_str(), nullptr, false, width).y;
  }
}

void InTheMiddle(Ui& ui, const Area& area, const std::string& words) {
  ui.widgets.RecordText(words);
  const float width = std::min(area.width - ui.Px(40), ui.Px(420));
  const std::string shown = ui.In(words);
  const ImVec2 size = ImGui::CalcTextSize(shown.c_str(), nullptr, false, width);
  ImGui::GetWindowDrawList()->AddText(
      ImGui::GetFont(), ImGui::GetFontSize(),
      {area.x + 0.5f * (area.width - size.x), area.y + 0.5f * (area.height - size.y)}, kQuiet,
      shown.c_str(), nullptr, width);
}

std::string WordsOfNothing(const EditorState& state) {
  const FootageBoard& board = *state.steps.panorama->footage;
  const bool works = FootageIsUnderWay(state);
  if (board.selected >= 0)
    return works ? "This frame is being read." : "This frame could not be read.";
  if (works && state.jobs.stage().starts_with("measuring"))
    return "Camera poses and points of the tissue appear here as soon as they are found.";
  if (works && state.steps.panorama->footage_job.makes_panorama)
    return "The panorama will grow here as soon as the first frames are placed.";
  return "There is no panorama yet. Choose the lens of the scope, then press Run.";
}

// Reason why it is not the step that was asked for; "" when it is.
std::string WordsOfStandIn(const EditorState& state, const Showing& showing) {
  const FootageBoard& board = *state.steps.panorama->footage;
  if (board.large.frame != board.selected || state.steps.panorama->frame_jobs.busy())
    return "Being read…";
  if (!board.large.problem.empty()) return board.large.problem;
  if (!showing.is_stand_in) return "";
  if (board.view == FrameView::kRectified) return "No lens was chosen, so nothing is straightened.";
  return FootageIsUnderWay(state) ? "Shown once the run is over."
                                  : "The run evens out the light of the frames that it uses.";
}

}  // namespace

void LargePicture(Ui& ui, EditorState& state, const Area& area, const TextureOf& texture) {
  FootageBoard& board = *state.steps.panorama->footage;
  const Showing showing = ShowingOf(board);
  ImGui::GetWindowDrawList()->AddRectFilled(
      {area.x, area.y}, {area.x + area.width, area.y + area.height}, 0xFF000000);
  if (ShowsMendPicture(board)) return MendPicture(ui, state, area, texture);
  ImGui::SetCursorScreenPos({area.x, area.y});
  HitArea("Large picture", {area.width, area.height});
  RecordItem(
      ui, "Large picture", true,
      showing.picture ? fmt::format("{}x{}", showing.picture->width, showing.picture->height) : "",
      WidgetKind::kPicture);
  if (!showing.picture && board.selected < 0 && board.motion && !board.motion->cameras.empty())
    return MotionPicture(ui, *board.motion, area);
  if (!showing.picture) return InTheMiddle(ui, area, WordsOfNothing(state));

  // Two side by side, or one.
  const float gap = std::floor(ui.Px(4));
  Area after = area, before = area;
  if (showing.before) {
    before.width = after.width = std::floor(0.5f * (area.width - gap));
    after.x = area.x + area.width - after.width;
  }
  const glm::dvec2 frame = {after.width, after.height};
  const glm::dvec2 size = {showing.picture->width, showing.picture->height};
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemHovered() && io.MouseWheel != 0) {
    const Area& under = showing.before && io.MousePos.x < after.x ? before : after;
    board.zoom = Zoomed(board.zoom, io.MouseWheel,
                        {io.MousePos.x - under.x, io.MousePos.y - under.y}, frame, size);
  }
  if (ImGui::IsItemActive())
    board.zoom = Dragged(board.zoom, {io.MouseDelta.x, io.MouseDelta.y}, frame, size);
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) board.zoom = {};
  if (showing.before) DrawIn(board, before, showing.before, texture);
  DrawIn(board, after, showing.picture, texture);

  if (board.selected < 0) return;
  std::vector<Line> lines = {
      {WordsOfFrame(board, board.selected), ColourOf(StatusOf(board, board.selected))}};
  if (const std::string stand_in = WordsOfStandIn(state, showing); !stand_in.empty())
    lines.push_back({stand_in, kQuiet});
  Caption(ui, area, lines);
}

}  // namespace arthro::app
