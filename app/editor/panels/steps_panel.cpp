// The author's steps as a list, with the controls of the chosen one below it.
#include <imgui.h>

#include "app/editor/panels/panels.h"
#include "app/files/scene_checklist.h"
#include "app/files/scene_files.h"
#include "app/panels/fixed_window.h"
#include "app/panels/no_panorama.h"
#include "app/state/command.h"
#include "app/steps/budget/frame_budget.h"
#include "app/steps/depth/depth_step.h"
#include "app/steps/lessons/lessons_step.h"
#include "app/steps/panorama/panorama_step.h"
#include "app/steps/portals/portals_step.h"
#include "app/steps/practice/practice_step.h"
#include "app/steps/tissue/tissue_step.h"

namespace arthro::app {
namespace {

struct StepEntry {
  Step step;
  const char* command;
  const char* number;
};
constexpr StepEntry kSteps[] = {
    {Step::kPanorama, "step-panorama", "1"}, {Step::kDepth, "step-depth", "2"},
    {Step::kTissue, "step-tissue", "3"},     {Step::kPortals, "step-portals", "4"},
    {Step::kPractice, "step-practice", "5"}, {Step::kExercises, "step-exercises", "6"}};

void StepList(Ui& ui, EditorState& state) {
  // Six rows as high as five buttons, so that the controls below have room.
  const float gap = ui.Px(2), height = 5.0f / 6 * (ImGui::GetFrameHeight() + gap) - gap;
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.Px(8), gap});
  for (const StepEntry& entry : kSteps) {
    const Command& command = CommandOf(state, entry.command);
    const bool chosen = state.step == entry.step;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    if (ImGui::Selectable((std::string("##") + command.words).c_str(), chosen, 0, {0, height}))
      Run(state, command);
    RecordItem(ui, command.words, true, chosen ? "on" : "off");
    Tooltip(ui, command.help, WordsOf(command.shortcut));
    // Number and name over the row.
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const float y = corner.y + 0.5f * (height - ImGui::GetTextLineHeight());
    draw->AddText({corner.x + ui.Px(8), y}, OnGround(chosen ? kAccent : kQuiet), entry.number);
    draw->AddText(ui.fonts.text, ImGui::GetFontSize(), {corner.x + ui.Px(30), y},
                  ImGui::GetColorU32(ImGuiCol_Text), ui.In(command.words).c_str());
  }
  ImGui::PopStyleVar();
}

// Recent scenes, one button each.
void RecentList(Ui& ui, EditorState& state) {
  const auto recent = state.recent.Existing();
  if (recent.empty()) return;
  Gap(ui);
  Heading(ui, "Recent scenes");
  for (const auto& scene : recent) {
    const auto folder =
        scene.has_extension() && scene.filename() == "scene.json" ? scene.parent_path() : scene;
    if (Button(ui, folder.filename().string() + "##" + scene.string(), !state.jobs.busy(),
               {-FLT_MIN, 0}, scene.c_str()))
      GuardUnsaved(state, "open another scene", [scene](EditorState& sure) {
        Guarded(sure, "Open", [&] { OpenScene(sure, scene); });
      });
  }
}

void Checklist(Ui& ui, EditorState& state) {
  const std::vector<MissingPart> missing = MissingParts(state);
  if (missing.empty()) return;
  Heading(ui, "Still missing in this scene");
  if (!state.document().panorama) return AskForPanorama(ui, state, missing.front().sentence);
  int number = 0;
  for (const MissingPart& part : missing) {
    Text(ui, part.sentence);
    if (Button(ui, "Take me there##" + std::to_string(++number))) GoToMissingPart(state, part);
  }
  Gap(ui);
}

}  // namespace

void StepsPanel(Ui& ui, EditorState& state, const Area& area) {
  const FixedWindow window(
      ui, "steps", area,
      kPageWindow | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  StepList(ui, state);
  Gap(ui, 2);
  ImGui::Separator();
  Gap(ui, 2);

  // Only the controls scroll; the list of steps stays in sight.
  ImGui::PushID(static_cast<int>(state.step));  // each page keeps its own place
  ImGui::BeginChild("controls", {0, 0}, false, 0);
  switch (state.step) {
    case Step::kPanorama:
      PanoramaPanel(ui, state);
      if (ShowsScope(state)) RecentList(ui, state);
      break;
    case Step::kDepth:
      DepthPanel(ui, state);
      break;
    case Step::kTissue:
      TissuePanel(ui, state, [&] { BudgetFields(ui, state); });
      break;
    case Step::kPortals:
      PortalsPanel(ui, state);
      break;
    case Step::kPractice:
      PracticeStepPanel(ui, state);
      if (state.steps.practice->shows_devices) break;
      Gap(ui, 2);
      if (state.document().panorama) BudgetFields(ui, state);
      Checklist(ui, state);
      break;
    case Step::kExercises:
      ExercisesPanel(ui, state);
      break;
  }
  ImGui::EndChild();
  ImGui::PopID();
}

}  // namespace arthro::app
