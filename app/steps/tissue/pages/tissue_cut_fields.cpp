// Cut page of a tissue: the cuts that a trainee begins with, and the regions for which the removed
// volume is reported.
#include <algorithm>
#include <functional>
#include <string>

#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/chosen_row.h"
#include "app/panels/command_button.h"
#include "app/panels/fixed_window.h"
#include "app/state/command.h"
#include "app/state/edits.h"
#include "app/steps/tissue/cut/tissue_cut.h"
#include "app/steps/tissue/tissue_step.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

void MmSlider(Ui& ui, EditorState& state, const char* name, double metres, double least,
              double most, const char* help, void (*set)(EditorState&, double)) {
  double mm = MmFromMetres(metres);
  const Change change = Slider(ui, name, mm, least, most, "%.1f mm", help);
  if (change) set(state, MetresFromMm(mm));
  if (change.held) state.dragging = true;
  if (change.released) EndDrag(state);
}

// A frame with a line for each; `choose` gets the one that is clicked.
void List(Ui& ui, const char* id, int count, int chosen,
          const std::function<std::string(int)>& name, const std::function<std::string(int)>& words,
          const std::function<void(int)>& choose) {
  if (count == 0) return ScrollToListOf(id, -1);
  constexpr int kMostRows = 4;
  const float row = ImGui::GetTextLineHeightWithSpacing();
  ImGui::BeginChild(id, {0, static_cast<float>(std::min(count, kMostRows)) * row + ui.Px(14)},
                    true);
  for (int i = 0; i < count; ++i) {
    ImGui::PushID(i);
    if (ImGui::Selectable((name(i) + ": " + ui.In(words(i))).c_str(), chosen == i)) choose(i);
    ScrollToChosen(i, chosen);
    RecordItem(ui, name(i), true, chosen == i ? "on" : "off");
    ImGui::PopID();
  }
  ImGui::EndChild();
  ScrollToListOf(id, chosen);
}

void BrushButton(Ui& ui, EditorState& state, const char* id, CutBrush::Kind kind, float width) {
  CommandToggle(ui, state, id, state.steps.tissue->cut_brush.kind == kind, {width, 0});
}

// Sizes of the chosen cut; with none chosen, of the next cut.
void Sizes(Ui& ui, EditorState& state, const Tissue& tissue) {
  const Cut* cut = ChosenCut(state);
  const bool is_next = cut == nullptr;
  const double scale = tissue.pose.scale;
  const CutBrush& brush = state.steps.tissue->cut_brush;
  const auto* tear = cut ? std::get_if<TearCut>(cut) : nullptr;
  const auto* bite = cut ? std::get_if<CapsuleCut>(cut) : nullptr;
  if (tear || (is_next && brush.kind == CutBrush::Kind::kTear)) {
    const double depth = tear ? tear->depth * scale : brush.depth,
                 width = tear ? tear->width * scale : brush.width;
    MmSlider(ui, state, "Tear depth", depth, 0.5, 15.0,
             "A tear deeper than the tissue is thick goes through it.", SetTearDepth);
    MmSlider(ui, state, "Tear width", width, 0.5, 4.0, "Width of the open slot at rest.",
             SetTearWidth);
  }
  if (bite || (is_next && brush.kind == CutBrush::Kind::kBite))
    MmSlider(ui, state, "Bite radius", bite ? bite->radius * scale : brush.radius, 0.5, 8.0,
             "Basket forceps take about 1.7 mm.", SetBiteRadius);
  if (tissue.cuts.empty()) return;
  const float half = (ImGui::GetContentRegionAvail().x - ui.Px(8)) / 2;
  CommandButton(ui, state, "remove-cut", {half, 0});
  ImGui::SameLine(0, ui.Px(8));
  CommandButton(ui, state, "remove-all-cuts", {half, 0});
}

// Name and radius of the chosen region; with none chosen, of the next region.
void RegionFields(Ui& ui, EditorState& state, const Tissue& tissue) {
  const double scale = tissue.pose.scale;
  double radius = state.steps.tissue->cut_brush.region_radius;
  if (const Region* region = ChosenRegion(state)) {
    radius = region->ball.radius * scale;
    std::string name = region->name;
    if (TextField(ui, "Region name", name, "name in the report")) {
      RenameRegion(state, name);
      EndDrag(state);
    }
  }
  MmSlider(ui, state, "Region radius", radius, 1.0, 30.0,
           "Radius of the ball whose tissue is the region.", SetRegionRadius);
  CommandButton(ui, state, "remove-region", {-FLT_MIN, 0});
}

}  // namespace

void TissueCutFields(Ui& ui, EditorState& state, const Tissue& tissue) {
  if (tissue.mesh.empty() && !tissue.is_implicit) {
    ColouredText(ui, "Cuts need tetrahedra. Make them on the Mesh page first.", kWarning);
    return;
  }
  QuietText(ui, tissue.cuts.empty() ? "Whole. A trainee begins with what you cut here."
                                    : "A trainee begins with these cuts made.");
  // Above the lists, so that they keep their place while these grow.
  const float third = (ImGui::GetContentRegionAvail().x - 2 * ui.Px(8)) / 3;
  BrushButton(ui, state, "cut-tear", CutBrush::Kind::kTear, third);
  ImGui::SameLine(0, ui.Px(8));
  BrushButton(ui, state, "cut-bite", CutBrush::Kind::kBite, third);
  ImGui::SameLine(0, ui.Px(8));
  BrushButton(ui, state, "cut-region", CutBrush::Kind::kRegion, third);
  List(
      ui, "cuts", static_cast<int>(tissue.cuts.size()), state.steps.tissue->cut,
      [&](int i) { return CutName(tissue, i); }, [&](int i) { return CutWords(tissue, i); },
      [&](int i) { ChooseCut(state, i); });
  if (!tissue.regions.empty())
    QuietText(ui, "The removed volume is reported for these regions, and for the rest.");
  List(
      ui, "regions", static_cast<int>(tissue.regions.size()), state.steps.tissue->region,
      [&](int i) { return tissue.regions[static_cast<std::size_t>(i)].name; },
      [&](int i) {
        const Ball& ball = tissue.regions[static_cast<std::size_t>(i)].ball;
        return fmt::format("radius {:.1f} mm", MmFromMetres(ball.radius * tissue.pose.scale));
      },
      [&](int i) { ChooseRegion(state, i); });
  const bool is_region = ChosenRegion(state) != nullptr ||
                         (ChosenCut(state) == nullptr &&
                          state.steps.tissue->cut_brush.kind == CutBrush::Kind::kRegion);
  if (is_region)
    RegionFields(ui, state, tissue);
  else
    Sizes(ui, state, tissue);
  const bool shows_tears = Section(ui, "Tears of a meniscus");
  if (ImGui::IsItemToggledOpen()) ImGui::SetScrollHereY(0.0f);
  if (shows_tears) TissueTearFields(ui, state);
}

}  // namespace arthro::app
