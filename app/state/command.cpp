#include "app/state/command.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include "simulation/core/error.h"

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
    case GLFW_KEY_LEFT:
      return words + "Left";
    case GLFW_KEY_RIGHT:
      return words + "Right";
    case GLFW_KEY_UP:
      return words + "Up";
    case GLFW_KEY_DOWN:
      return words + "Down";
    case GLFW_KEY_PAGE_UP:
      return words + "Page up";
    case GLFW_KEY_PAGE_DOWN:
      return words + "Page down";
    default:
      return words + static_cast<char>(shortcut.key);
  }
}

bool Always(const EditorState&) { return true; }
bool InEditor(const EditorState& state) { return !state.practice && !state.practice_only; }
bool Idle(const EditorState& state) { return InEditor(state) && !state.jobs.busy(); }
bool HasPictureAndTime(const EditorState& state) { return Idle(state) && HasPicture(state); }
bool Practising(const EditorState& state) { return state.practice.has_value(); }
bool HasPicture(const EditorState& state) {
  return InEditor(state) && state.document().panorama != nullptr;
}

const char* WhyDisabled(const EditorState& state, const Command& command) {
  if (command.enabled(state)) return "";
  if (state.jobs.busy()) return "Wait until the work that is under way has ended, or stop it.";
  if (*command.needs != '\0') return command.needs;
  if (state.document().panorama == nullptr)
    return "First begin a scene from footage or from a picture.";
  return state.practice ? "First leave the practice." : "";
}

const Command& CommandOf(const EditorState& state, std::string_view id) {
  for (const Command& command : state.commands)
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
  RecordCommand(state.record, command.id, command.words);
  Guarded(state, command.words, [&] { command.run(state); });
}

void Run(EditorState& state, std::string_view id) { Run(state, CommandOf(state, id)); }

void Run(EditorState& state, std::string_view id, const CommandArguments& arguments,
         const std::string& item) {
  const Command& command = CommandOf(state, id);
  if (!command.enabled(state) || command.run_with == nullptr) return;
  RecordCommand(state.record, command.id, item.empty() ? command.words : item, arguments);
  Guarded(state, command.words, [&] { command.run_with(state, arguments); });
}

std::vector<double> NumbersOf(const CommandArguments& arguments, const char* form) {
  const std::string_view words = form;
  const auto count = static_cast<std::size_t>(std::count(words.begin(), words.end(), ' ')) + 1;
  std::vector<double> numbers;
  for (const std::string& argument : arguments) {
    double value = 0;
    const char* const end = argument.data() + argument.size();
    const auto [rest, error] = std::from_chars(argument.data(), end, value);
    if (error != std::errc() || rest != end || !std::isfinite(value))
      throw Error(Code::kBadArgument,
                  fmt::format("\"{}\" is not a number; write {}", argument, form));
    numbers.push_back(value);
  }
  if (numbers.size() != count)
    throw Error(Code::kBadArgument,
                fmt::format("{} numbers are given; write {}", numbers.size(), form));
  return numbers;
}

}  // namespace arthro::app
