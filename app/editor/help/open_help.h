// The manual in the window: which page belongs to what is shown, and its text.
#pragma once

#include <span>
#include <string>

#include "app/state/command.h"

namespace arthro::app {

// Page of the manual about the keys; the window makes it from its own lists.
inline constexpr const char* kKeysPage = "keys";
// Texts of the licences of all libraries; no page of the manual.
inline constexpr const char* kLicencesPage = "licences";

// Name of the page about what the window shows: "depth", "practice", "window".
std::string HelpPageOf(const EditorState& state);

// Shows a page in the dialog, which is opened where there is none. A manual that is not installed
// becomes a sentence beside the keys. `anchor`: heading to scroll to; the dialog's page carries it
// ("method#metrics") until the page was drawn.
void OpenHelp(EditorState& state, const std::string& page, const std::string& anchor = "");
// Follows a link of the page that is shown: to another page, or by the desktop's own program.
void FollowHelpLink(EditorState& state, const std::string& target);

std::span<const Command> HelpCommands();

}  // namespace arthro::app
