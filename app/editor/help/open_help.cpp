#include "app/editor/help/open_help.h"

#include <utility>

#include <GLFW/glfw3.h>

#include "app/files/start_page.h"
#include "app/help/help_pages.h"
#include "app/steps/lessons/lessons_step.h"
#include "app/steps/practice/practice_step.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

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

void OpenHelp(EditorState& state, const std::string& page) {
  HelpDialog dialog{page, {}, {}, {}, {}};
  try {
    for (const HelpPage& each : HelpPages()) {
      dialog.names.push_back(each.name);
      dialog.titles.push_back(each.title);
    }
    if (page != kKeysPage) dialog.text = HelpText(page);
  } catch (const Error& error) {
    dialog.page = kKeysPage;
    dialog.problem = error.what();
  }
  if (!state.dialogs.empty() && std::holds_alternative<HelpDialog>(state.dialogs.back()))
    state.dialogs.back() = std::move(dialog);
  else
    state.dialogs.push_back(std::move(dialog));
}

std::span<const Command> HelpCommands() { return kHelpCommands; }

}  // namespace arthro::app
