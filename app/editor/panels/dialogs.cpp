// The dialog on top of the stack, in the middle of the window; nothing else takes input meanwhile.
#include <algorithm>

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include "app/editor/panels/panels.h"
#include "app/files/scene_files.h"
#include "app/state/command.h"
#include "app/steps/practice/practice_step.h"
#include "app/steps/tissue/import_frames.h"
#include "app/steps/tissue/tissue_step.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

bool EnterPressed() {
  return DialogKeyPressed(GLFW_KEY_ENTER) || DialogKeyPressed(GLFW_KEY_KP_ENTER);
}
bool EscapePressed() { return DialogKeyPressed(GLFW_KEY_ESCAPE); }

// Takes the dialog off first, so that what it calls may put up another one.
template <class T>
T Take(EditorState& state) {
  T dialog = std::get<T>(std::move(state.dialogs.back()));
  state.dialogs.pop_back();
  return dialog;
}

void Draw(Ui& ui, EditorState& state, ErrorDialog& dialog) {
  Heading(ui, dialog.title);
  Gap(ui, 2);
  Text(ui, dialog.sentence);
  Gap(ui);
  if (Button(ui, "OK", true, {ui.Px(110), 0}) || EnterPressed() || EscapePressed())
    Take<ErrorDialog>(state);
}

void Draw(Ui& ui, EditorState& state, GuardDialog& dialog) {
  const std::string title = state.document().scene.title;
  Heading(ui, "There are changes that are not saved");
  Gap(ui, 2);
  Text(ui, fmt::format("Save \"{}\" before you {}?", title.empty() ? "Untitled" : title,
                       dialog.action));
  Gap(ui);
  const ImVec2 size = {ui.Px(120), 0};
  const bool can_be_saved = state.document().panorama != nullptr;
  if (!can_be_saved) QuietText(ui, "It cannot be saved yet: it has no panorama.");
  const bool save = Button(ui, "Save first", can_be_saved, size);
  ImGui::SameLine();
  const bool discard = Button(ui, "Discard", true, size);
  ImGui::SameLine();
  const bool cancel = Button(ui, "Cancel", true, size) || EscapePressed();
  if (!save && !discard && !cancel) return;
  const GuardDialog taken = Take<GuardDialog>(state);
  if (save) Guarded(state, "Save", [&] { SaveScene(state, taken.then); });
  if (discard) Guarded(state, "Discard", [&] { taken.then(state); });
}

void Draw(Ui& ui, EditorState& state, ChangedOnDiskDialog& dialog) {
  Heading(ui, "The scene was changed on disk");
  Gap(ui, 2);
  Text(ui, fmt::format("Another window or program has changed {} since it was read here. Saving "
                       "replaces those changes.",
                       dialog.place.string()));
  Gap(ui);
  const ImVec2 size = {ui.Px(120), 0};
  const bool save_as = Button(ui, "Save as…", true, size, "Keep both: save this one elsewhere.");
  ImGui::SameLine();
  const bool replace = Button(ui, "Replace it", true, size, "The other changes are lost.");
  ImGui::SameLine();
  const bool cancel = Button(ui, "Cancel", true, size) || EscapePressed();
  if (!save_as && !replace && !cancel) return;
  const ChangedOnDiskDialog taken = Take<ChangedOnDiskDialog>(state);
  if (save_as) Guarded(state, "Save", [&] { SaveSceneAs(state, taken.then); });
  if (replace) Guarded(state, "Save", [&] { ReplaceChangedScene(state, taken.then); });
}

// A length in millimetres with three digits, the larger ones in metres.
std::string ShownLength(double metres) {
  return metres < 1 ? fmt::format("{:.3g} mm", MmFromMetres(metres))
                    : fmt::format("{:.3g} m", metres);
}

