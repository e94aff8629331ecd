#include "app/panels/command_button.h"

#include <string>

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

void CommandTip(Ui& ui, const EditorState& state, const Command& command) {
  Tooltip(ui, command.help, WordsOf(command.shortcut), WhyDisabled(state, command));
}

}  // namespace arthro::app
