// Where the chosen tissue is held: balls in its own frame that the author puts onto it, one named
// step each. A new mesh keeps them.
#pragma once

#include <glm/vec3.hpp>

#include "app/commands/editor_state.h"

namespace arthro::app {

// A ball of state.hold_radius about a place of the tissue's own frame; it becomes the chosen one.
void HoldAt(EditorState& state, int tissue, const glm::dvec3& x_in_tissue);
// The same where the tip of the author's instrument is.
void HoldAtInstrument(EditorState& state);
void SetBall(EditorState& state, int tissue, int index, const Ball& ball, const std::string& what);
void ReleaseChosenBall(EditorState& state);
void ReleaseAll(EditorState& state);

bool HasChosenBall(const EditorState& state);

}  // namespace arthro::app
