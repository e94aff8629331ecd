// Ways to begin, and the recent scenes with their pictures.
#include <algorithm>
#include <cmath>
#include <iterator>

#include <imgui.h>

#include "app/editor/panels/panels.h"
#include "app/files/scene_files.h"
#include "app/files/start_page.h"
#include "app/panels/command_button.h"
#include "app/panels/fixed_window.h"
#include "app/state/command.h"

namespace arthro::app {
namespace {

// px at scale 1
constexpr double kTileWidth = 222, kTileHeight = 84, kGap = 12;
constexpr double kCellWidth = 284, kPictureHeight = 160, kCellText = 74;

// A command with its sentence below its words.
void Tile(Ui& ui, EditorState& state, const char* id, float width) {
  const Command& command = CommandOf(state, id);
  const bool is_enabled = command.enabled(state);
  const char* const why_disabled = WhyDisabled(state, command);
  const char* const help = *why_disabled != '\0' ? why_disabled : command.help;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::BeginDisabled(!is_enabled);
  const bool is_pressed =
      ImGui::Button(("###" + std::string(command.id)).c_str(), {width, ui.Px(kTileHeight)});
  RecordItem(ui, command.words, is_enabled);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float wrap = width - ui.Px(20);
  const unsigned text = ImGui::GetColorU32(ImGuiCol_Text),
                 quiet = ImGui::GetColorU32(ImGuiCol_TextDisabled);
  draw->AddText(ui.fonts.heading, ui.fonts.heading->FontSize,
                {corner.x + ui.Px(10), corner.y + ui.Px(8)}, text, ui.In(command.words).c_str());
  draw->AddText(ui.fonts.text, ImGui::GetFontSize() * 0.88f,
                {corner.x + ui.Px(10), corner.y + ui.Px(32)}, quiet, ui.In(help).c_str(), nullptr,
                wrap);
  ImGui::EndDisabled();
  Tooltip(ui, help, WordsOf(command.shortcut));
  if (is_pressed && is_enabled) Run(state, command);
}

// Text that ends with "…" where it is too long.
void Line(Ui& ui, const ImVec2& corner, float width, unsigned colour, const std::string& text,
          bool keeps_end) {
  std::string shown = text;
  std::size_t cut = 0;
  while (ImGui::CalcTextSize(shown.c_str()).x > width && cut < text.size()) {
    ++cut;
    while (cut < text.size() &&
           (static_cast<unsigned char>(text[keeps_end ? cut : text.size() - cut]) & 0xC0) == 0x80)
      ++cut;
    shown = keeps_end ? "…" + text.substr(cut) : text.substr(0, text.size() - cut) + "…";
  }
  ui.widgets.RecordText(text);
  ImGui::GetWindowDrawList()->AddText(corner, OnGround(colour), shown.c_str());
}

void Cell(Ui& ui, EditorState& state, const StartScene& scene, const PictureTextureOf& texture_of) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ui.Px(kCellWidth), picture = ui.Px(kPictureHeight);
  const bool can_open = scene.problem.empty() && !state.jobs.busy();
  ImGui::BeginDisabled(!can_open);
  const bool is_pressed = ImGui::Selectable(("##" + scene.place.string()).c_str(), false, 0,
                                            {width, picture + ui.Px(kCellText)});
  RecordItem(ui, scene.title, can_open, scene.place.string());
  Tooltip(ui, (scene.problem.empty() ? scene.place.string() : scene.problem).c_str());
  ImGui::EndDisabled();
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImVec2 low = {corner.x + ui.Px(4), corner.y + ui.Px(4)},
               high = {corner.x + width - ui.Px(4), corner.y + picture};
  const unsigned texture = scene.picture ? texture_of(scene.picture) : 0;
  if (texture != 0)
    draw->AddImageRounded(reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(texture)), low,
                          high, {0, 0}, {1, 1}, 0xFFFFFFFF, ui.Px(4));
  else
    draw->AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_FrameBg), ui.Px(4));
  const float text = width - ui.Px(12), line = ImGui::GetTextLineHeight() + ui.Px(3);
  ImVec2 at = {corner.x + ui.Px(6), high.y + ui.Px(4)};
  Line(ui, at, text, kBright, scene.title, false);
  at.y += line;
  Line(ui, at, text, kQuiet, scene.folder, true);
  at.y += line;
  if (scene.problem.empty())
    Line(ui, at, text, kQuiet, scene.saved, false);
  else
    Line(ui, at, text, kWarning, ui.In("Cannot be opened"), false);
  if (!is_pressed) return;
  RecordCommand(state.record, "open", scene.title);
  GuardUnsaved(state, "open another scene", [place = scene.place](EditorState& sure) {
    RecordFile(sure.record, "choose", place);
    Guarded(sure, "Open", [&] { OpenScene(sure, place); });
  });
}

void Recent(Ui& ui, EditorState& state, const PictureTextureOf& texture_of) {
  Heading(ui, "Recent scenes");
  if (state.start->scenes.empty())
    QuietText(ui, "There are none yet. Scenes that you open or save are listed here.");
  const float room = ImGui::GetContentRegionAvail().x, cell = ui.Px(kCellWidth + kGap);
  const int columns = std::max(1, static_cast<int>((room + ui.Px(kGap)) / cell));
  int column = 0;
  const std::vector<StartScene> scenes = state.start->scenes;  // a click may change the list
  for (const StartScene& scene : scenes) {
    if (column > 0) ImGui::SameLine(0, ui.Px(kGap));
    Cell(ui, state, scene, texture_of);
    column = (column + 1) % columns;
  }
}

}  // namespace

void StartPagePanel(Ui& ui, EditorState& state, const Area& area,
                    const PictureTextureOf& texture_of) {
  const FixedWindow window(ui, "start", area, kPageWindow);
  // In the middle of a wide window.
  const float most = ui.Px(4 * (kCellWidth + kGap)), width = std::min(most, area.width - ui.Px(48));
  const float left = std::floor(0.5f * (area.width - width));
  ImGui::SetCursorPos({left, ui.Px(18)});
  ImGui::BeginChild("start content", {width, 0}, false, ImGuiWindowFlags_NavFlattened);
  LargeText(ui, "Arthroscene");
  QuietText(ui, "Arthroscopy training made from surgical video.");
  Gap(ui);
  constexpr const char* kTiles[] = {"new-from-footage", "new-from-picture",
                                    "new-from-phantom", "open",
                                    "open-demo",        "open-library"};
  constexpr int kCount = static_cast<int>(std::size(kTiles));
  const float gap = ui.Px(kGap), available = ImGui::GetContentRegionAvail().x;
  const int fitting =
      std::clamp(static_cast<int>((available + gap) / ui.Px(kTileWidth + kGap)), 1, kCount);
  // Rows of equal length.
  const int rows = (kCount + fitting - 1) / fitting, columns = (kCount + rows - 1) / rows;
  const float tile =
      std::floor((available - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns));
  for (int i = 0; i < kCount; ++i) {
    if (i % columns != 0) ImGui::SameLine(0, gap);
    Tile(ui, state, kTiles[i], tile);
  }
  Gap(ui, 10);
  Recent(ui, state, texture_of);
  ImGui::EndChild();
}

}  // namespace arthro::app
