// All keys and mouse actions, made from the lists that they are made from.
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

#include "app/editor/panels/panels.h"
#include "app/state/command.h"
#include "app/steps/practice/hand_motion.h"

namespace arthro::app {
namespace {

void Row(Ui& ui, const std::string& keys, const std::string& words) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ColouredText(ui, keys, kAccent);
  ImGui::TableNextColumn();
  Text(ui, words);
}

bool BeginRows(Ui& ui, const char* name) {
  if (!ImGui::BeginTable(name, 2)) return false;
  ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, ui.Px(210));
  ImGui::TableSetupColumn("words", ImGuiTableColumnFlags_WidthStretch);
  return true;
}

}  // namespace

void HelpWindow(Ui& ui, EditorState& state) {
  Heading(ui, "Keys and mouse");
  const float foot = ImGui::GetFrameHeightWithSpacing() + ui.Px(6);
  ImGui::BeginChild("help", {0, -foot});
  Heading(ui, "Over the picture");
  if (BeginRows(ui, "mouse")) {
    Row(ui, "Drag", "Swing the scope");
    Row(ui, "Wheel", "Scope deeper, or back");
    Row(ui, "Shift+wheel", "Roll the scope");
    Row(ui, "Right drag", "Swing the instrument");
    Row(ui, "Ctrl+wheel", "Instrument deeper, or back");
    Row(ui, "Ctrl+Shift+wheel", "Roll the instrument");
    ImGui::EndTable();
  }
  Gap(ui);
  Heading(ui, "Over the overview");
  if (BeginRows(ui, "overview mouse")) {
    Row(ui, "Drag", "Turn it");
    Row(ui, "Wheel or right drag", "Nearer, or further");
    Row(ui, "Middle drag", "Shift it");
    Row(ui, "Drag the handle", "Move the chosen tissue");
    Row(ui, "Shift+drag the handle", "Turn the chosen tissue");
    Row(ui, "Right drag the handle", "Make it larger, or smaller");
    Row(ui, "Drag the border", "Give one view more room");
    Row(ui, "Esc", "End holding, cutting and naming by clicks");
    ImGui::EndTable();
  }
  Gap(ui);
  Heading(ui, "On the footage's board");
  if (BeginRows(ui, "footage")) {
    Row(ui, "Left, Right", "Frame before, or next");
    Row(ui, "Page up, Page down", "Ten frames back, or on");
    Row(ui, "Space, double-click", "Use this frame, or leave it out");
    Row(ui, "Escape", "Back to the panorama");
    Row(ui, "Wheel, drag", "Look closer, shift; double-click shows all");
    ImGui::EndTable();
  }
  Gap(ui);
  Heading(ui, "On the map of the depth");
  if (BeginRows(ui, "depth map")) {
    Row(ui, "Click", "Read a depth, set a point or paint, by the tool");
    Row(ui, "Drag", "Draw the line of a profile or a length, or paint");
    Row(ui, "Wheel, right drag", "Look closer, shift");
    Row(ui, "[, ]", "Smaller brush, larger brush");
    Row(ui, "Escape", "Leave the brush");
    ImGui::EndTable();
  }
  Gap(ui);
  Heading(ui, "Hands, while a key is held");
  if (BeginRows(ui, "hands")) {
    for (const HandMotion& motion : HandMotions()) Row(ui, motion.key_words, motion.words);
    Row(ui, "C", "Close the jaws, run the shaver");
    Row(ui, "V", "Dead-man switch: the devices may push");
    ImGui::EndTable();
  }
  QuietText(ui, "Arrow and page keys move the scope after a click on the picture.");
  Gap(ui);

  // Commands, each group once, in the order of its first command.
  std::vector<std::string> groups;
  for (const Command& command : state.commands)
    if (!WordsOf(command.shortcut).empty() &&
        std::find(groups.begin(), groups.end(), command.group) == groups.end())
      groups.push_back(command.group);
  for (const std::string& group : groups) {
    Heading(ui, group);
    if (!BeginRows(ui, group.c_str())) return ImGui::EndChild();
    for (const Command& command : state.commands) {
      const std::string keys = WordsOf(command.shortcut), other = WordsOf(command.other_shortcut);
      if (keys.empty() || group != command.group) continue;
      Row(ui, other.empty() ? keys : fmt::format("{} or {}", keys, other), command.help);
    }
    ImGui::EndTable();
    Gap(ui);
  }
  Heading(ui, "Anywhere");
  if (BeginRows(ui, "anywhere")) {
    Row(ui, "Drop a file", "Open a scene or a video, import a panorama or a surface");
    Row(ui, "Ctrl+click a slider", "Type its number");
    Row(ui, "?", "This page");
    ImGui::EndTable();
  }
  ImGui::EndChild();
}

}  // namespace arthro::app
