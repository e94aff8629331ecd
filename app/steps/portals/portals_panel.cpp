// Step 4: where the instrument comes in, and which scope looks.
#include <string>
#include <vector>

#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/drag.h"
#include "app/panels/fixed_window.h"
#include "app/state/command.h"
#include "app/state/edits.h"
#include "app/steps/panorama/panorama_step.h"
#include "app/steps/portals/portals_step.h"
#include "app/steps/portals/reach_fields.h"
#include "app/steps/portals/scope_lens.h"
#include "simulation/core/units.h"
#include "simulation/practice/reach/named_portals.h"

namespace arthro::app {
namespace {

// Least angle, in degrees, that the slider offers of a range that excludes its lower end.
double LowestShown(const Range& angle) {
  return angle.above_min ? 1.0 : DegreesFromRadians(angle.min);
}

void LensChooser(Ui& ui, EditorState& state) {
  std::vector<LensChoice>& lenses = state.steps.portals->lenses;
  if (lenses.empty()) lenses = ScopeLenses(state.steps.panorama->lens_folder);
  std::vector<std::string> words;
  words.reserve(lenses.size() + 2);
  for (const LensChoice& lens : lenses) words.push_back(lens.words);
  const int own = static_cast<int>(words.size());
  int chosen = ChosenScopeLens(lenses, state).value_or(own);
  if (chosen == own) words.push_back(WordsOfScopeLens(state));
  words.emplace_back("from a file…");
  const std::string help = chosen < own ? lenses[static_cast<std::size_t>(chosen)].help
                                        : "Lens of the scene's own file.";
  if (!Combo(ui, "Lens", chosen, words, help.c_str())) return;
  if (chosen < own)
    ChooseScopeLens(state, lenses[static_cast<std::size_t>(chosen)]);
  else if (chosen + 1 == static_cast<int>(words.size()))
    BrowseForScopeLens(state);
}

void MediumChooser(Ui& ui, EditorState& state, Medium medium) {
  QuietText(ui, "Filling of the joint");
  const float width = (ImGui::GetContentRegionAvail().x - ui.Px(6)) / 2;
  const std::string help = FindField<Backdrop>("medium").help;
  if (ToggleButton(ui, "Saline", medium == Medium::kSaline, true, {width, 0}, help.c_str()))
    SetMedium(state, Medium::kSaline);
  ImGui::SameLine(0, ui.Px(6));
  if (ToggleButton(ui, "Gas", medium == Medium::kGas, true, {width, 0}, help.c_str()))
    SetMedium(state, Medium::kGas);
}

// Pairs of portals by name, for the side of the scene.
void PortalChooser(Ui& ui, EditorState& state, double spacing) {
  const BodySide side = state.document().scene.side;
  const bool is_left = side == BodySide::kLeft;
  const float width = (ImGui::GetContentRegionAvail().x - ui.Px(6)) / 2;
  constexpr const char* kHelp = "Side of the scene, for which the portals below are named.";
  if (ToggleButton(ui, "Right knee", side == BodySide::kRight, true, {width, 0}, kHelp))
    SetSide(state, BodySide::kRight);
  ImGui::SameLine(0, ui.Px(6));
  if (ToggleButton(ui, "Left knee", is_left, true, {width, 0}, kHelp))
    SetSide(state, BodySide::kLeft);
  if (side == BodySide::kUnknown)
    QuietText(ui, "The side is not stated. The names below are those of a right knee.");
  const auto named = simulation::EveryNamedPortals();
  std::vector<std::string> titles;
  for (const simulation::NamedPortals& portals : named) titles.emplace_back(portals.title);
  const int none = static_cast<int>(titles.size());
  titles.emplace_back("none of these by name");
  int chosen = simulation::NamedPortalsAt(spacing, is_left).value_or(none);
  if (!Combo(
          ui, "Scope, instrument", chosen, titles,
          "Portals by name. Sets the incision spacing. The distances are values to start from.") ||
      chosen == none)
    return;
  SetIncisionSpacing(state,
                     simulation::SpacingOf(named[static_cast<std::size_t>(chosen)], is_left));
  EndDrag(state);
}

}  // namespace

void PortalsPanel(Ui& ui, EditorState& state) {
  const Scene scene = state.document().scene;  // a copy: edits below move it
  Heading(ui, "Incisions");
  PortalChooser(ui, state, scene.portals.incision_spacing);
  double spacing_mm = MmFromMetres(scene.portals.incision_spacing);
  constexpr double kMost = kMostIncisionSpacing / kMetrePerMillimetre;
  Change change = Slider(ui, "Incision spacing", spacing_mm, -kMost, kMost, "%.1f mm",
                         "From the scope's portal to the instrument's; negative when the "
                         "instrument enters on the left. Ctrl+click to type.");
  if (change) SetIncisionSpacing(state, MetresFromMm(spacing_mm));
  Drag(state, change);
  ReachFields(ui, state);

  Gap(ui);
  Heading(ui, "Scope");
  QuietText(ui, "View angle");
  const float width = (ImGui::GetContentRegionAvail().x - 3 * ui.Px(6)) / 4;
  int column = 0;
  for (const int degrees : {0, 30, 70, 90}) {
    if (column++ > 0) ImGui::SameLine(0, ui.Px(6));
    const bool chosen = std::abs(scene.scope.view_angle - RadiansFromDegrees(degrees)) < 1e-6;
    const Command& command = CommandOf(state, "view-" + std::to_string(degrees));
    if (ToggleButton(ui, command.words, chosen, true, {width, 0}, command.help))
      Run(state, command);
  }
  LensChooser(ui, state);
  // The lens may have been changed just now.
  const std::optional<Lens>& lens = state.document().lens;
  double field_deg =
      DegreesFromRadians(lens ? lens->field_of_view : state.document().scene.scope.field_of_view);
  const FieldFinder field = FindField<ScopeSpec>("field_of_view");
  change = Slider(ui, "Field of view", field_deg, LowestShown(field.range),
                  DegreesFromRadians(field.range.max), "%.0f°", field.help.c_str());
  if (change) SetFieldOfView(state, RadiansFromDegrees(field_deg));
  Drag(state, change);
  double length_mm = MmFromMetres(scene.rig.scope.rod_length);
  change = Slider(
      ui, "Length of the scope", length_mm, 100, 400, "%.0f mm",
      "Distance from the hand to the lens. A longer scope needs larger movements of the hand.");
  if (change) SetRodLength(state, MetresFromMm(length_mm));
  Drag(state, change);

  Gap(ui);
  Heading(ui, "Light");
  MediumChooser(ui, state, scene.backdrop.medium);
  double relight = 100 * scene.backdrop.relight;
  const Range share = FindField<Backdrop>("relight").range;
  change =
      Slider(ui, "Lamp of the scope", relight, 100 * share.min, 100 * share.max, "%.0f %%",
             "0: the light of the footage. 100: that light is evened out, and the scope's own lamp "
             "lights near tissue, with wet highlights.");
  if (change) SetRelight(state, relight / 100);
  Drag(state, change);
  if (scene.backdrop.relight > 0 && !state.document().depth)
    QuietText(ui, "The lamp needs a depth map. Make one in the Depth step.");
  const bool is_relit = scene.backdrop.relight > 0 && state.document().depth;
  if (ToggleButton(
          ui, "As filmed", is_relit && state.steps.portals->shows_as_filmed, is_relit, {},
          "Show the picture with the light of the footage, to compare. Nothing is changed."))
    state.steps.portals->shows_as_filmed = !state.steps.portals->shows_as_filmed;
}

}  // namespace arthro::app
