// Targets of the chosen exercise: their list, and kind, place, name and size of the chosen one.
#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/state/edits.h"
#include "app/steps/lessons/author/author_fields.h"
#include "app/steps/lessons/author/target_edit.h"

namespace arthro::app {
namespace {

constexpr double kMostShift = 60;  // mm from the portal, of a ball that is placed by numbers

std::string PlaceWords(const ExerciseTarget& target) {
  const std::string loose = target.is_loose ? "loose, " : "";
  switch (KindOf(target)) {
    case TargetKind::kBearing:
      return loose + "on the relief";
    case TargetKind::kPoint:
      return loose + "on " + target.on;
    case TargetKind::kBall:
      return loose + "a ball";
    case TargetKind::kRegions:
      return fmt::format("{} of {}", fmt::join(target.regions, ", "), target.on);
  }
  return "";
}

// Tissue and regions of a target that is regions.
void RegionFields(Ui& ui, EditorState& state, std::size_t chosen) {
  const ExerciseTarget target = ChosenExercise(state)->targets[chosen];
  std::vector<const Tissue*> tissues;
  std::vector<std::string> names;
  int own = -1;
  for (const Tissue& tissue : state.document().scene.tissues) {
    if (tissue.regions.empty()) continue;
    if (tissue.name == target.on) own = static_cast<int>(names.size());
    tissues.push_back(&tissue);
    names.push_back(tissue.name);
  }
  if (names.size() > 1 && Combo(ui, "Tissue of the regions", own, names)) {
    const Tissue& other = *tissues[static_cast<std::size_t>(own)];
    return EditExercise(state, "Tissue of the target", "", [&](Exercise& e) {
      e.targets[chosen].on = other.name;
      e.targets[chosen].regions = {other.regions.front().name};
    });
  }
  if (own < 0) return;
  std::vector<std::string> regions = target.regions;
  for (const Region& region : tissues[static_cast<std::size_t>(own)]->regions) {
    bool is_used = std::ranges::count(regions, region.name) > 0;
    if (!Checkbox(ui, region.name + "##region", is_used)) continue;
    if (is_used)
      regions.push_back(region.name);
    else if (regions.size() > 1)
      std::erase(regions, region.name);
    else
      state.message = "A target of this kind has one region at least.";
  }
  if (regions != target.regions)
    EditExercise(state, "Regions of the target", "",
                 [&](Exercise& e) { e.targets[chosen].regions = regions; });
}

// Middle of a ball by numbers.
void BallFields(Ui& ui, EditorState& state, std::size_t chosen) {
  EditedExercise edited(state);
  glm::dvec3& centre = *edited.changed.targets[chosen].ball;
  constexpr const char* kAxes[] = {"Right", "Down", "In"};
  QuietText(ui, "Middle of the ball: right, down, in");
  const float third = (ImGui::GetContentRegionAvail().x - 2 * ui.Px(6)) / 3;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis > 0) ImGui::SameLine(0, ui.Px(6));
    ImGui::SetNextItemWidth(third);
    double mm = 1e3 * centre[axis];
    edited.Note(NumberField(ui, kAxes[axis], mm, 0.1, -kMostShift, kMostShift, "%.1f mm"),
                "Middle of the ball");
    centre[axis] = 1e-3 * mm;
  }
  edited.Apply();
}

void ChosenTarget(Ui& ui, EditorState& state, std::size_t chosen) {
  LessonsStep& step = *state.steps.lessons;
  const ExerciseTarget target = ChosenExercise(state)->targets[chosen];
  std::string name = target.id;
  if (TextField(ui, "Name of the target", name, "for example: tibial spine"))
    RenameTarget(state, step.target, name);
  int kind = static_cast<int>(PlacingOf(target));
  if (Combo(ui, "Kind of target", kind,
            {"Point on a surface", "Ball in space", "Regions of a tissue"}))
    return SetTargetPlacing(state, step.target, static_cast<TargetPlacing>(kind));
  if (PlacingOf(target) == TargetPlacing::kRegions) {
    RegionFields(ui, state, chosen);
  } else {
    if (ToggleButton(ui, "Place it by a click", step.takes_target, true, {-FLT_MIN, 0},
                     "Click where the target lies, in the scope's picture or in the overview."))
      step.takes_target = !step.takes_target;
    if (target.ball) BallFields(ui, state, chosen);
    double mm = 1e3 * target.radius;
    const Change change = Slider(ui, "Radius of the target", mm, 0.5, 10, "%.1f mm");
    if (change)
      EditExercise(state, "Radius of the target", "target-radius",
                   [&](Exercise& e) { e.targets[chosen].radius = 1e-3 * mm; });
    if (change.released) EndDrag(state);
    bool is_loose = target.is_loose;
    if (Checkbox(ui, "A loose body", is_loose,
                 "A ball of this radius lies here at the start; a grasper carries it."))
      EditExercise(state, "Loose body", "",
                   [&](Exercise& e) { e.targets[chosen].is_loose = is_loose; });
  }
  if (Button(ui, "Remove this target", true, {-FLT_MIN, 0})) RemoveTarget(state, step.target);
}

// The check of poses, and what it found.
void CheckFields(Ui& ui, EditorState& state) {
  CommandButton(ui, state, "check-targets", {-FLT_MIN, 0});
  const PoseCheck* check = PoseCheckOf(state);
  if (check == nullptr) return;
  for (const std::string& sentence : check->sentences) ColouredText(ui, sentence, kWarning);
  if (check->sentences.empty()) QuietText(ui, "Some pose sees each target of the steps.");
}

}  // namespace

void TargetsPanel(Ui& ui, EditorState& state) {
  LessonsStep& step = *state.steps.lessons;
  // Above the list, so that it stays where it is while the list grows.
  if (Button(ui, "Add a target by a click", true, {-FLT_MIN, 0})) AddTarget(state);
  const auto targets = ChosenExercise(state)->targets;
  for (std::size_t i = 0; i < targets.size(); ++i)
    if (ListEntry(ui, fmt::format("{}, {}##target{}", targets[i].id, PlaceWords(targets[i]), i),
                  static_cast<int>(i) == step.target)) {
      step.target = static_cast<int>(i);
      step.takes_target = false;
    }
  const auto count = static_cast<int>(ChosenExercise(state)->targets.size());
  if (step.target >= 0 && step.target < count)
    ChosenTarget(ui, state, static_cast<std::size_t>(step.target));
  CheckFields(ui, state);
}

}  // namespace arthro::app
