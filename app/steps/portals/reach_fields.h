// The part of the Portals page about what scope and instrument reach.
#pragma once

#include "app/state/editor_state.h"

namespace arthro::app {

struct Ui;

void ReachFields(Ui& ui, EditorState& state);

}  // namespace arthro::app
