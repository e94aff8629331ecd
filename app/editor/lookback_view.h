// The look back at an attempt: the trainee's picture, the expert's at the same step beside it, and
// what was measured, over time.
#pragma once

#include "app/editor/panels/panels.h"
#include "app/editor/pictures/pictures.h"

namespace arthro::app {

struct LookbackAreas {
  Area own, expert, plots;
};
// Without an expert the plots stand beside the picture, else below both pictures.
LookbackAreas LookbackAreasOf(const Layout& layout, bool has_expert, float scale);

void LookbackView(Ui& ui, EditorState& state, const Pictures& pictures, const Layout& layout);

}  // namespace arthro::app
