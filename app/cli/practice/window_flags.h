// Flags of the jobs that open a window: its looks and language.
#pragma once

namespace CLI {
class App;
}

namespace arthro::app {

struct EditorOptions;

// --interface-scale, --theme and --language, which win over what the user has set in the window.
// `otherwise`: a sentence on what holds without a flag.
void AddLookFlags(CLI::App& job, EditorOptions& options,
                  const char* otherwise = "Default: as set in the window.");

}  // namespace arthro::app
