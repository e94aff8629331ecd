// The looks of the file browser (app/platform/file_browser_model.h).
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "app/editor/panels/panels.h"
#include "app/files/browse_preview.h"
#include "app/state/command.h"

namespace arthro::app {
namespace {

// Asks before an old file is lost.
enum class Answer { kNone, kYes, kNo };
Answer AskOverwrite(Ui& ui, const BrowseDialog& dialog) {
  ColouredText(ui,
               "\"" + dialog.model.accepted().filename().string() +
                   "\" is already there. Saving replaces it.",
               kWarning);
  const bool yes = Button(ui, "Replace", true, {ui.Px(120), 0});
  ImGui::SameLine();
  const bool no = Button(ui, "Keep it", true, {ui.Px(120), 0});
  return yes ? Answer::kYes : no ? Answer::kNo : Answer::kNone;
}

// Letters typed over the list choose the entry that begins with them.
bool TypeAhead(FileBrowserModel& model) {
  const ImGuiIO& io = ImGui::GetIO();
  bool has_chosen = false;
  if (!io.WantTextInput && ImGui::IsWindowFocused())
    for (const ImWchar letter : io.InputQueueCharacters)
      if (letter >= 32 && letter < 127)
        has_chosen = model.Type(static_cast<char>(letter), ImGui::GetTime());
  return has_chosen;
}

// Rows of what is in the folder. True when a double-click chose one.
bool Entries(Ui& ui, FileBrowserModel& model) {
  bool accepted = false;
  const bool is_new_choice = TypeAhead(model);
  std::optional<std::filesystem::path> enter;
  if (ImGui::BeginTable("entries", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY)) {
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("changed", ImGuiTableColumnFlags_WidthFixed, ui.Px(140));
    ImGui::TableSetupColumn("size", ImGuiTableColumnFlags_WidthFixed, ui.Px(90));
    for (const FileEntry& entry : model.entries()) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      const std::string name = entry.name() + (entry.is_folder ? "/" : "");
      const bool chosen = entry.name() == model.file_name;
      if (ImGui::Selectable(
              name.c_str(), chosen,
              ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick)) {
        model.Select(entry);
        if (ImGui::IsMouseDoubleClicked(0)) {
          if (entry.is_folder)
            enter = entry.path;
          else
            accepted = true;
        }
      }
      RecordItem(ui, name);
      if (chosen && is_new_choice) ImGui::SetScrollHereY();
      ImGui::TableNextColumn();
      QuietText(ui, WordsForTime(entry.changed));
      ImGui::TableNextColumn();
      QuietText(ui, entry.is_scene ? "scene" : entry.is_folder ? "" : WordsForBytes(entry.bytes));
    }
    ImGui::EndTable();
  }
  if (enter) {
    model.GoTo(*enter);
    model.file_name.clear();
  }
  return accepted;
}

// The folder's path, which can be typed over.
void FolderField(Ui& ui, BrowseDialog& dialog, bool enter) {
  FileBrowserModel& model = dialog.model;
  std::string& path = dialog.typed_folder;
  if (!dialog.is_typing_folder) path = model.folder().string();
  ImGui::SetNextItemWidth(-FLT_MIN);
  ImGui::InputText("##folder", &path);
  RecordItem(ui, "Folder", true, path, WidgetKind::kText);
  const bool was_typing = dialog.is_typing_folder;
  dialog.is_typing_folder = ImGui::IsItemActive();
  if (was_typing && ImGui::IsItemDeactivated() && enter) {
    model.GoTo(path);
    model.file_name.clear();
  }
}

// Folders that are one click away.
void Places(Ui& ui, EditorState& state, FileBrowserModel& model) {
  ImGui::SetNextItemWidth(ui.Px(110));
  const bool is_open =
      ImGui::BeginCombo("##places", ui.In("Places").c_str(), ImGuiComboFlags_HeightLarge);
  RecordItem(ui, "Places", true, "", WidgetKind::kCombo);
  if (!is_open) return;
  const char* home = std::getenv("HOME");
  for (const BrowsePlace& place :
       BrowsePlaces(home != nullptr ? home : "", state.recent.Existing())) {
    if (ListEntry(ui, place.words, place.folder == model.folder())) {
      model.GoTo(place.folder);
      model.file_name.clear();
    }
    Tooltip(ui, place.folder.string().c_str());
  }
  ImGui::EndCombo();
}

// Picture and words of the chosen entry.
void Preview(Ui& ui, const EditorState& state, const PictureTextureOf& texture_of) {
  if (!state.browsed || state.browsed->shown.file.empty())
    return QuietText(ui, "Choose an entry to see it here.");
  const FilePreview& shown = state.browsed->shown;
  const float width = ImGui::GetContentRegionAvail().x;
  if (const unsigned texture = shown.picture ? texture_of(shown.picture) : 0; texture != 0) {
    const float scale =
        width / static_cast<float>(std::max(shown.picture->width, shown.picture->height));
    ImGui::Image(reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(texture)),
                 {scale * static_cast<float>(shown.picture->width),
                  scale * static_cast<float>(shown.picture->height)});
    RecordItem(ui, "Preview", true, shown.file.filename().string(), WidgetKind::kPicture);
  }
  if (!shown.words.empty()) QuietText(ui, shown.words);
}

}  // namespace

