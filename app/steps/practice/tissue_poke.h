// The author's live poke: a practice session that runs behind the editor, with the author's own
// hands. The author's instrument then presses on the tissue instead of going through it, and the
// author's own view shows it. An edit of the scene ends it.
#pragma once

#include "app/steps/practice/practice_step.h"

namespace arthro::app {

void StartPoke(EditorState& state);
void EndPoke(EditorState& state);
// Once a frame: ends it where the scene was edited.
void KeepPokeFresh(EditorState& state);

}  // namespace arthro::app
