#include "app/steps/tissue/pages/axis_row.h"

namespace arthro::app {
namespace {

constexpr const char* kAxes[] = {"right", "down", "in"};

}  // namespace

Change AxisRow(Ui& ui, const std::string& name, glm::dvec3& values, double step, double low,
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

}  // namespace arthro::app
