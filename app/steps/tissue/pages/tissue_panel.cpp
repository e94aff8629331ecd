// Step 3: deformable models in the scene.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/fixed_window.h"
#include "app/panels/no_panorama.h"
#include "app/state/command.h"
#include "app/state/edits.h"
#include "app/steps/practice/practice_step.h"
#include "app/steps/tissue/fault_board.h"
#include "app/steps/tissue/import_frames.h"
#include "app/steps/tissue/library/tissue_library.h"
#include "app/steps/tissue/pages/axis_row.h"
#include "app/steps/tissue/tissue_balls.h"
#include "app/steps/tissue/tissue_pose.h"
#include "app/steps/tissue/tissue_step.h"
#include "simulation/core/options.h"
#include "simulation/core/units.h"
#include "simulation/scene/solids/solid_io.h"

namespace arthro::app {
namespace {

void PoseFields(Ui& ui, EditorState& state, const Tissue& tissue) {
  Pose pose = tissue.pose;
  glm::dvec3 position_mm = tissue.pose.position / kMetrePerMillimetre;
  Change change = AxisRow(ui, "Position (right, down, in)", position_mm, 0.1, -200, 200, "%.1f mm");
  if (change) {
    pose.position = position_mm * kMetrePerMillimetre;
    PlaceTissue(state, state.tissue, pose, "Move");
  }
  if (change.held) state.dragging = true;
  if (change.released) EndDrag(state);

  glm::dvec3 degrees = DegreesOf(tissue.pose.quaternion);
  change = AxisRow(ui, "Rotation (about right, down, in)", degrees, 0.5, -180, 180, "%.1f°");
  if (change) {
    pose.quaternion = QuaternionOf(degrees);
    PlaceTissue(state, state.tissue, pose, "Turn");
  }
  if (change.held) state.dragging = true;
  if (change.released) EndDrag(state);

  double scale = tissue.pose.scale;
  change = Slider(ui, "Scale", scale, 0.1, 5.0, "× %.2f", "Size relative to the model's file.");
  if (change) {
    pose.scale = scale;
    PlaceTissue(state, state.tissue, pose, "Scale");
  }
  if (change.held) state.dragging = true;
  if (change.released) EndDrag(state);
}

// A number of the material: what differs from the preset is kept with the scene.
void ElasticityField(Ui& ui, EditorState& state, const Tissue& tissue, const std::string& name,
                     const char* key, double shown, double factor,
                     std::optional<double> Elasticity::*field, const char* format,
                     const char* help) {
  const Range range = FindField<Elasticity>(key).range;
  double value = shown / factor;
  const double step = 0.01 * std::max(std::abs(value), 0.1);
  QuietText(ui, name);
  ImGui::SetNextItemWidth(-FLT_MIN);
  const Change change =
      NumberField(ui, name, value, step, range.min / factor, range.max / factor, format, help);
  if (change) {
    Elasticity own = tissue.elasticity;
    own.*field = value * factor;
    SetElasticity(state, state.tissue, own, "Change " + name + " of");
  }
  if (change.held) state.dragging = true;
  if (change.released) EndDrag(state);
}

void MaterialFields(Ui& ui, EditorState& state, const Tissue& tissue) {
  std::vector<std::string> titles;
  int chosen = -1;
  const auto* own = simulation::FindTissuePreset(state.tissue_presets, tissue.material);
  for (const auto& preset : state.tissue_presets) {
    if (own == &preset) chosen = static_cast<int>(titles.size());
    titles.push_back(preset.title);
  }
  if (Combo(ui, "Preset", chosen, titles, "What it is made of; values come with their sources."))
    ChoosePreset(state, state.tissue, state.tissue_presets[static_cast<std::size_t>(chosen)].name);
  const auto preset = PresetOf(state, tissue);
  if (!preset) {
    ColouredText(ui, fmt::format("There is no preset \"{}\"; choose one.", tissue.material),
                 kWarning);
    return;
  }
  const simulation::Material& material = preset->material;
  ElasticityField(ui, state, tissue, "Stiffness", "young_modulus", material.young_modulus, 1e6,
                  &Elasticity::young_modulus, "%.3g MPa",
                  "Young's modulus, at small strain. Drag, or double-click to type.");
  ElasticityField(ui, state, tissue, "Poisson's ratio", "poisson_ratio", material.poisson_ratio,
                  1.0, &Elasticity::poisson_ratio, "%.3f",
                  "Ratio of transverse to axial strain; at 0.5 the volume would not change.");
  if (preset->is_thin)
    ElasticityField(ui, state, tissue, "Thickness of the layer", "layer_thickness",
                    preset->layer_thickness, kMetrePerMillimetre, &Elasticity::layer_thickness,
                    "%.1f mm", "On the bone; it needs no tetrahedra.");
  else
    ElasticityField(ui, state, tissue, "Fibres along the rim", "fibre_stiffness",
                    material.fibre_stiffness, 1e6, &Elasticity::fibre_stiffness, "%.3g MPa",
                    "Stiffness along circles about the tissue's own z axis; 0: none.");
  if (!(tissue.elasticity == Elasticity{})) QuietText(ui, "Differs from the preset.");
  QuietText(ui, preset->probing);
  if (ToggleButton(ui, "Sources", state.steps.tissue->shows_sources, true, {-FLT_MIN, 0},
                   "Show the source of each value."))
    state.steps.tissue->shows_sources = !state.steps.tissue->shows_sources;
  if (state.steps.tissue->shows_sources)
    for (const std::string& source : preset->sources) QuietText(ui, source);
  bool is_cuttable = tissue.is_cuttable;
  if (Checkbox(ui, "Instruments may cut it", is_cuttable)) {
    Tissue changed = tissue;
    changed.is_cuttable = is_cuttable;
    SetTissue(state, state.tissue, changed, is_cuttable ? "Let cut" : "Keep whole");
    EndDrag(state);
  }
}

void MeshFields(Ui& ui, EditorState& state, const Tissue& tissue, const SurfaceMesh* surface) {
  const char* filled = tissue.is_implicit    ? "a solid"
                       : tissue.mesh.empty() ? "no tetrahedra yet"
                                             : "filled with tetrahedra";
  QuietText(ui, fmt::format("{} triangles, {}", surface ? surface->triangles.size() : 0, filled));
  FaultFields(ui, state);
  bool is_solid = tissue.is_implicit;
  if (Checkbox(ui, "A solid that does not give way", is_solid,
               "For a loose body or a synovial tuft: bitten and shaved, never deformed. Its "
               "surface must be closed; it has no tetrahedra."))
    SetSolid(state, state.tissue, is_solid);
  std::vector<std::string> sizes;
  int chosen = 0;
  for (const authoring::MeshBudget& budget : authoring::MeshBudgets()) {
    if (budget.size == state.steps.tissue->mesh_size) chosen = static_cast<int>(sizes.size());
    sizes.push_back(budget.name);
  }
  if (Combo(
          ui, "Mesh size", chosen, sizes,
          "Finer meshes are more accurate and slower. Marking probed places helps with coarse and "
          "fine meshes, not with the default of 300 elements."))
    state.steps.tissue->mesh_size = authoring::MeshBudgets()[static_cast<std::size_t>(chosen)].size;
  QuietText(ui, authoring::BudgetWords(authoring::BudgetOf(state.steps.tissue->mesh_size)));
  CommandButton(ui, state, "tetrahedralise", {-FLT_MIN, 0});
  QuietText(ui, tissue.probed.empty()
                    ? "Finer where it is free. Or mark where it will be probed:"
                    : fmt::format("Finest in {} probed {}:", tissue.probed.size(),
                                  tissue.probed.size() == 1 ? "place" : "places"));
  BallFields(ui, state, tissue, BallKind::kProbed);
}

void HeldFields(Ui& ui, EditorState& state, const Tissue& tissue) {
  if (tissue.fixed.empty())
    ColouredText(ui, "Nothing holds this tissue: it will drift when it is touched.", kWarning);
  else
    QuietText(ui, tissue.fixed.size() == 1 ? std::string("1 ball holds it.")
                                           : fmt::format("{} balls hold it.", tissue.fixed.size()));
  BallFields(ui, state, tissue, BallKind::kHeld);
}

// Poke button, and the force on the author's instrument.
void PokeFields(Ui& ui, EditorState& state, const std::function<void()>& below) {
  CommandToggle(ui, state, "poke", state.steps.practice->poke.has_value(), {-FLT_MIN, ui.Px(36)});
  if (!state.steps.practice->poke) return;
  const double force = glm::length(state.steps.practice->poke->snapshot().instrument.tip_force);
  ColouredText(ui,
               fmt::format("{:.2f} N; instruments cause harm above {:.1f} N", force,
                           simulation::kSafeProbingForce),
               force < simulation::kSafeProbingForce ? kGood : kBad);
  QuietText(ui, "Right drag over the picture and Ctrl+wheel move the instrument.");
  ForcePanel(ui, state);
  below();
}

void PlaceFields(Ui& ui, EditorState& state, const Tissue& tissue) {
  LandmarkFields(ui, state);
  if (PlacesLandmarks(state)) return;
  FitFields(ui, state);
  std::string name = tissue.name;
  if (TextField(ui, "Name", name, "name of the tissue") && !name.empty()) {
    Tissue changed = tissue;
    changed.name = name;
    SetTissue(state, state.tissue, changed, "Rename");
    EndDrag(state);
  }
  if (const auto found = FaultsOfChosen(state); found && !found->faults.empty())
    ColouredText(ui, "Its surface has faults; the Mesh page shows them.", kWarning);
  if (IsHidden(state, state.tissue)) {
    ColouredText(ui, "It lies behind the surface of the picture, where the scope cannot see it.",
                 kWarning);
    CommandButton(ui, state, "tissue-before-scope", {-FLT_MIN, 0});
  }
  PoseFields(ui, state, tissue);
  StepFields(ui, state);
  QuietText(ui, "Or drag its handle in the overview.");
  Gap(ui);
  const float half = (ImGui::GetContentRegionAvail().x - ui.Px(8)) / 2;
  CommandButton(ui, state, "duplicate-tissue", {half, 0});
  ImGui::SameLine(0, ui.Px(8));
  CommandButton(ui, state, "remove-tissue", {half, 0});
}

float EyeWidth() { return 1.5f * ImGui::GetTextLineHeight(); }

// An eye that shows and hides a tissue, open or crossed out.
void Eye(Ui& ui, EditorState& state, int tissue, const std::string& name) {
  const float height = ImGui::GetTextLineHeight(), width = EyeWidth();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool is_hidden = IsHiddenByAuthor(state, tissue);
  if (ImGui::InvisibleButton("eye", {width, height})) ToggleHidden(state, tissue);
  RecordItem(ui, "Show " + name, true, is_hidden ? "off" : "on");
  Tooltip(ui, "Show or hide the tissue in both views. A practice shows every tissue.");
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImVec2 middle{at.x + 0.5f * width, at.y + 0.5f * height};
  const float half = 0.45f * width, bow = 0.55f * height;
  const unsigned colour = is_hidden ? kQuiet : kBright;
  for (const float side : {-1.0f, 1.0f})
    draw->AddBezierQuadratic({middle.x - half, middle.y}, {middle.x, middle.y + side * 1.4f * bow},
                             {middle.x + half, middle.y}, colour, ui.Px(1.5));
  if (is_hidden)
    draw->AddLine({middle.x - 0.7f * half, middle.y + bow},
                  {middle.x + 0.7f * half, middle.y - bow}, colour, ui.Px(1.5));
  else
    draw->AddCircleFilled(middle, 0.22f * height, colour);
}

// The name of a tissue and, at the end of the row, its eye.
void TissueRow(Ui& ui, EditorState& state, int tissue, const std::string& name) {
  ImGui::PushID(tissue);
  const float end = ImGui::GetContentRegionMax().x - EyeWidth();
  {
    const PaddedRow padded(ui);
    const float room = ImGui::GetContentRegionAvail().x - EyeWidth() - ui.Px(14);
    if (ImGui::Selectable(name.c_str(), state.tissue == tissue, 0, {room, 0})) {
      if (state.tissue != tissue)
        state.steps.tissue->ball = state.steps.tissue->cut = state.steps.tissue->region = -1;
      state.tissue = tissue;
    }
    RecordItem(ui, name, true, state.tissue == tissue ? "on" : "off");
  }
  ImGui::SameLine(end);
  Eye(ui, state, tissue, name);
  ImGui::PopID();
}

}  // namespace

void TissuePanel(Ui& ui, EditorState& state, const std::function<void()>& below_poke) {
  const authoring::Document document = state.document();  // a copy: edits below move it
  CommandRow(ui, state,
             {{"import-surface"}, {"add-solid"}, {"library", state.steps.tissue->shelf->is_open}});
  if (state.steps.tissue->shelf->is_open && CommandOf(state, "library").enabled(state))
    return TissueLibraryFields(ui, state);
  const auto& tissues = document.scene.tissues;
  if (tissues.empty()) {
    if (!document.panorama) return AskForPanorama(ui, state, "Tissue is placed on a panorama.");
    QuietText(ui,
              "No tissue yet. Import a closed surface of a meniscus or cartilage, or take one from "
              "the library.");
    return;
  }
  for (int i = 0; i < static_cast<int>(tissues.size()); ++i)
    TissueRow(ui, state, i, tissues[static_cast<std::size_t>(i)].name);
  if (state.tissue < 0 || state.tissue >= static_cast<int>(tissues.size())) return;
  ImGui::Separator();
  const Tissue tissue = tissues[static_cast<std::size_t>(state.tissue)];

  PokeFields(ui, state, below_poke);
  Gap(ui);
  const bool is_solid = IsSolidFile(tissue.surface);
  std::vector<std::pair<TissuePage, const char*>> pages = {{TissuePage::kPlace, "Place"},
                                                           {TissuePage::kMaterial, "Material"},
                                                           {TissuePage::kMesh, "Mesh"},
                                                           {TissuePage::kHold, "Hold"},
                                                           {TissuePage::kCut, "Cut"}};
  if (is_solid)
    pages.insert(pages.begin() + 1, {TissuePage::kSolid, "Solid"});
  else if (state.steps.tissue->page == TissuePage::kSolid)
    state.steps.tissue->page = TissuePage::kPlace;
  // Widths of the words, plus equal shares of the remaining space; two rows of three for a solid,
  // and where there is no room for the words.
  const float room = ImGui::GetContentRegionAvail().x;
  float words_width = static_cast<float>(pages.size() - 1) * ui.Px(4);
  for (const auto& [page, words] : pages) words_width += ui.WidthOf(words);
  const std::size_t in_row = is_solid || words_width > room ? 3 : pages.size();
  for (std::size_t i = 0; i < pages.size(); ++i) {
    const auto [page, words] = pages[i];
    const std::size_t first = i / in_row * in_row;
    const std::size_t here = std::min(in_row, pages.size() - first);
    float free = room - static_cast<float>(here - 1) * ui.Px(4);
    for (std::size_t k = first; k < first + here; ++k) free -= ui.WidthOf(pages[k].second);
    const float page_width = ui.WidthOf(words) + free / static_cast<float>(here);
    if (i != first) ImGui::SameLine(0, ui.Px(4));
    if (ToggleButton(ui, words, state.steps.tissue->page == page, true, {page_width, 0})) {
      if (state.steps.tissue->page != page) {
        state.steps.tissue->ball = -1;  // it counts the balls of its page
        state.message.clear();          // it spoke of the page before
      }
      state.steps.tissue->page = page;
      state.steps.tissue->brush.reset();
      state.steps.tissue->cut_brush.kind = CutBrush::Kind::kNone;
    }
  }
  Gap(ui);
  switch (state.steps.tissue->page) {
    case TissuePage::kPlace:
      PlaceFields(ui, state, tissue);
      break;
    case TissuePage::kSolid:
      SolidFields(ui, state);
      break;
    case TissuePage::kMaterial:
      MaterialFields(ui, state, tissue);
      break;
    case TissuePage::kMesh:
      MeshFields(ui, state, tissue,
                 document.surfaces[static_cast<std::size_t>(state.tissue)].get());
      break;
    case TissuePage::kHold:
      HeldFields(ui, state, tissue);
      break;
    case TissuePage::kCut:
      TissueCutFields(ui, state, tissue);
      break;
  }
}

}  // namespace arthro::app
