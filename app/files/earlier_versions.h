// The way back: steps of the history, backups of the last saves, snapshots. Going back to a version
// is an edit like any other, so it can be undone.
#pragma once

#include <string>

#include "app/state/editor_state.h"

namespace arthro::app {

// Puts up the dialog.
void OpenHistory(EditorState& state);
void GoToStep(EditorState& state, int step);
// Reads it beside the window and puts it in the place of the document.
void ReturnToVersion(EditorState& state, const authoring::SceneVersion& version);
// Saves the scene, asking where if it has no place yet, and keeps it under this name.
void KeepSnapshotOf(EditorState& state, const std::string& name);

// "Before the tear" of a snapshot, "Save of 23 Nov, 13:04:22" of a backup.
std::string WordsOfVersion(const authoring::SceneVersion& version);

}  // namespace arthro::app
