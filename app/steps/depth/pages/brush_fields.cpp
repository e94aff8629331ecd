// Settings of the brush that mends the depth map.
#include <cfloat>
#include <cmath>
#include <utility>

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/widgets.h"
#include "app/steps/depth/depth_step.h"
#include "app/steps/depth/pages/depth_panels.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

using authoring::StrokeKind;

constexpr std::pair<StrokeKind, const char*> kKinds[] = {
    {StrokeKind::kRaise, "Raise the surface towards the scope."},
    {StrokeKind::kLower, "Lower the surface away from the scope."},
    {StrokeKind::kSmooth, "Take the mean over half the radius of the brush."},
    {StrokeKind::kFlatten, "Lay a plane through the surface under the stroke."},
    {StrokeKind::kBrightness, "Give the surface the shape of its brightness, at its mean height."},
    {StrokeKind::kEdge, "Draw along an edge: both sides keep their height up to the line."},
    {StrokeKind::kUnknown, "Remove the depth: no touch and no parallax there."},
    {StrokeKind::kMask, "Paint over a glint or an instrument: its depth is filled from around it."},
    {StrokeKind::kKeep, "Paint over tissue that was taken for a glint."}};

void Kinds(Ui& ui, DepthBrush& brush) {
  constexpr int kColumns = 3;
  const float part = ColumnWidth(kColumns);
  int place = 0;
  for (const auto& [kind, help] : kKinds) {
    if (place++ % kColumns != 0) ImGui::SameLine();
    if (ToggleButton(ui, WordOf(kind), brush.stroke.kind == kind, true, {part, 0}, help))
      brush.stroke.kind = kind;
  }
}

bool HasAmount(StrokeKind kind) {
  return kind == StrokeKind::kRaise || kind == StrokeKind::kLower ||
         kind == StrokeKind::kBrightness;
}

bool HasStrength(StrokeKind kind) {
  return kind == StrokeKind::kSmooth || kind == StrokeKind::kFlatten ||
         kind == StrokeKind::kBrightness || kind == StrokeKind::kEdge;
}

}  // namespace

float ColumnWidth(int columns) {
  const float gaps = static_cast<float>(columns - 1) * ImGui::GetStyle().ItemSpacing.x;
  return std::floor((ImGui::GetContentRegionAvail().x - gaps) / static_cast<float>(columns));
}

void BrushFields(Ui& ui, EditorState& state) {
  DepthBrush& brush = state.steps.depth->board.brush;
  if (state.dialogs.empty() && !ImGui::GetIO().WantTextInput &&
      ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false))
    return LeaveDepthBrush(state);
  Kinds(ui, brush);
  Gap(ui);
  double radius = BrushRadius(state);
  if (Slider(ui, "Size", radius, 2, 400, "%.0f px", "Radius in pixels of the panorama: [ and ]."))
    SetBrushRadius(state, radius);
  if (HasAmount(brush.stroke.kind)) {
    double amount = MmFromMetres(brush.stroke.amount);
    if (Slider(ui, "Amount", amount, 0.05, 10, "%.2f mm",
               brush.stroke.kind == StrokeKind::kBrightness
                   ? "Height from black to white."
                   : "Height in the middle of the brush, once per stroke."))
      brush.stroke.amount = MetresFromMm(amount);
  }
  if (HasStrength(brush.stroke.kind)) {
    double strength = 100 * brush.stroke.strength;
    if (Slider(ui, "Strength", strength, 1, 100, "%.0f %%", "Share of the way to the new height."))
      brush.stroke.strength = strength / 100;
  }
  double hardness = 100 * brush.stroke.hardness;
  if (Slider(ui, "Hardness", hardness, 0, 100, "%.0f %%",
             "Share of the radius within which the brush has its full effect."))
    brush.stroke.hardness = hardness / 100;
  int falloff = static_cast<int>(brush.stroke.falloff);
  if (Combo(ui, "Falloff", falloff, {"smooth", "linear", "round"},
            "Fall of the effect from the hard core to the rim."))
    brush.stroke.falloff = static_cast<authoring::StrokeFalloff>(falloff);
  const auto& projection = state.document().scene.backdrop.projection;
  if (const auto metres = BrushRadiusOnTissue(state, projection.centre_px))
    QuietText(ui, fmt::format("{:.1f} mm on the tissue in the middle.", MmFromMetres(*metres)));
  Gap(ui);
  const int count = StrokeCount(state);
  QuietText(ui, count == 0   ? "Nothing is painted yet."
                : count == 1 ? "1 stroke; it is applied again when the map is made anew."
                             : fmt::format("{} strokes; they are applied again when the map is "
                                           "made anew.",
                                           count));
  CommandButton(ui, state, "remove-strokes", {-FLT_MIN, 0});
  CommandButton(ui, state, "leave-depth-brush", {-FLT_MIN, 0});
}

}  // namespace arthro::app
