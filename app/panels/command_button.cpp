#include "app/panels/command_button.h"

#include <string>

namespace arthro::app {

bool CommandButton(Ui& ui, EditorState& state, std::string_view id, const ImVec2& size) {
  const Command& command = CommandOf(state, id);
  const bool is_pressed = Button(ui, command.words, command.enabled(state), size);
  Tooltip(ui, command.help, WordsOf(command.shortcut));
  if (is_pressed) Run(state, command);
  return is_pressed;
}

}  // namespace arthro::app
