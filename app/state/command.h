// Everything a user can have done by a button, a key, a menu entry or a script line, in one list:
// what it is called, what it does, which keys call it, when it can be called. The help page and the
// shortcuts are made from this list.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "app/state/editor_state.h"

namespace arthro::app {

struct Shortcut {
  int key = 0;  // GLFW_KEY_…; 0 none
  bool ctrl = false, shift = false;
};
std::string WordsOf(const Shortcut& shortcut);  // "Ctrl+Shift+S"

using CommandArguments = std::vector<std::string>;

struct Command {
  const char* id;     // "save-as"
  const char* words;  // on its button: "Save as…"
  const char* help;   // one sentence
  const char* group;  // heading of the help page
  Shortcut shortcut, other_shortcut = {};
  bool (*enabled)(const EditorState&);
  void (*run)(EditorState&);
  // Sentence that says why it cannot be called, where nothing else stands in its way.
  const char* needs = "";
  // Words that a script may write after its name ("LEFT TOP RIGHT BOTTOM"), and what they do.
  // `run_with` throws Error(kBadArgument) for arguments of another form. "": only a file.
  const char* arguments = "";
  void (*run_with)(EditorState&, const CommandArguments&) = nullptr;
};
// Numbers of an argument list of this form, one for each word of it. Throws Error(kBadArgument).
std::vector<double> NumbersOf(const CommandArguments& arguments, const char* form);

const Command& CommandOf(const EditorState& state,
                         std::string_view id);  // throws for an unknown id

// ---- When a command can be called. ----
bool Always(const EditorState& state);
bool InEditor(const EditorState& state);
bool Idle(const EditorState& state);  // and no work is under way
bool HasPicture(const EditorState& state);
bool HasPictureAndTime(const EditorState& state);  // and no work is under way
bool Practising(const EditorState& state);
// Sentence that says why it cannot be called now; "" where it can, or where that is not known.
const char* WhyDisabled(const EditorState& state, const Command& command);

// Runs it if it is enabled. An Error becomes a dialog with its sentence.
void Run(EditorState& state, const Command& command);
void Run(EditorState& state, std::string_view id);
// The same with arguments. `item`: name of the window's item that was used for it, if not the
// command's own words: a record of the session then notes the command in place of the click.
void Run(EditorState& state, std::string_view id, const CommandArguments& arguments,
         const std::string& item = "");

// Runs `action`; an Error becomes a dialog titled `title`, a cancelled job a message.
void Guarded(EditorState& state, const std::string& title, const std::function<void()>& action);

}  // namespace arthro::app
