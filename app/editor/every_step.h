// The editor as a whole: its state with that of every step, every command, and what is done once a
// frame.
#pragma once

#include <filesystem>
#include <functional>
#include <span>

#include "app/state/command.h"

namespace arthro::app {

// In the order of the help page.
std::span<const Command> AllCommands();

// `wake` ends the window's sleep, from any thread.
EditorState MakeEditorState(authoring::Document document, std::function<void()> wake = {},
                            std::filesystem::path recent_file = {});

// Takes over ended work, keeps the depth map fresh. Once a frame. True when something changed.
bool FinishWork(EditorState& state);

// True while a job of any step is under way.
bool HasWork(const EditorState& state);

}  // namespace arthro::app
