// Steps of the history, earlier saves and snapshots.
#include <algorithm>
#include <cstdint>

#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "app/editor/panels/panels.h"
#include "app/files/earlier_versions.h"
#include "app/files/step_pictures.h"
#include "app/state/command.h"

namespace arthro::app {
namespace {

// A row of the list: the picture of the step and its name.
bool Row(Ui& ui, const std::string& label, const std::string& words, bool is_current,
         unsigned texture) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float side = ui.Px(44), gap = ui.Px(3);
  const bool is_clicked =
      ImGui::Selectable(("###" + label).c_str(), is_current, 0, {0, side + 2 * gap});
  ImDrawList* draw = ImGui::GetWindowDrawList();
  if (texture != 0)
    draw->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(texture)),
                   {corner.x + gap, corner.y + gap},
                   {corner.x + gap + side, corner.y + gap + side});
  draw->AddText(
      {corner.x + side + 4 * gap, corner.y + gap + 0.5f * (side - ImGui::GetTextLineHeight())},
      ImGui::GetColorU32(ImGuiCol_Text), words.c_str());
  return is_clicked;
}

void Steps(Ui& ui, EditorState& state, const PictureTextureOf& texture_of) {
  Heading(ui, "Steps");
  ImGui::BeginChild("steps", {0, 0}, true);
  const std::vector<std::string> names = state.history.StepNames();
  const int current = state.history.Position();
  // The newest first: the list may be long.
  for (int step = static_cast<int>(names.size()) - 1; step >= 0; --step) {
    const std::string& name = names[static_cast<std::size_t>(step)];
    const std::string label = std::to_string(step) + "  " + name;
    ImGui::PushStyleColor(ImGuiCol_Text, OnGround(step > current ? kQuiet : kBright));
    const auto picture = StepPicture(state, step);
    if (Row(ui, label, std::to_string(step) + "  " + ui.In(name), step == current,
            picture ? texture_of(picture) : 0))
      GoToStep(state, step);
    ImGui::PopStyleColor();
    RecordItem(ui, label, true, step == current ? "on" : "off");
  }
  ImGui::EndChild();
}

// The version that was clicked; null: none.
const authoring::SceneVersion* Versions(Ui& ui, const HistoryDialog& dialog) {
  const authoring::SceneVersion* chosen = nullptr;
  Heading(ui, "Snapshots and earlier saves");
  if (dialog.versions.empty())
    QuietText(ui, "There are none yet. The last five saves are kept beside the scene.");
  for (const authoring::SceneVersion& version : dialog.versions)
    if (Button(ui, WordsOfVersion(version), true, {-FLT_MIN, 0},
               "Put it in the place of the scene. Undo brings the present one back."))
      chosen = &version;
  return chosen;
}

}  // namespace

void HistoryWindow(Ui& ui, EditorState& state, HistoryDialog& dialog,
                   const PictureTextureOf& texture_of) {
  const float foot = ImGui::GetFrameHeightWithSpacing() + ui.Px(6);
  const float half = 0.5f * ImGui::GetContentRegionAvail().x - ui.Px(8);
  ImGui::BeginChild("history", {half, -foot});
  Steps(ui, state, texture_of);
  ImGui::EndChild();
  ImGui::SameLine(0, ui.Px(16));

  ImGui::BeginChild("versions", {0, -foot});
  const authoring::SceneVersion* version = Versions(ui, dialog);
  Gap(ui);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - ui.Px(150));
  TextInput(ui, "Snapshot's name", dialog.snapshot, "Name of a snapshot");
  Tooltip(ui, "Name under which this version can be found again.");
  ImGui::SameLine();
  const bool has_name = !dialog.snapshot.empty() && state.document().panorama != nullptr;
  const bool keep = Button(ui, "Keep snapshot", has_name, {-FLT_MIN, 0},
                           "Save the scene and keep it under this name.");
  ImGui::EndChild();

  const bool close =
      Button(ui, "Close", true, {ui.Px(110), 0}) || DialogKeyPressed(GLFW_KEY_ESCAPE);
  if (!version && !keep && !close) return;
  const authoring::SceneVersion chosen = version ? *version : authoring::SceneVersion{};
  const std::string name = dialog.snapshot;
  state.dialogs.pop_back();  // before the work, which may put up another one
  if (version) Guarded(state, "History", [&] { ReturnToVersion(state, chosen); });
  if (keep) Run(state, "keep-snapshot", {name});
}

}  // namespace arthro::app
