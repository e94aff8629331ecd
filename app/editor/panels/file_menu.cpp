// The menu of what is done to the scene as a whole, to the window and to the record of a session;
// and the settings of the window.
#include <GLFW/glfw3.h>
#include <imgui.h>

#include "app/editor/panels/panels.h"
#include "app/panels/options_panel.h"
#include "app/state/command.h"

namespace arthro::app {
namespace {

void Entry(Ui& ui, EditorState& state, const char* id) {
  const Command& command = CommandOf(state, id);
  const bool is_enabled = command.enabled(state);
  const std::string keys = WordsOf(command.shortcut);
  const bool is_pressed = ImGui::MenuItem(ui.translation.Label(command.words).c_str(),
                                          ui.In(keys).c_str(), false, is_enabled);
  RecordItem(ui, command.words, is_enabled);
  Tooltip(ui, command.help, "", WhyDisabled(state, command));
  if (is_pressed) Run(state, command);
}

}  // namespace

void FileMenu(Ui& ui, EditorState& state) {
  const bool is_pressed =
      Button(ui, "File", true, {0, 0}, "Scenes, the record of a session, settings.");
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  if (is_pressed) ImGui::OpenPopup("file menu");
  ImGui::SetNextWindowPos({low.x, high.y + ui.Px(2)});
  if (!ImGui::BeginPopup("file menu")) return;
  for (const char* id : {"start-page", "new", "new-from-footage", "new-from-picture",
                         "new-from-phantom", "open", "open-demo"})
    Entry(ui, state, id);
  ImGui::Separator();
  for (const char* id : {"save", "save-as", "history"}) Entry(ui, state, id);
  ImGui::Separator();
  for (const char* id : {"record-script", "end-script"}) Entry(ui, state, id);
  ImGui::Separator();
  for (const char* id : {"settings", "full-screen", "manual", "keys", "quit"}) Entry(ui, state, id);
  ImGui::EndPopup();
}

bool SettingsWindow(Ui& ui, EditorState& state) {
  Heading(ui, "Settings");
  Gap(ui, 2);
  OptionsPanel(ui, state.settings);
  Gap(ui);
  return Button(ui, "Close", true, {ui.Px(110), 0}) || DialogKeyPressed(GLFW_KEY_ENTER) ||
         DialogKeyPressed(GLFW_KEY_ESCAPE);
}

}  // namespace arthro::app
