// Small pictures of the scope's view for the list of the history, one per step. The pictures of a
// step are those that were seen while it was current, so they cost no drawing of their own.
#pragma once

#include "app/state/editor_state.h"
#include "simulation/scene/image.h"

namespace arthro::app {

inline constexpr int kStepPictureSide = 96;  // px

// Whether the current step has no picture yet and one would show it: no slider moves, and the depth
// map is that of its options.
bool WantsStepPicture(const EditorState& state);
// Keeps `seen`, the square picture of the scope, for the current step.
void KeepStepPicture(EditorState& state, const ColourImage& seen);
// Null: none.
std::shared_ptr<const ColourImage> StepPicture(const EditorState& state, int step);

}  // namespace arthro::app
