// Buttons that run a command of the list.
#pragma once

#include <string_view>

#include "app/panels/widgets.h"
#include "app/state/command.h"

namespace arthro::app {

bool CommandButton(Ui& ui, EditorState& state, std::string_view id, const ImVec2& size = {0, 0});
// The same, lit while `is_on`.
void CommandToggle(Ui& ui, EditorState& state, std::string_view id, bool is_on,
                   const ImVec2& size = {0, 0});

// Tooltip of a command for the last item: its help, its keys, and why it cannot be called now.
void CommandTip(Ui& ui, const EditorState& state, const Command& command);

}  // namespace arthro::app
