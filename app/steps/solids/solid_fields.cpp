// Parts of the chosen solid: the list, how the chosen part joins, its sizes and its place.
#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/state/edits.h"
#include "app/steps/solids/solid_edit.h"
#include "app/steps/tissue/pages/axis_row.h"
#include "app/steps/tissue/tissue_pose.h"
#include "app/steps/tissue/tissue_step.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

constexpr double kLeastSize = 0.1, kMostSize = 30.0;  // mm, of sliders; a field takes more
constexpr double kMostBlend = 5.0, kFarthest = 50.0;  // mm

// Puts a change that sliders make: coarse while one is held, fine when it is let go.
class PartChange {
 public:
  PartChange(EditorState& state, SolidPart part) : state_(state), part_(part) {}
  SolidPart& part() { return part_; }
  void Take(const Change& change, const char* what) {
    if (change.held) state_.dragging = true;
    if (change.released) state_.dragging = false;
    if (!change.changed && !change.released) return;
    SetSolidPart(state_, part_, what);
    if (change.released) EndDrag(state_);
  }

 private:
  EditorState& state_;
  SolidPart part_;
};

void Size(Ui& ui, PartChange& edit, const char* name, double& metres) {
  double mm = MmFromMetres(metres);
  const Change change = Slider(ui, name, mm, kLeastSize, kMostSize, "%.2f mm",
                               "Size of the chosen part, in its own directions.");
  if (change) metres = MetresFromMm(mm);
  edit.Take(change, "Resize");
}

void SizeFields(Ui& ui, PartChange& edit) {
  SolidPart& part = edit.part();
  if (auto* ellipsoid = std::get_if<EllipsoidPart>(&part)) {
    Size(ui, edit, "Radius, right", ellipsoid->radii.x);
    Size(ui, edit, "Radius, down", ellipsoid->radii.y);
    Size(ui, edit, "Radius, in", ellipsoid->radii.z);
  } else if (auto* capsule = std::get_if<CapsulePart>(&part)) {
    Size(ui, edit, "Length between the ends", capsule->length);
    Size(ui, edit, "Radius", capsule->radius);
  } else if (auto* torus = std::get_if<TorusPart>(&part)) {
    Size(ui, edit, "Radius of the ring", torus->ring_radius);
    Size(ui, edit, "Radius of the tube", torus->tube_radius);
  } else if (auto* box = std::get_if<BoxPart>(&part)) {
    Size(ui, edit, "Half width, right", box->half.x);
    Size(ui, edit, "Half width, down", box->half.y);
    Size(ui, edit, "Half width, in", box->half.z);
    double mm = MmFromMetres(box->rounding);
    const double most = MmFromMetres(std::min({box->half.x, box->half.y, box->half.z}));
    const Change change = Slider(ui, "Radius of the edges", mm, 0, most, "%.2f mm",
                                 "Rounding of the edges of the box; 0: sharp edges.");
    if (change) box->rounding = std::min(MetresFromMm(mm), MetresFromMm(most));
    edit.Take(change, "Round");
  }
}

void PlaceOfPartFields(Ui& ui, PartChange& edit) {
  Rigid3& pose = PlaceOf(edit.part()).solid_from_part;
  glm::dvec3 mm = pose.translation / kMetrePerMillimetre;
  Change change = AxisRow(ui, "Centre of the part", mm, 0.1, -kFarthest, kFarthest, "%.1f mm");
  if (change) pose.translation = mm * kMetrePerMillimetre;
  edit.Take(change, "Move a part of");
  glm::dvec3 degrees = DegreesOf(pose.rotation);
  change = AxisRow(ui, "Turn of the part", degrees, 0.5, -180, 180, "%.1f°");
  if (change) pose.rotation = QuaternionOf(degrees);
  edit.Take(change, "Turn a part of");
}

