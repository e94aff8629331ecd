#include "app/editor/help/open_help.h"

#include <cstdint>
#include <filesystem>
#include <system_error>
#include <utility>
#include <variant>

#include <GLFW/glfw3.h>

#include "app/files/start_page.h"
#include "app/help/help_pages.h"
#include "app/steps/lessons/lessons_step.h"
#include "app/steps/practice/practice_step.h"
#include "simulation/core/error.h"
#include "simulation/core/input_file.h"

namespace arthro::app {
namespace {

constexpr std::uint64_t kMostLicenceBytes = std::uint64_t{8} << 20;

HelpDialog* ShownHelp(EditorState& state) {
  return state.dialogs.empty() ? nullptr : std::get_if<HelpDialog>(&state.dialogs.back());
}

constexpr Command kHelpCommands[] = {
    {"help",
     "?",
     "Show the manual's page of what is shown.",
     "Window",
     {GLFW_KEY_F1},
     {},
     Always,
     [](EditorState& state) { OpenHelp(state, HelpPageOf(state)); }},
    // The same where there is room for a word.
    {"manual",
     "Help",
     "Show the manual's page of what is shown.",
     "Window",
     {},
     {},
     Always,
     [](EditorState& state) { OpenHelp(state, HelpPageOf(state)); }},
    {"keys",
     "Keys and mouse",
     "Show all keys and mouse actions, and what the program is.",
     "Window",
     {GLFW_KEY_F1, false, true},
     {},
     Always,
     [](EditorState& state) { OpenHelp(state, kKeysPage); }},
};

}  // namespace

std::string HelpPageOf(const EditorState& state) {
  if (state.steps.lessons->page != LessonPage::kNone) return "exercises";
  if (state.steps.practice->shows_devices) return "technician";
  if (state.practice) return "practice";
  if (ShowsStartPage(state)) return "window";
  switch (state.step) {
    case Step::kPanorama:
      return "panorama";
    case Step::kDepth:
      return "depth";
    case Step::kTissue:
      return "tissue";
    case Step::kPortals:
      return "portals";
    case Step::kPractice:
      return "practice";
    case Step::kExercises:
      return "exercises";
  }
  return "window";
}

void OpenHelp(EditorState& state, const std::string& page, const std::string& anchor) {
  HelpDialog dialog{page + (anchor.empty() ? "" : "#" + anchor), {}, {}, {}, {}};
  try {
    for (const HelpPage& each : HelpPages()) {
      dialog.names.push_back(each.name);
      dialog.titles.push_back(each.title);
    }
    if (page == kLicencesPage)
      dialog.text = ReadWholeFile(LicenceTexts(), kMostLicenceBytes);
    else if (page != kKeysPage)
      dialog.text = HelpText(page);
  } catch (const Error& error) {
    dialog.page = kKeysPage;
    dialog.problem = error.what();
  }
  if (HelpDialog* const shown = ShownHelp(state))
    *shown = std::move(dialog);
  else
    state.dialogs.push_back(std::move(dialog));
}

void FollowHelpLink(EditorState& state, const std::string& target) {
  const HelpDialog* const shown = ShownHelp(state);
  if (shown == nullptr) return;
  const HelpLink link = LinkFrom(shown->page.substr(0, shown->page.find('#')), target);
  std::error_code ignored;
  const bool is_address = link.target.find("://") != std::string::npos;
  if (!link.page.empty())
    OpenHelp(state, link.page, link.anchor);
  else if (!is_address && !std::filesystem::exists(link.target, ignored))
    state.message = "It is not on this machine: " + link.target;
  else
    state.message = OpenOnDesktop(link.target) ? "Opened " + link.target
                                               : "xdg-open is not on this machine: " + link.target;
}

std::span<const Command> HelpCommands() { return kHelpCommands; }

}  // namespace arthro::app
