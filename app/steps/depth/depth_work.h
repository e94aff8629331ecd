// Keeps the document's depth map that of its panorama and options: a small preview while a slider
// moves, the full map once it is let go, both in a thread of their own.
#pragma once

#include "app/state/editor_state.h"

namespace arthro::app {

// Starts the work that is wanted, if any. Once a frame; returns at once.
void KeepDepthFresh(EditorState& state);

// Takes over what ended. A fault is told beside the sliders, not in a dialog: the next value may
// do. True when something changed.
bool FinishDepth(EditorState& state);

// The map is being made or is about to be.
bool DepthIsUnderWay(const EditorState& state);

// Runs `then` once the depth map is that of the options: now, or after the work.
void WhenDepthIsReady(EditorState& state, std::function<void(EditorState&)> then);

}  // namespace arthro::app
