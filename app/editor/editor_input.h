// Input of the whole window that no panel takes: keys of commands, dropped files, and what a script
// asks of the editor.
#pragma once

#include <string>
#include <vector>

#include "app/platform/script/script_runner.h"
#include "app/platform/window.h"
#include "app/state/editor_state.h"

namespace arthro::app {

// Every command's keys but those that end the program, and the keys of lists and fields.
std::vector<CrawlKeys> KeysOfCrawl(const EditorState& state);

// Runs the command whose keys are pressed. None while text is typed (but function keys) or a dialog
// is open.
void RunShortcuts(EditorState& state);

void TakeNews(EditorState& state, const FrameNews& news);

// Title of the window, with a mark for what is not saved.
std::string TitleOf(const EditorState& state);

// The actions of a script that need the document; `state` must outlive them.
ScriptActions ActionsOf(EditorState& state);

}  // namespace arthro::app
