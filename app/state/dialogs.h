// Dialogs of the window, as values, and the two that many commands open.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "app/platform/file_browser_model.h"
#include "authoring/project/files/scene_versions.h"
#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scene/mesh/tet_mesh.h"

namespace arthro::app {

struct EditorState;

struct ErrorDialog {
  std::string title, sentence;
};
// Before a document with unsaved changes is left.
struct GuardDialog {
  std::string action;  // "open another scene"
  std::function<void(EditorState&)> then;
};
// Before a scene is replaced that another program or window has changed since it was read here.
struct ChangedOnDiskDialog {
  std::filesystem::path place;
  std::function<void(EditorState&)> then;
};
// The scene that was opened is open in another window.
struct OpenElsewhereDialog {
  std::filesystem::path place;
  std::string who;  // "process 1234 on HOST since 13:04"
};
// Steps of the history, earlier saves and snapshots.
struct HistoryDialog {
  std::vector<authoring::SceneVersion> versions;
  std::string snapshot;  // name that is typed
};
struct BrowseDialog {
  std::string title, accept_words;
  FileBrowserModel model;
  std::function<void(EditorState&, const std::filesystem::path&)> then;
  bool asks_overwrite = false, asks_folder_name = false;
  bool is_shown = false;  // in an earlier frame
  std::string new_folder = {}, typed_folder = {};
  bool is_typing_folder = false;
};
// A mesh file says nothing of its unit. The surface has been read; its vertices are in that unit.
struct UnitDialog {
  std::filesystem::path file;
  std::shared_ptr<const SurfaceMesh> surface;
  std::shared_ptr<const TetMesh> tetrahedra;  // whose surface it is; null: the file has none
  double longest_side = 0;                    // longest side of its bounding box
  std::string unit;
};
// A page of the manual (app/editor/help/open_help.h).
struct HelpDialog {
  std::string page, text;                  // name and Markdown
  std::vector<std::string> names, titles;  // pages in the order of the index
  std::string problem;                     // why there are none; empty: there are
};
struct SettingsDialog {};
struct PracticeEndedDialog {
  double seconds = 0;
};
// A copy of unsaved work was left by a program that ended (app/files/recovery_copy.h).
struct RecoveryDialog {
  std::string title, when;
  std::filesystem::path folder;  // folder of the document; empty: it was never saved
  int edits = 0;                 // unsaved ones; 0: not known
  std::string last_edit;
  std::string problem;  // why it cannot be restored; empty: it can
  std::function<void(EditorState&)> restore, discard;
};
using Dialog = std::variant<ErrorDialog, GuardDialog, ChangedOnDiskDialog, BrowseDialog, UnitDialog,
                            HelpDialog, SettingsDialog, PracticeEndedDialog, RecoveryDialog,
                            OpenElsewhereDialog, HistoryDialog>;

// Opens the file browser; `then` gets what was chosen.
void Browse(EditorState& state, BrowseFor purpose, const std::string& title,
            const std::string& accept_words, std::vector<FileFilter> filters,
            std::function<void(EditorState&, const std::filesystem::path&)> then,
            const std::string& file_name = {});

// Runs `then` now if all is saved; else asks: Save, Discard or Cancel.
void GuardUnsaved(EditorState& state, const std::string& action,
                  std::function<void(EditorState&)> then);

}  // namespace arthro::app
