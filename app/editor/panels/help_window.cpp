// The manual's pages, all keys and mouse actions, and what the program is.
#include <algorithm>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

#include "app/about/about.h"
#include "app/editor/help/key_list.h"
#include "app/editor/help/manual_page.h"
#include "app/editor/help/open_help.h"
#include "app/editor/panels/panels.h"
#include "app/help/help_pages.h"
#include "app/state/command.h"

namespace arthro::app {
namespace {

void AboutSection(Ui& ui, EditorState& state) {
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
  Gap(ui);
  if (Button(ui, "Show the texts of the licences", true, {0, 0},
             "Show the licence of each library, as its Debian package states it."))
    OpenHelp(state, kLicencesPage);
}

void KeyTables(Ui& ui, const EditorState& state) {
  for (const KeyGroup& group : KeyGroups(state.commands)) {
    Heading(ui, group.heading);
    if (ImGui::BeginTable(group.heading.c_str(), 2)) {
      ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, ui.Px(210));
      ImGui::TableSetupColumn("words", ImGuiTableColumnFlags_WidthStretch);
      for (const KeyRow& row : group.rows) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ColouredText(ui, row.keys, kAccent);
        ImGui::TableNextColumn();
        Text(ui, row.words);
      }
      ImGui::EndTable();
    }
    if (!group.note.empty()) QuietText(ui, group.note);
    Gap(ui);
  }
}

// Choice of the page, and the same page with pictures.
void PageBar(Ui& ui, EditorState& state, const HelpDialog& dialog) {
  int chosen = -1;
  for (std::size_t i = 0; i < dialog.names.size(); ++i)
    if (dialog.names[i] == dialog.page) chosen = static_cast<int>(i);
  const bool is_changed = Combo(ui, "Page of the manual", chosen, dialog.titles);
  const auto html = dialog.names.empty() ? std::nullopt : HelpInHtml(dialog.page);
  const bool is_pressed = Button(ui, "Open in the browser", html.has_value());
  Tooltip(ui, html ? "Show this page with its pictures." : WhereTheManualIs().c_str());
  if (is_pressed && !OpenOnDesktop(*html))
    state.message = "There is no browser: xdg-open is not on this machine.";
  if (is_changed) OpenHelp(state, dialog.names[static_cast<std::size_t>(chosen)]);
}

}  // namespace

void HelpWindow(Ui& ui, EditorState& state, const HelpDialog& dialog) {
  HelpDialog shown = dialog;  // another page takes its place while the bar is drawn
  const std::size_t mark = std::min(shown.page.find('#'), shown.page.size());
  const std::string anchor = shown.page.substr(std::min(mark + 1, shown.page.size()));
  shown.page.erase(mark);
  PageBar(ui, state, shown);
  if (!shown.problem.empty()) ColouredText(ui, shown.problem, kWarning);
  const float foot = ImGui::GetFrameHeightWithSpacing() + ui.Px(6);
  ImGui::BeginChild(("help " + shown.page).c_str(), {0, -foot});
  if (shown.page == kKeysPage) {
    Heading(ui, "Keys and mouse");
    KeyTables(ui, state);
    AboutSection(ui, state);
  } else if (shown.page == kLicencesPage) {
    // Draws only the visible lines, since the text is long and not wrapped.
    ImGui::TextUnformatted(shown.text.data(), shown.text.data() + shown.text.size());
    ui.widgets.RecordText(shown.text.substr(0, shown.text.find('\n')));
  } else {
    const PageUse use = ManualPage(ui, shown.text, anchor);
    HelpDialog* const now = std::get_if<HelpDialog>(&state.dialogs.back());
    if (use.has_scrolled && now != nullptr && now->page == shown.page + "#" + anchor)
      now->page = shown.page;
    if (!use.link.empty()) FollowHelpLink(state, use.link);
  }
  ImGui::EndChild();
}

}  // namespace arthro::app
