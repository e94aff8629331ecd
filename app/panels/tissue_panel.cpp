// Step 3: deformable models in the scene.
#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <imgui.h>

#include "app/commands/command_list.h"
#include "app/commands/edits.h"
#include "app/commands/tissue_pose.h"
#include "app/panels/panels.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

constexpr const char* kAxes[] = {"right", "down", "in"};

// Three numbers in a row, with the label above.
Change Row(Ui& ui, const std::string& name, glm::dvec3& values, double step, double low,
           double high, const char* format) {
  Change row;
  QuietText(ui, name);
  const float width = (ImGui::GetContentRegionAvail().x - 2 * ui.Px(6)) / 3;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis > 0) ImGui::SameLine(0, ui.Px(6));
    ImGui::SetNextItemWidth(width);
    const Change one = NumberField(ui, name + ", " + kAxes[axis], values[axis], step, low, high,
                                   format, "Drag, or double-click to type.");
    row.changed = row.changed || one.changed;
    row.held = row.held || one.held;
    row.released = row.released || one.released;
  }
  return row;
}

void PoseFields(Ui& ui, EditorState& state, const Tissue& tissue) {
  Tissue changed = tissue;
  glm::dvec3 position_mm = tissue.pose.position / kMetrePerMillimetre;
  Change change = Row(ui, "Position (right, down, in)", position_mm, 0.1, -200, 200, "%.1f mm");
  if (change) {
    changed.pose.position = position_mm * kMetrePerMillimetre;
    SetTissue(state, state.tissue, changed, "Move");
  }
  if (change.held) state.dragging = true;
  if (change.released) EndDrag(state);

  glm::dvec3 degrees = DegreesOf(tissue.pose.quaternion);
  change = Row(ui, "Rotation (about right, down, in)", degrees, 0.5, -180, 180, "%.1f°");
  if (change) {
    changed.pose.quaternion = QuaternionOf(degrees);
    SetTissue(state, state.tissue, changed, "Turn");
  }
  if (change.held) state.dragging = true;
  if (change.released) EndDrag(state);

  double scale = tissue.pose.scale;
  change = Slider(ui, "Scale", scale, 0.1, 5.0, "× %.2f");
  if (change) {
    changed.pose.scale = scale;
    SetTissue(state, state.tissue, changed, "Scale");
  }
  if (change.held) state.dragging = true;
  if (change.released) EndDrag(state);
}

}  // namespace

void TissuePanel(Ui& ui, EditorState& state) {
  const authoring::Document document = state.document();  // a copy: edits below move it
  CommandButton(ui, state, "import-surface", {-FLT_MIN, 0});
  const auto& tissues = document.scene.tissues;
  if (tissues.empty()) {
    QuietText(ui, document.panorama
                      ? "No tissue yet. Import a closed surface of a meniscus or cartilage."
                      : "Tissue is laid onto a panorama; import one first.");
    return;
  }
  for (int i = 0; i < static_cast<int>(tissues.size()); ++i) {
    const std::string& name = tissues[static_cast<std::size_t>(i)].name;
    ImGui::PushID(i);
    if (ImGui::Selectable(name.c_str(), state.tissue == i)) state.tissue = i;
    RecordItem(ui, name, true, state.tissue == i ? "on" : "off");
    ImGui::PopID();
  }
  if (state.tissue < 0 || state.tissue >= static_cast<int>(tissues.size())) return;
  ImGui::Separator();
  const Tissue tissue = tissues[static_cast<std::size_t>(state.tissue)];

  std::string name = tissue.name;
  if (TextField(ui, "Name", name) && !name.empty()) {
    Tissue changed = tissue;
    changed.name = name;
    SetTissue(state, state.tissue, changed, "Rename");
    EndDrag(state);
  }
  PoseFields(ui, state, tissue);
  QuietText(ui, "Or drag the box around it in the overview.");
  Gap(ui);
  const auto& surface = document.surfaces[static_cast<std::size_t>(state.tissue)];
  QuietText(ui, fmt::format("{} triangles, {}", surface ? surface->triangles.size() : 0,
                            tissue.mesh.empty() ? "no tetrahedra yet" : "filled with tetrahedra"));
  CommandButton(ui, state, "tetrahedralise", {-FLT_MIN, 0});
  const float half = (ImGui::GetContentRegionAvail().x - ui.Px(8)) / 2;
  CommandButton(ui, state, "duplicate-tissue", {half, 0});
  ImGui::SameLine(0, ui.Px(8));
  CommandButton(ui, state, "remove-tissue", {half, 0});
}

}  // namespace arthro::app
