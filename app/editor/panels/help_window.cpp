// All keys and mouse actions, made from the lists that they are made from, and what the program is.
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

#include "app/about/about.h"
#include "app/editor/panels/panels.h"
#include "app/state/command.h"
#include "app/steps/practice/hand_motion.h"

namespace arthro::app {
namespace {

void KeyRow(Ui& ui, const std::string& keys, const std::string& words) {
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

void AboutSection(Ui& ui) {
  if (!Section(ui, "About this program")) return;
  Text(ui, fmt::format("Arthroscene {}", Version()));
  if (const std::string commit = ShortCommit(); !commit.empty())
    QuietText(ui, fmt::format("Commit {}", commit));
  Text(ui,
       "Free software under the AGPL-3.0-or-later, without any warranty. It is for training, and "
       "no medical device.");
  Gap(ui);
  Heading(ui, "Libraries and their licences");
  if (!ImGui::BeginTable("libraries", 3)) return;
  for (const BuiltWith& own : Libraries()) {
    ImGui::TableNextRow();
    for (const char* words : {own.name, own.version, own.licence}) {
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(words);
    }
  }
  ImGui::EndTable();
  QuietText(ui, "The texts of the licences are in share/arthroscene/built-with.txt.");
}

}  // namespace

void HelpWindow(Ui& ui, EditorState& state) {
  Heading(ui, "Keys and mouse");
  const float foot = ImGui::GetFrameHeightWithSpacing() + ui.Px(6);
  ImGui::BeginChild("help", {0, -foot});
  Heading(ui, "Over the picture");
  if (BeginRows(ui, "mouse")) {
    KeyRow(ui, "Drag", "Swing the scope");
    KeyRow(ui, "Wheel", "Scope deeper, or back");
    KeyRow(ui, "Shift+wheel", "Roll the scope");
    KeyRow(ui, "Right drag", "Swing the instrument");
    KeyRow(ui, "Ctrl+wheel", "Instrument deeper, or back");
    KeyRow(ui, "Ctrl+Shift+wheel", "Roll the instrument");
    ImGui::EndTable();
  }
  Gap(ui);
  Heading(ui, "Over the overview");
  if (BeginRows(ui, "overview mouse")) {
    KeyRow(ui, "Drag", "Turn it");
    KeyRow(ui, "Wheel or right drag", "Nearer, or further");
    KeyRow(ui, "Middle drag", "Shift it");
    KeyRow(ui, "Drag the handle", "Move the chosen tissue");
    KeyRow(ui, "Shift+drag the handle", "Turn the chosen tissue");
    KeyRow(ui, "Right drag the handle", "Make it larger, or smaller");
    KeyRow(ui, "Drag the border", "Give one view more room");
    KeyRow(ui, "Esc", "End holding, cutting and naming by clicks");
    ImGui::EndTable();
  }
  Gap(ui);
  Heading(ui, "On the footage's board");
  if (BeginRows(ui, "footage")) {
    KeyRow(ui, "Left, Right", "Frame before, or next");
    KeyRow(ui, "Page up, Page down", "Ten frames back, or on");
    KeyRow(ui, "Space, double-click", "Use this frame, or leave it out");
    KeyRow(ui, "Escape", "Back to the panorama");
    KeyRow(ui, "Wheel, drag", "Look closer, shift; double-click shows all");
    ImGui::EndTable();
  }
  Gap(ui);
  Heading(ui, "On the map of the depth");
  if (BeginRows(ui, "depth map")) {
    KeyRow(ui, "Click", "Read a depth, set a point or paint, by the tool");
    KeyRow(ui, "Drag", "Draw the line of a profile or a length, or paint");
    KeyRow(ui, "Wheel, right drag", "Look closer, shift");
    KeyRow(ui, "[, ]", "Smaller brush, larger brush");
    KeyRow(ui, "Escape", "Leave the brush");
    ImGui::EndTable();
  }
  Gap(ui);
  Heading(ui, "Hands, while a key is held");
  if (BeginRows(ui, "hands")) {
    for (const HandMotion& motion : HandMotions()) KeyRow(ui, motion.key_words, motion.words);
    KeyRow(ui, "C", "Close the jaws, run the shaver");
    KeyRow(ui, "V", "Dead-man switch: the devices may push");
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
      KeyRow(ui, other.empty() ? keys : fmt::format("{} or {}", keys, other), command.help);
    }
    ImGui::EndTable();
    Gap(ui);
  }
  Heading(ui, "Anywhere");
  if (BeginRows(ui, "anywhere")) {
    KeyRow(ui, "Drop a file", "Open a scene or a video, import a panorama or a surface");
    KeyRow(ui, "Ctrl+click a slider", "Type its number");
    KeyRow(ui, "?", "This page");
    ImGui::EndTable();
  }
  Gap(ui);
  AboutSection(ui);
  ImGui::EndChild();
}

}  // namespace arthro::app
