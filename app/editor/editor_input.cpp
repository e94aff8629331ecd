#include "app/editor/editor_input.h"

#include <filesystem>
#include <utility>

#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_internal.h>

#include "app/editor/every_step.h"
#include "app/files/scene_files.h"
#include "app/state/command.h"
#include "app/state/edits.h"
#include "app/steps/tissue/cut/tissue_cut.h"

namespace arthro::app {

std::vector<CrawlKeys> KeysOfCrawl(const EditorState& state) {
  std::vector<CrawlKeys> all;
  for (const Command& command : state.commands)
    for (const Shortcut& shortcut : {command.shortcut, command.other_shortcut}) {
      if (shortcut.key == 0 || command.id == std::string_view("quit")) continue;
      std::vector<int> keys;
      if (shortcut.ctrl) keys.push_back(GLFW_KEY_LEFT_CONTROL);
      if (shortcut.shift) keys.push_back(GLFW_KEY_LEFT_SHIFT);
      keys.push_back(shortcut.key);
      all.push_back({WordsOf(shortcut), std::move(keys)});
    }
  for (const char* name : {"escape", "escape", "enter", "tab", "space", "left", "right", "up",
                           "down", "pageup", "pagedown", "home", "end", "delete", "backspace"})
    all.push_back({name, KeysFromWords(name)});
  return all;
}

void RunShortcuts(EditorState& state) {
  const ImGuiIO& io = ImGui::GetIO();
  if (!state.dialogs.empty()) return;
  if (InEditor(state) && ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false) && !io.WantTextInput)
    LeaveBrush(state);
  for (const Command& command : state.commands)
    for (const Shortcut& shortcut : {command.shortcut, command.other_shortcut}) {
      if (shortcut.key == 0 || !ImGui::IsKeyPressed(shortcut.key, false)) continue;
      if (io.KeyCtrl != shortcut.ctrl || io.KeyShift != shortcut.shift || io.KeyAlt) continue;
      const bool function_key = shortcut.key >= GLFW_KEY_F1 && shortcut.key <= GLFW_KEY_F12;
      if (io.WantTextInput && !function_key) continue;
      ImGui::NavMoveRequestCancel();  // an arrow that is a command does not walk the panels
      Run(state, command);
      return;  // one key, one command
    }
  // "?" by what it types, since its key is another one on every keyboard.
  if (!io.WantTextInput)
    for (const ImWchar character : io.InputQueueCharacters)
      if (character == '?') return Run(state, "help");
}

void TakeNews(EditorState& state, const FrameNews& news) {
  if (news.close_requested && state.dialogs.empty()) Run(state, "quit");
  if (!news.dropped.empty() && state.dialogs.empty() && !state.practice && !state.practice_only)
    Guarded(state, "Open", [&] {
      RecordFile(state.record, "drop", news.dropped.front());
      OpenDropped(state, news.dropped.front());
    });
}

std::string TitleOf(const EditorState& state) {
  const std::string& title = state.document().scene.title;
  return (state.history.IsSaved() || state.practice_only ? "" : "• ") +
         (title.empty() ? std::string("Untitled") : title) + " — Arthroscene";
}

ScriptActions ActionsOf(EditorState& state) {
  return {[&state](const std::string& command, const std::vector<std::string>& arguments) {
            return RunByName(state, command, arguments);
          },
          [&state](const std::filesystem::path& file) { return ChooseFile(state, file); },
          [&state](bool of_scope, const std::vector<double>& pose) -> std::string {
            if (!InEditor(state)) return "the hands of a practice follow the mouse and the keys";
            (of_scope ? state.scope : state.instrument) = {pose[1], pose[2], pose[3], pose[0]};
            return "";
          }};
}

}  // namespace arthro::app