void Draw(Ui& ui, EditorState& state, UnitDialog& dialog) {
  Heading(ui, "Which unit is the surface in?");
  Gap(ui, 2);
  Text(ui, fmt::format("{} does not state its unit. A meniscus is 30 to 45 mm long.",
                       dialog.file.filename().string()));
  constexpr std::pair<const char*, const char*> kUnits[] = {
      {"mm", "mm"}, {"cm", "cm"}, {"m", "m"}, {"um", "µm"}, {"in", "inch"}};
  for (const auto& [unit, words] : kUnits) {
    if (ToggleButton(ui, words, dialog.unit == unit, true, {ui.Px(64), 0})) dialog.unit = unit;
    ImGui::SameLine();
  }
  ImGui::NewLine();
  const double length = dialog.longest_side * MetresPerUnit(dialog.unit).value_or(1.0);
  Text(ui, fmt::format("The surface will be {} long.", ShownLength(length)));
  // From a grain of a loose body to a whole bone of the leg.
  constexpr double kShortest = 5e-4, kLongest = 0.6;  // m
  const bool has_size = length >= kShortest && length <= kLongest;
  if (!has_size)
    ColouredText(ui,
                 "Nothing in a joint has that size; choose the unit in which the file was made.",
                 kWarning);
  if (const int partner = PartnerOfImport(state); partner >= 0)
    Checkbox(
        ui,
        "Keep its place beside " +
            state.document().scene.tissues[static_cast<std::size_t>(partner)].name,
        state.steps.tissue->imports->keeps_place,
        "For surfaces of one knee, whose files have the same frame. Otherwise it is laid onto the "
        "relief in the middle of the view.");
  Gap(ui);
  const bool import =
      Button(ui, "Import", has_size, {ui.Px(120), 0}) || (has_size && EnterPressed());
  ImGui::SameLine();
  const bool cancel = Button(ui, "Cancel", true, {ui.Px(120), 0}) || EscapePressed();
  if (!import && !cancel) return;
  const UnitDialog taken = Take<UnitDialog>(state);
  if (import)
    Guarded(state, "Import a surface", [&] {
      ImportSurface(state, taken.file, *taken.surface, taken.unit, taken.tetrahedra.get());
    });
}

void Draw(Ui& ui, EditorState& state, PracticeEndedDialog& dialog) {
  const int whole = static_cast<int>(dialog.seconds);
  Heading(ui, "Practice ended");
  Gap(ui, 2);
  Text(ui, fmt::format("You practised for {}:{:02} minutes.", whole / 60, whole % 60));
  if (!state.steps.practice->film_words.empty()) Text(ui, state.steps.practice->film_words);
  Gap(ui);
  const bool again = Button(ui, "Practise again", true, {ui.Px(170), ui.Px(44)}) || EnterPressed();
  ImGui::SameLine();
  const bool quit = Button(ui, "Quit", true, {ui.Px(120), ui.Px(44)}) || EscapePressed();
  if (!again && !quit) return;
  Take<PracticeEndedDialog>(state);
  if (again) Run(state, "practise");
  if (quit) state.quit = true;
}

std::string WordsForEdits(int edits) {
  if (edits == 0) return "unsaved changes";
  return edits == 1 ? "1 unsaved edit" : fmt::format("{} unsaved edits", edits);
}

void Draw(Ui& ui, EditorState& state, RecoveryDialog& dialog) {
  Heading(ui, "Unsaved work was found");
  Gap(ui, 2);
  if (dialog.problem.empty())
    Text(ui, fmt::format("\"{}\" had {} when the program ended. The copy is of {}.", dialog.title,
                         WordsForEdits(dialog.edits), dialog.when));
  else
    Text(ui, dialog.problem);
  if (!dialog.last_edit.empty()) QuietText(ui, "Last edit: " + dialog.last_edit);
  if (!dialog.folder.empty()) QuietText(ui, "Scene: " + dialog.folder.string());
  Gap(ui);
  const ImVec2 size = {ui.Px(120), 0};
  const bool can_be_restored = dialog.problem.empty();
  const bool restore =
      Button(ui, "Restore it", can_be_restored, size) || (can_be_restored && EnterPressed());
  ImGui::SameLine();
  const bool later =
      Button(ui, "Later", true, size, "Asks again at the next start.") || EscapePressed();
  ImGui::SameLine();
  const bool discard = Button(ui, "Discard it", true, size, "Deletes the copy.");
  if (!restore && !later && !discard) return;
  const RecoveryDialog taken = Take<RecoveryDialog>(state);
  if (restore) Guarded(state, "Restore", [&] { taken.restore(state); });
  if (discard) taken.discard(state);
}

