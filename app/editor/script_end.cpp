#include "app/editor/script_end.h"

#include <string>
#include <variant>

#include <fmt/format.h>

#include "simulation/core/error.h"

namespace arthro::app {

void RefuseUnfinishedScript(const EditorState& state, const EditorOptions& options,
                            const ScriptRunner& script) {
  const auto refuse = [&](const std::string& why) {
    throw Error(Code::kBadData, why, options.script.value_or(""));
  };
  if (options.is_unattended && !state.dialogs.empty())
    if (const auto* error = std::get_if<ErrorDialog>(&state.dialogs.back()))
      refuse(fmt::format("the script ended with a message: {}: {}", error->title, error->sentence));
  if (state.quit && script.state() == ScriptState::kRunning && !script.at_end())
    refuse(fmt::format("the window closed before line {} of the script", script.line_number()));
}

}  // namespace arthro::app
