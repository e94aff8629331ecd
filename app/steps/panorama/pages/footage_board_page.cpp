// The board: a bar that says what is large, the large picture, the line of all frames, the strip.
#include <algorithm>
#include <cmath>

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/fixed_window.h"
#include "app/steps/panorama/board/footage_words.h"
#include "app/steps/panorama/footage_work.h"
#include "app/steps/panorama/pages/footage_panels.h"

namespace arthro::app {
namespace {

constexpr float kBarHeight = 48, kLineHeight = 14;  // at scale 1

void ViewToggles(Ui& ui, EditorState& state) {
  FootageBoard& board = *state.steps.panorama->footage;
  struct Entry {
    const char* words;
    FrameView view;
    const char* help;
  };
  constexpr Entry kViews[] = {
      {"Raw", FrameView::kRaw, "The frame as it was filmed."},
      {"Rectified", FrameView::kRectified, "The frame without the distortion of the lens."},
      {"Even light", FrameView::kEvenLight,
       "The frame as it is compared with others: even light, without glints and tools."}};
  for (const Entry& entry : kViews) {
    ImGui::SameLine();
    if (ToggleButton(ui, entry.words, board.view == entry.view, true, {0, 0}, entry.help))
      SetFrameView(state, entry.view);
  }
  ImGui::SameLine();
  if (ToggleButton(ui, "Before and after", board.compares, board.view != FrameView::kRaw, {0, 0},
                   "Show the picture before this step beside it."))
    board.compares = !board.compares;
}

void Bar(Ui& ui, EditorState& state, const Area& area) {
  FootageBoard& board = *state.steps.panorama->footage;
  ImGui::SetCursorScreenPos({area.x + ui.Px(12), area.y + ui.Px(8)});
  const bool mosaic = board.selected < 0;
  if (ToggleButton(ui, "The panorama", mosaic, true, {0, 0},
                   "Show the panorama made of the frames."))
    SelectFrame(state, -1);
  const auto words = [&](const std::string& text) {
    ImGui::AlignTextToFramePadding();
    QuietText(ui, text);
    ImGui::SameLine();
  };
  ImGui::SameLine(0, ui.Px(18));
  words("Frame");
  if (Button(ui, "<", board.selected != 0, {ImGui::GetFrameHeight(), 0},
             "Previous frame (left arrow)"))
    StepFrame(state, -1);
  ImGui::SameLine();
  ImGui::SetNextItemWidth(ui.Px(64));
  double frame = std::max(board.selected, 0);
  if (NumberField(ui, "Frame number", frame, 0.2, 0, std::max(0, board.frames() - 1),
                  board.selected < 0 ? "–" : "%.0f", "Counted from 0, as in reports."))
    SelectFrame(state, static_cast<int>(std::lround(frame)));
  ImGui::SameLine();
  words(fmt::format("of 0 to {}", std::max(0, board.frames() - 1)));
  if (Button(ui, ">", board.selected + 1 < board.frames(), {ImGui::GetFrameHeight(), 0},
             "Next frame (right arrow)"))
    StepFrame(state, 1);
  if (board.selected < 0) return;
  ImGui::SameLine(0, ui.Px(10));
  ImGui::Dummy({0, 0});
  ViewToggles(ui, state);
}

// While the board has the keyboard. Not through the list of commands: the same keys walk through
// the panels elsewhere.
void Keys(EditorState& state) {
  const auto pressed = [](int key) { return ImGui::IsKeyPressed(key); };
  FootageBoard& board = *state.steps.panorama->footage;
  if (pressed(GLFW_KEY_LEFT)) StepFrame(state, -1);
  if (pressed(GLFW_KEY_RIGHT)) StepFrame(state, 1);
  if (pressed(GLFW_KEY_PAGE_UP)) StepFrame(state, -10);
  if (pressed(GLFW_KEY_PAGE_DOWN)) StepFrame(state, 10);
  if (pressed(GLFW_KEY_ESCAPE)) SelectFrame(state, -1);
  if (ImGui::IsKeyPressed(GLFW_KEY_SPACE, false) && board.selected >= 0)
    SetFrameIncluded(state, board.selected, board.excluded.contains(board.selected));
}

}  // namespace

unsigned ColourOf(FrameStatus status) {
  switch (status) {
    case FrameStatus::kPlaced:
      return kGood;
    case FrameStatus::kRejected:
      return kBad;
    case FrameStatus::kSeparate:
      return kWarning;
    case FrameStatus::kUnused:
      return 0xFF8B99A6;
    case FrameStatus::kExcluded:
      return 0xFF70675F;
    case FrameStatus::kNotYet:
      break;
  }
  return kQuiet;
}

const char* SignOf(FrameStatus status) {
  switch (status) {
    case FrameStatus::kPlaced:
      return "✓";
    case FrameStatus::kRejected:
      return "✗";
    case FrameStatus::kSeparate:
      return "◆";
    case FrameStatus::kUnused:
      return "∅";
    case FrameStatus::kExcluded:
      return "–";
    case FrameStatus::kNotYet:
      break;
  }
  return "○";
}

const char* ToString(FrameStatus status) {
  switch (status) {
    case FrameStatus::kPlaced:
      return "placed";
    case FrameStatus::kRejected:
      return "rejected";
    case FrameStatus::kSeparate:
      return "separate piece";
    case FrameStatus::kUnused:
      return "not used";
    case FrameStatus::kExcluded:
      return "left out";
    case FrameStatus::kNotYet:
      break;
  }
  return "not yet";
}

void FootageBoardPage(Ui& ui, EditorState& state, const Area& area, const TextureOf& texture) {
  if (ShowsAdjustBoard(state)) return AdjustBoardPage(ui, state, area, texture);
  if (std::exchange(state.steps.panorama->footage->wants_focus, false)) ImGui::SetNextWindowFocus();
  const FixedWindow window(ui, "board", area, kPictureWindow);
  const float bar = ui.Px(kBarHeight), line = ui.Px(kLineHeight), strip = FrameStripHeight(ui);
  const float picture = std::max(1.0f, area.height - bar - line - strip);
  float y = area.y;
  Bar(ui, state, area);
  y += bar;
  LargePicture(ui, state, {area.x, y, area.width, picture}, texture);
  y += picture;
  FrameLine(ui, state, {area.x, y, area.width, line});
  y += line;
  FrameStrip(ui, state, {area.x, y, area.width, strip}, texture);
  if (ImGui::IsWindowFocused(ImGuiFocusedFlags_RootAndChildWindows) &&
      !ImGui::GetIO().WantTextInput)
    Keys(state);
}

}  // namespace arthro::app
