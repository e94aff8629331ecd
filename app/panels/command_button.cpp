#include "app/panels/command_button.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include <imgui.h>

namespace arthro::app {

bool CommandButton(Ui& ui, EditorState& state, std::string_view id, const ImVec2& size) {
  const Command& command = CommandOf(state, id);
  const bool is_pressed = Button(ui, command.words, command.enabled(state), size);
  CommandTip(ui, state, command);
  if (is_pressed) Run(state, command);
  return is_pressed;
}

void CommandToggle(Ui& ui, EditorState& state, std::string_view id, bool is_on,
                   const ImVec2& size) {
  const Command& command = CommandOf(state, id);
  const bool is_pressed = ToggleButton(ui, command.words, is_on, command.enabled(state), size);
  CommandTip(ui, state, command);
  if (is_pressed) Run(state, command);
}

namespace {

void Row(Ui& ui, EditorState& state, std::span<const CommandState> row, float height) {
  const float gap = ui.Px(6), count = static_cast<float>(row.size());
  float spare = ImGui::GetContentRegionAvail().x - gap * (count - 1);
  for (const CommandState& command : row) spare -= ui.WidthOf(CommandOf(state, command.id).words);
  if (spare < 0 && row.size() > 1) {
    Row(ui, state, row.first((row.size() + 1) / 2), height);
    return Row(ui, state, row.last(row.size() / 2), height);
  }
  // In the middle of its button, also where there is less room beside a word than in others.
  const ImVec2 padding = ImGui::GetStyle().FramePadding;
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding,
                      {std::min(padding.x, std::floor(0.5f * spare / count)), padding.y});
  for (const CommandState& command : row) {
    if (command.id != row.front().id) ImGui::SameLine(0, gap);
    const float width = ui.WidthOf(CommandOf(state, command.id).words) + spare / count;
    CommandToggle(ui, state, command.id, command.is_on, {width, height});
  }
  ImGui::PopStyleVar();
}

}  // namespace

void CommandRow(Ui& ui, EditorState& state, std::initializer_list<CommandState> row, float height) {
  Row(ui, state, {row.begin(), row.size()}, height);
}

void CommandTip(Ui& ui, const EditorState& state, const Command& command) {
  Tooltip(ui, command.help, WordsOf(command.shortcut), WhyDisabled(state, command));
}

}  // namespace arthro::app