void Draw(Ui& ui, EditorState& state, HelpDialog& dialog) {
  HelpWindow(ui, state, dialog);
  if (Button(ui, "Close", true, {ui.Px(110), 0}) || EnterPressed() || EscapePressed())
    Take<HelpDialog>(state);
}

void Draw(Ui& ui, EditorState& state, SettingsDialog&) {
  if (SettingsWindow(ui, state)) Take<SettingsDialog>(state);
}

void Draw(Ui& ui, EditorState& state, OpenElsewhereDialog& dialog) {
  Heading(ui, "This scene is open in another window");
  Gap(ui, 2);
  Text(ui, fmt::format("{} is edited by {}. A save there and a save here replace each other.",
                       dialog.place.string(), dialog.who));
  Gap(ui);
  const ImVec2 size = {ui.Px(130), 0};
  const bool copy = Button(ui, "Edit a copy", true, size, "Saving asks where.") || EnterPressed();
  ImGui::SameLine();
  const bool anyway = Button(ui, "Edit it anyway", true, {ui.Px(150), 0}) || EscapePressed();
  if (!copy && !anyway) return;
  Take<OpenElsewhereDialog>(state);
  if (copy) EditCopy(state);
}

// Width at scale 1; a height of 0 fits the content.
struct WindowSize {
  double width = 460, height = 0;
};
WindowSize SizeOf(const Dialog& dialog) {
  if (std::holds_alternative<BrowseDialog>(dialog)) return {940, 560};
  if (std::holds_alternative<HelpDialog>(dialog)) return {820, 680};
  if (std::holds_alternative<HistoryDialog>(dialog)) return {820, 560};
  if (std::holds_alternative<ErrorDialog>(dialog)) return {560, 0};
  return {};
}

// While work runs that would overwrite what an author does meanwhile.
void Working(Ui& ui, EditorState& state) {
  Heading(ui, state.jobs.words());
  ImGui::ProgressBar(static_cast<float>(state.jobs.done()), {-1, 0});
  if (Button(ui, "Stop", true, {ui.Px(110), 0}) || EscapePressed()) state.jobs.Stop();
}

}  // namespace

void Dialogs(Ui& ui, EditorState& state, const PictureTextureOf& texture_of) {
  const bool working = state.jobs.busy() && state.jobs.blocks_editing();
  if (state.dialogs.empty() && !working) return;
  constexpr const char* kId = "###dialog";
  if (!ImGui::IsPopupOpen(kId)) ImGui::OpenPopup(kId);
  const WindowSize size = working ? WindowSize{} : SizeOf(state.dialogs.back());
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  // 0 means as large as the content.
  const auto fitted = [&](double wanted, float of_screen) {
    return std::max(1.0f, std::min(ui.Px(wanted), of_screen - ui.Px(24)));
  };
  const float width = fitted(size.width, screen.x);
  const float height = size.height > 0 ? fitted(size.height, screen.y) : 0;
  ImGui::SetNextWindowSize({width, height}, ImGuiCond_Always);
  ImGui::SetNextWindowPos({0.5f * screen.x, 0.45f * screen.y}, ImGuiCond_Always, {0.5f, 0.45f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.Px(18), ui.Px(16)});
  const bool open =
      ImGui::BeginPopupModal(kId, nullptr,
                             ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                                 ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings);
  ImGui::PopStyleVar();
  if (!open) return;
  if (working)
    Working(ui, state);
  else
    std::visit(
        [&](auto& dialog) {
          using Kind = std::decay_t<decltype(dialog)>;
          if constexpr (std::is_same_v<Kind, BrowseDialog>)
            BrowseWindow(ui, state, dialog, texture_of);
          else if constexpr (std::is_same_v<Kind, HistoryDialog>)
            HistoryWindow(ui, state, dialog, texture_of);
          else
            Draw(ui, state, dialog);
        },
        state.dialogs.back());
  const bool still_working = state.jobs.busy() && state.jobs.blocks_editing();
  if (state.dialogs.empty() && !still_working) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace arthro::app
