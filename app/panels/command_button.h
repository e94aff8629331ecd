// A button that runs a command of the list; shortcut and help as its tooltip.
#pragma once

#include <string_view>

#include "app/panels/widgets.h"
#include "app/state/command.h"

namespace arthro::app {

bool CommandButton(Ui& ui, EditorState& state, std::string_view id, const ImVec2& size = {0, 0});

}  // namespace arthro::app
