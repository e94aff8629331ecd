// Jobs of the program arthroscene-bench: speed and error side by side, on inputs whose truth is
// known.
#pragma once

namespace CLI {
class App;
}

namespace arthro::app {

// Adds panorama, relief, tissue, haptics, view, micro and all, and the worker that `panorama`
// starts.
void AddBenches(CLI::App& program);

}  // namespace arthro::app
