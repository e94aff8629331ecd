// A session as it is written down to be repeated (app/platform/script/script.h): commands by name,
// items by what is written on them. Commands and dialogs note here what was done; the editor's
// recorder (app/editor/script_recorder.h) adds what was done to the window's items.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace arthro::app {

struct EditorState;

struct ScriptRecord {
  bool is_on = false;
  std::vector<std::string> lines;    // so far
  std::vector<std::string> pending;  // lines of the frame that is built
  // Words of commands of this frame: a click on their button is the same act.
  std::vector<std::string> command_words;
};

void RecordCommand(ScriptRecord& record, const std::string& id, const std::string& words,
                   const std::vector<std::string>& arguments = {});
// The file that was chosen in a file dialog, or dropped on the window.
void RecordFile(ScriptRecord& record, const char* verb, const std::filesystem::path& file);

// Begins a record at a known place: the first page, both views, the scene as it is on disk.
void BeginRecord(EditorState& state);

// Runs a command by its id, as a script does, with its arguments; one that takes none hands the
// first to the file dialog that it opens. Gives back why it was not done, or "".
std::string RunByName(EditorState& state, const std::string& id,
                      const std::vector<std::string>& arguments);
// Chooses a file or folder in the file dialog that is open, and replaces what is there. Gives back
// why it was not done, or "".
std::string ChooseFile(EditorState& state, const std::filesystem::path& file);

}  // namespace arthro::app
