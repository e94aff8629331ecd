// Scenes and their files, undo.
#include <GLFW/glfw3.h>

#include "app/files/earlier_versions.h"
#include "app/files/scene_files.h"
#include "app/state/command.h"
#include "app/state/edits.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

using State = EditorState;

void BrowseForScript(State& state, const std::string& title, std::function<void(State&)> then) {
  static const std::vector<FileFilter> filters = {{"Scripts", {".script"}}, {"All files", {}}};
  Browse(
      state, BrowseFor::kSaveFile, title, "Save", filters,
      [then = std::move(then)](State& sure, const std::filesystem::path& file) {
        std::string text;
        for (const std::string& line : sure.record.lines) text += line + "\n";
        WriteAtomically(file, text);
        sure.record = {};
        sure.message = "Script saved in " + file.string();
        if (then) then(sure);
      },
      "session");
}

void Quit(State& state) {
  if (state.record.is_on) {
    BrowseForScript(state, "Save the script before the window closes", [](State& sure) {
      GuardUnsaved(sure, "quit", [](State& really) { really.quit = true; });
    });
    return;
  }
  GuardUnsaved(state, "quit", [](State& sure) { sure.quit = true; });
}

const std::vector<FileFilter>& SceneFilters() {
  static const std::vector<FileFilter> filters = {{"Scenes", {".json", ".arthro"}},
                                                  {"All files", {}}};
  return filters;
}

constexpr Command kFileCommands[] = {
    {"new",
     "New",
     "Begin an empty scene.",
     "Scene",
     {GLFW_KEY_N, true},
     {},
     Idle,
     [](State& state) {
       GuardUnsaved(state, "begin a new scene", [](State& sure) {
         StartDocument(sure, NewDocument(), true);
         sure.step = Step::kPanorama;
         sure.message = "A new scene. Import a panorama, or make one from a video.";
       });
     }},
    {"open",
     "Open…",
     "Open a scene.",
     "Scene",
     {GLFW_KEY_O, true},
     {},
     Idle,
     [](State& state) {
       GuardUnsaved(state, "open another scene", [](State& sure) {
         Browse(sure, BrowseFor::kOpenFile, "Open a scene", "Open", SceneFilters(), OpenScene);
       });
     }},
    {"save",
     "Save",
     "Save the scene in its folder or file.",
     "Scene",
     {GLFW_KEY_S, true},
     {},
     [](const State& state) { return Idle(state) && state.document().panorama != nullptr; },
     [](State& state) { SaveScene(state); }},
    {"save-as",
     "Save as…",
     "Save the scene in another folder.",
     "Scene",
     {GLFW_KEY_S, true, true},
     {},
     [](const State& state) { return Idle(state) && state.document().panorama != nullptr; },
     [](State& state) { SaveSceneAs(state); }},
    {"record-script",
     "Record script",
     "Write down what is done from now on as a script, which `arthroscene run` repeats.",
     "Scene",
     {},
     {},
     [](const State& state) { return Idle(state) && !state.record.is_on; },
     [](State& state) {
       BeginRecord(state);
       state.message = "Recording a script. File, Save the script… ends it.";
     },
     "A script is being recorded already."},
    {"end-script",
     "Save the script…",
     "End the record of the session, and save it.",
     "Scene",
     {},
     {},
     [](const State& state) { return Idle(state) && state.record.is_on; },
     [](State& state) { BrowseForScript(state, "Save the script", {}); },
     "No script is being recorded."},
    {"settings",
     "Settings…",
     "Size of text, colours and language of the window.",
     "Window",
     {GLFW_KEY_COMMA, true},
     {},
     Always,
     [](State& state) { state.dialogs.push_back(SettingsDialog{}); }},
    {"quit", "Quit", "Close the window.", "Scene", {GLFW_KEY_Q, true}, {}, Always, Quit},
    {"undo",
     "Undo",
     "Undo the last edit.",
     "Edit",
     {GLFW_KEY_Z, true},
     {},
     [](const State& state) { return InEditor(state) && state.history.CanUndo(); },
     [](State& state) {
       state.message = "Undone: " + state.history.UndoName();
       state.history.Undo();
     },
     "There is nothing to undo."},
    {"redo",
     "Redo",
     "Redo the last edit that was undone.",
     "Edit",
     {GLFW_KEY_Z, true, true},
     {GLFW_KEY_Y, true},
     [](const State& state) { return InEditor(state) && state.history.CanRedo(); },
     [](State& state) {
       state.message = "Redone: " + state.history.RedoName();
       state.history.Redo();
     },
     "There is nothing to redo."},
    {"history",
     "History…",
     "List the steps, earlier saves and snapshots, and go back to one.",
     "Edit",
     {GLFW_KEY_H, true},
     {},
     Idle,
     OpenHistory},
    {"keep-snapshot",
     "Keep snapshot",
     "Save the scene and keep it under a name.",
     "Edit",
     {},
     {},
     HasPictureAndTime,
     OpenHistory,
     "",
     "NAME",
     [](State& state, const CommandArguments& arguments) {
       if (arguments.size() != 1 || arguments.front().empty())
         throw Error(Code::kBadArgument, "write one name after it");
       KeepSnapshotOf(state, arguments.front());
     }},
};

}  // namespace

std::span<const Command> FileCommands() { return kFileCommands; }

}  // namespace arthro::app
