#include "app/panels/command_button.h"

#include <string>

namespace arthro::app {

bool CommandButton(Ui& ui, EditorState& state, std::string_view id, const ImVec2& size) {
  const Command& command = CommandOf(state, id);
  std::string tip = command.help;
  if (const std::string keys = WordsOf(command.shortcut); !keys.empty()) tip += " (" + keys + ")";
  if (!Button(ui, command.words, command.enabled(state), size, tip.c_str())) return false;
  Run(state, command);
  return true;
}

}  // namespace arthro::app
