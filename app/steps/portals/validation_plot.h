// The paper's validation figure of the open scene, as files (centres_figure.h): on the panorama, on
// a grid, and as a table.
#pragma once

#include "app/state/editor_state.h"

namespace arthro::app {

// Asks where; NAME.png is the panorama's, NAME-grid.png and NAME.csv go beside it. Neither of those
// two is overwritten where NAME.png was not there before.
void SaveValidationPlot(EditorState& state);

}  // namespace arthro::app
