// Buttons that run a command of the list.
#pragma once

#include <initializer_list>
#include <string_view>

#include "app/panels/widgets.h"
#include "app/state/command.h"

namespace arthro::app {

bool CommandButton(Ui& ui, EditorState& state, std::string_view id, const ImVec2& size = {0, 0});
// The same, lit while `is_on`.
void CommandToggle(Ui& ui, EditorState& state, std::string_view id, bool is_on,
                   const ImVec2& size = {0, 0});

// Buttons side by side, as wide as their words and equal shares of the space that is left; in two
// rows where there is no room for the words. `height`: px; 0: that of a line.
struct CommandState {
  const char* id;
  bool is_on = false;  // lit
};
void CommandRow(Ui& ui, EditorState& state, std::initializer_list<CommandState> row,
                float height = 0);

// Tooltip of a command for the last item: its help, its keys, and why it cannot be called now.
void CommandTip(Ui& ui, const EditorState& state, const Command& command);

}  // namespace arthro::app
