// End of a script in the window: what it must say of a script that did not come to its end.
#pragma once

#include "app/editor/editor.h"
#include "app/platform/script/script_runner.h"
#include "app/state/editor_state.h"

namespace arthro::app {

// Throws Error(kBadData), naming the script, where the window was closed before its last line, or
// where it ended unattended with an error message open.
void RefuseUnfinishedScript(const EditorState& state, const EditorOptions& options,
                            const ScriptRunner& script);

}  // namespace arthro::app