void BrowseWindow(Ui& ui, EditorState& state, BrowseDialog& dialog,
                  const PictureTextureOf& texture_of) {
  FileBrowserModel& model = dialog.model;
  Heading(ui, dialog.title);
  const bool enter = DialogKeyPressed(GLFW_KEY_ENTER);

  // Current folder, and ways to leave it.
  if (Button(ui, "Up")) model.GoUp();
  ImGui::SameLine();
  if (Button(ui, "Home"))
    if (const char* home = std::getenv("HOME")) model.GoTo(home);
  ImGui::SameLine();
  Places(ui, state, model);
  ImGui::SameLine();
  if (Button(ui, "New folder…")) dialog.asks_folder_name = !dialog.asks_folder_name;
  ImGui::SameLine();
  bool hidden = model.shows_hidden();
  if (Checkbox(ui, "Hidden files", hidden)) model.ShowHidden(hidden);
  bool made_folder = dialog.is_typing_folder;  // the key belongs to the field
  if (dialog.asks_folder_name) {
    ImGui::SetNextItemWidth(ui.Px(300));
    TextInput(ui, "New folder's name", dialog.new_folder, "Name of the new folder");
    const bool typed = ImGui::IsItemDeactivated() && enter;
    ImGui::SameLine();
    if (Button(ui, "Make it") || typed) {
      made_folder = true;
      if (model.CreateFolder(dialog.new_folder)) {
        dialog.asks_folder_name = false;
        dialog.new_folder.clear();
      }
    }
  }
  FolderField(ui, dialog, enter);

  // The list takes what the lines below it leave.
  const float line = ImGui::GetFrameHeightWithSpacing();
  const float foot =
      2.2f * line + (dialog.asks_overwrite ? 2 * line : 0) + (model.problem().empty() ? 0 : line);
  const bool has_room = ImGui::GetContentRegionAvail().x > ui.Px(700);
  const float preview = has_room ? ui.Px(220) : 0;
  ImGui::BeginChild("list", {-preview, -foot}, false);
  bool accept = Entries(ui, model);
  ImGui::EndChild();
  if (has_room) {
    ImGui::SameLine();
    ImGui::BeginChild("preview", {0, -foot}, false);
    Preview(ui, state, texture_of);
    ImGui::EndChild();
  }

  const float filter = model.filters().size() > 1 ? ui.Px(150) : 0;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - filter - (filter > 0 ? ui.Px(8) : 0));
  if (!std::exchange(dialog.is_shown, true)) ImGui::SetKeyboardFocusHere();
  TextInput(ui, "File name", model.file_name, "Name", ImGuiInputTextFlags_AutoSelectAll);
  if (ImGui::IsItemDeactivated() && enter) accept = true;
  if (filter > 0) {
    ImGui::SameLine();
    ImGui::SetNextItemWidth(filter);
    const std::string& shown = model.filters()[model.filter()].words;
    const bool open = ImGui::BeginCombo("##filter", ui.In(shown).c_str());
    RecordItem(ui, "Kind of file", true, shown, WidgetKind::kCombo);
    if (open) {
      for (std::size_t i = 0; i < model.filters().size(); ++i) {
        if (ListEntry(ui, model.filters()[i].words, i == model.filter())) model.SetFilter(i);
      }
      ImGui::EndCombo();
    }
  }
  if (!model.problem().empty()) ColouredText(ui, model.problem(), kWarning);

  Acceptance acceptance = Acceptance::kNothing;
  if (dialog.asks_overwrite) {
    const Answer answer = AskOverwrite(ui, dialog);
    if (answer == Answer::kYes) acceptance = model.AcceptOverwrite();
    if (answer != Answer::kNone) dialog.asks_overwrite = false;
  }
  if (Button(ui, dialog.accept_words, !model.file_name.empty(), {ui.Px(120), 0})) accept = true;
  ImGui::SameLine();
  if (model.purpose() == BrowseFor::kOpenFileOrFolder) {
    if (Button(ui, "Use this folder", true, {ui.Px(160), 0}, "All pictures in it become the clip."))
      acceptance = model.AcceptFolder();
    ImGui::SameLine();
  }
  const bool cancel =
      Button(ui, "Cancel", true, {ui.Px(120), 0}) || DialogKeyPressed(GLFW_KEY_ESCAPE);
  if (accept && !made_folder && acceptance == Acceptance::kNothing) acceptance = model.Accept();
  if (acceptance == Acceptance::kOverwrite) dialog.asks_overwrite = true;
  if (acceptance != Acceptance::kDone && !cancel) return;

  // The dialog goes first, so that what follows may put up another one.
  const BrowseDialog taken = std::get<BrowseDialog>(std::move(state.dialogs.back()));
  state.dialogs.pop_back();
  if (cancel && state.record.is_on)
    state.record.pending.push_back("click Cancel");
  else if (!cancel)
    RecordFile(state.record, "choose", taken.model.accepted());
  if (!cancel) Guarded(state, taken.title, [&] { taken.then(state, taken.model.accepted()); });
}

}  // namespace arthro::app
