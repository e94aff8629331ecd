// Scenes and pictures from and to files, by work beside the window: opening, saving, importing a
// panorama. A file that cannot be read leaves the document as it was and is told in a dialog.
#pragma once

#include <filesystem>
#include <functional>
#include <span>

#include "app/state/editor_state.h"

namespace arthro::app {

// A document with no panorama yet.
authoring::Document NewDocument();

// Replaces the document; asks nothing.
void OpenScene(EditorState& state, const std::filesystem::path& scene);

// Makes `document` the one that is worked on, with a new history; `saved`: as it is on disk.
// `on_disk`: as NoteOnDisk gave it before the document was read; without it, saving over a scene
// that is there asks first.
void StartDocument(EditorState& state, authoring::Document document, bool saved,
                   SceneOnDisk on_disk = {});

// Notes what lies at `scene` now: a scene's folder, its scene.json or an archive.
SceneOnDisk NoteOnDisk(const std::filesystem::path& scene);

// The scene as a document to edit. One of the program's own resources, such as the demo, has no
// folder: saving it asks where. Throws Error as authoring::OpenDocument.
authoring::Document OpenSceneDocument(const std::filesystem::path& scene);
// Marks the document's scene as the one that is edited here, and removes the unfinished files of a
// session that was killed. Tells where another window has it.
void HoldScene(EditorState& state);
// The document without its place: saving it asks where.
void EditCopy(EditorState& state);
// There is a scene at `place`, and it is not the one that this window has last read or written.
bool HasChangedOnDisk(const EditorState& state, const std::filesystem::path& place);

// Saves where it was opened from, or asks where. Asks first when others changed that meanwhile.
// `then` runs once it is saved.
void SaveScene(EditorState& state, std::function<void(EditorState&)> then = {});
// The same without asking: what others changed is lost.
void ReplaceChangedScene(EditorState& state, std::function<void(EditorState&)> then = {});
void SaveSceneAs(EditorState& state, std::function<void(EditorState&)> then = {});

std::span<const Command> FileCommands();  // and undo

// A file that was dropped on the window: a scene, a picture, footage or a surface, by its name.
void OpenDropped(EditorState& state, const std::filesystem::path& file);

}  // namespace arthro::app