void JoinFields(Ui& ui, EditorState& state, PartChange& edit, bool is_first) {
  if (is_first) {
    QuietText(ui, "The solid begins with this part; the others join it in their order.");
    return;
  }
  SolidPlace& place = PlaceOf(edit.part());
  constexpr const char* kWords[] = {"Unite", "Intersect", "Subtract"};
  const float third = (ImGui::GetContentRegionAvail().x - 2 * ui.Px(6)) / 3;
  for (int i = 0; i < 3; ++i) {
    if (i > 0) ImGui::SameLine(0, ui.Px(6));
    const auto join = static_cast<SolidJoin>(i);
    if (ToggleButton(ui, kWords[i], place.join == join, true, {third, 0}) && place.join != join) {
      place.join = join;
      SetSolidPart(state, edit.part(), "Join");
      EndDrag(state);
    }
  }
  double mm = MmFromMetres(place.blend);
  Change change = Slider(ui, "Blend", mm, 0, kMostBlend, "%.2f mm",
                         "Width over which the joint is rounded; 0: a sharp edge.");
  if (change) place.blend = MetresFromMm(mm);
  edit.Take(change, "Blend");
  int level = place.level;
  change = SliderInt(ui, "Group level", level, 0, kDeepestSolidLevel, "%d",
                     "Parts in a row of a higher level are joined with one another first; the "
                     "first of them says how the group joins.");
  if (change) place.level = level;
  edit.Take(change, "Group");
}

}  // namespace

void SolidFields(Ui& ui, EditorState& state) {
  const Solid* found = ChosenSolid(state);
  SolidEditing& editing = *state.steps.tissue->solids;
  if (found == nullptr) {
    ColouredText(ui, "Its file cannot be read: " + editing.fault, kWarning);
    return;
  }
  const Solid solid = *found;  // a copy: edits below change it
  for (int i = 0; i < static_cast<int>(solid.parts.size()); ++i) {
    const SolidPart& part = solid.parts[static_cast<std::size_t>(i)];
    const SolidPlace& place = PlaceOf(part);
    constexpr const char* kJoins[] = {"+", "∩", "−"};
    const std::string words = fmt::format(
        "{:{}}{} {} {}", "", 3 * place.level,
        i == 0 ? "  " : kJoins[static_cast<std::size_t>(place.join)], ui.In(TypeOf(part)), i + 1);
    ImGui::PushID(i);
    const PaddedRow padded(ui);
    if (ImGui::Selectable(words.c_str(), editing.part == i)) editing.part = i;
    RecordItem(ui, fmt::format("Part {}", i + 1), true, editing.part == i ? "on" : "off");
    ImGui::PopID();
  }
  const float third = (ImGui::GetContentRegionAvail().x - 2 * ui.Px(6)) / 3;
  QuietText(ui, "Add a part:");
  CommandButton(ui, state, "add-ellipsoid", {third, 0});
  ImGui::SameLine(0, ui.Px(6));
  CommandButton(ui, state, "add-capsule", {third, 0});
  ImGui::SameLine(0, ui.Px(6));
  CommandButton(ui, state, "add-torus", {third, 0});
  CommandButton(ui, state, "add-box", {third, 0});
  ImGui::SameLine(0, ui.Px(6));
  CommandButton(ui, state, "add-plane", {third, 0});
  ImGui::SameLine(0, ui.Px(6));
  CommandButton(ui, state, "remove-part", {third, 0});
  if (!editing.fault.empty()) ColouredText(ui, "Not changed: " + editing.fault, kWarning);
  if (editing.part >= static_cast<int>(solid.parts.size())) return;  // it was just removed
  Gap(ui);
  PartChange edit(state, solid.parts[static_cast<std::size_t>(editing.part)]);
  JoinFields(ui, state, edit, editing.part == 0);
  SizeFields(ui, edit);
  PlaceOfPartFields(ui, edit);
  const float half = (ImGui::GetContentRegionAvail().x - ui.Px(6)) / 2;
  CommandButton(ui, state, "part-up", {half, 0});
  ImGui::SameLine(0, ui.Px(6));
  CommandButton(ui, state, "part-down", {half, 0});
}

}  // namespace arthro::app
