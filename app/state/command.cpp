#include "app/state/command.h"

#include <stdexcept>
#include <vector>

#include <GLFW/glfw3.h>

#include "app/steps/depth/depth_work.h"
#include "app/steps/every_step.h"
#include "app/steps/practice/film.h"
#include "app/steps/practice/tissue_poke.h"

namespace arthro::app {

std::string WordsOf(const Shortcut& shortcut) {
  if (shortcut.key == 0) return "";
  std::string words = std::string(shortcut.ctrl ? "Ctrl+" : "") + (shortcut.shift ? "Shift+" : "");
  if (shortcut.key >= GLFW_KEY_F1 && shortcut.key <= GLFW_KEY_F12)
    return words + "F" + std::to_string(shortcut.key - GLFW_KEY_F1 + 1);
  switch (shortcut.key) {
    case GLFW_KEY_ESCAPE:
      return words + "Esc";
    case GLFW_KEY_DELETE:
      return words + "Delete";
    case GLFW_KEY_HOME:
      return words + "Home";
    default:
      return words + static_cast<char>(shortcut.key);
  }
}

std::span<const Command> AllCommands() {
  static const std::vector<Command> all = [] {
    std::vector<Command> commands;
    for (const auto group : {SceneCommands(), TissueCommands(), PracticeCommands(),
                             DisturbanceCommands(), IncisionCommands()})
      commands.insert(commands.end(), group.begin(), group.end());
    return commands;
  }();
  return all;
}

const Command& CommandOf(std::string_view id) {
  for (const Command& command : AllCommands())
    if (id == command.id) return command;
  throw std::logic_error("no command " + std::string(id));
}

void Guarded(EditorState& state, const std::string& title, const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    if (error.code() == Code::kCancelled)
      state.message = "Stopped.";
    else
      state.dialogs.push_back(ErrorDialog{title, error.what()});
  } catch (const std::exception& fault) {
    state.dialogs.push_back(ErrorDialog{title, DescribeFault(fault)});
  }
}

void Run(EditorState& state, const Command& command) {
  if (!command.enabled(state)) return;
  Guarded(state, command.words, [&] { command.run(state); });
}

void Run(EditorState& state, std::string_view id) { Run(state, CommandOf(id)); }

bool FinishWork(EditorState& state) {
  bool changed = FinishFootage(state);
  if (state.jobs.busy()) {
    const std::string words = state.jobs.words();
    Guarded(state, words, [&] { changed = state.jobs.Finish(state); });
    changed = changed || !state.jobs.busy();
  }
  changed = FinishFilm(state) || changed;
  changed = FinishDepth(state) || changed;
  KeepPokeFresh(state);
  Guarded(state, "Depth", [&] { KeepDepthFresh(state); });
  return changed;
}

}  // namespace arthro::app
