// The rig page: the file, a device for each hand with its rod and its limits, the devices that are
// plugged in, and the instruments that the scene offers.
#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/steps/practice/lens/grid_lens.h"
#include "app/steps/practice/practice_step.h"
#include "app/steps/practice/rig_edit.h"
#include "simulation/core/units.h"
#include "simulation/device/driver/wooden_model.h"
#include "simulation/practice/hands/offered_instruments.h"

namespace arthro::app {
namespace {

constexpr double kLeastRod = 50, kMostRod = 600;  // mm, as rig files allow
constexpr double kMostForce = 20;                 // N
constexpr double kMostStiffness = 10000;          // N/m

int IndexOf(std::span<const char* const> words, const std::string& word) {
  return static_cast<int>(std::find(words.begin(), words.end(), word) - words.begin());
}

// Names for the user of the words of rig files.
std::string FamilyName(const std::string& word) {
  if (word == "openhaptics") return "Touch (OpenHaptics)";
  const auto family = simulation::DeviceFamilyFromString(word);
  return family ? simulation::Name(*family) : word;
}
std::string ModelName(const char* word) {
  const simulation::WoodenModel* model = simulation::FindWoodenModel(word);
  return model != nullptr ? model->name : word;
}

void DeviceFields(Ui& ui, RigEditing& editing, const std::string& hand, RigDevice& device) {
  if (device.family == "wooden_haptics") {
    std::vector<std::string> models;
    for (const char* model : RigModels()) models.push_back(ModelName(model));
    int chosen = IndexOf(RigModels(), device.model);
    if (Combo(ui, hand + " arm", chosen, models, "A wrong arm pushes the wrong way.")) {
      device.model = RigModels()[static_cast<std::size_t>(chosen)];
      editing.is_changed = true;
    }
  }
  if (device.family == "razer_hydra") {
    int chosen = device.hand;
    if (Combo(ui, hand + " side", chosen, {"left", "right"},
              "Which of the two controllers holds this hand.")) {
      device.hand = chosen;
      editing.is_changed = true;
    }
  }
  if (TextField(ui, hand + " serial", device.serial, "serial number; empty: the only one"))
    editing.is_changed = true;
  for (const simulation::SurveyedDevice& found : editing.devices) {
    const std::string& serial = found.device.node.serial;
    if (ToString(found.device.family) != device.family || serial.empty()) continue;
    if (Button(ui, fmt::format("{}: take {}", hand, serial), serial != device.serial,
               {-FLT_MIN, 0})) {
      device.serial = serial;
      editing.is_changed = true;
    }
  }
}

void RodFields(Ui& ui, RigEditing& editing, const std::string& hand, RigRole& role) {
  double mm = MmFromMetres(role.mount.rod_length);
  if (Slider(ui, hand + " rod", mm, kLeastRod, kMostRod, "%.1f mm", "From the hand to the tip.")) {
    role.mount.rod_length = MetresFromMm(mm);
    editing.is_changed = true;
  }
  mm = MmFromMetres(role.hand_to_incision);
  if (Slider(ui, hand + " from hand to incision", mm, 0, kMostRod, "%.1f mm",
             "With the handle in its rest; it is checked against the rod. 0: not given.")) {
    role.hand_to_incision = MetresFromMm(mm);
    editing.is_changed = true;
  }
  if (Slider(ui, hand + " largest force", role.max_force, 0, kMostForce, "%.1f N",
             "0: what the device bears."))
    editing.is_changed = true;
  if (Slider(ui, hand + " largest stiffness", role.max_stiffness, 0, kMostStiffness, "%.0f N/m",
             "At the hand. 0: what the device renders."))
    editing.is_changed = true;
  const glm::dvec3 pivot = role.mount.pivot / kMetrePerMillimetre;
  QuietText(ui, fmt::format("Incision at {:.1f}, {:.1f}, {:.1f} mm of the device; the devices page "
                            "calibrates it in a practice.",
                            pivot.x, pivot.y, pivot.z));
}

// The hand that changes instruments may have longer and shorter ones.
void TipFields(Ui& ui, RigEditing& editing, TipOffsets& tips) {
  constexpr const char* kNames[] = {"Tip of the probe", "Tip of the punch", "Tip of the shaver",
                                    "Tip of the grasper"};
  static_assert(std::size(kNames) == std::size(kInstrumentKinds));
  constexpr double kMost = 100;  // mm, as rig files allow
  for (std::size_t i = 0; i < std::size(kNames); ++i) {
    double mm = MmFromMetres(tips.beyond_rod[i]);
    if (!Slider(ui, kNames[i], mm, -kMost, kMost, "%.1f mm",
                "Beyond the end of the rod; negative: this instrument is shorter."))
      continue;
    tips.beyond_rod[i] = MetresFromMm(mm);
    editing.is_changed = true;
  }
}

// `role` is what holds this hand; without one, mouse and keys do.
void HandFields(Ui& ui, RigEditing& editing, const std::string& hand,
                std::optional<RigRole>& role) {
  std::vector<std::string> families{""}, words{"mouse and keys"};
  for (const char* family : RigFamilies())
    if (IsHandFamily(family)) {
      families.emplace_back(family);
      words.push_back(FamilyName(family));
    }
  int chosen = 0;
  if (role)
    chosen = static_cast<int>(std::find(families.begin(), families.end(), role->device.family) -
                              families.begin());
  if (Combo(ui, hand, chosen, words, "The device that holds this hand.")) {
    if (chosen == 0) {
      role.reset();
    } else {
      if (!role) role.emplace();
      role->device = {};
      role->device.family = families[static_cast<std::size_t>(chosen)];
      if (role->device.family == "wooden_haptics") role->device.model = RigModels().front();
    }
    editing.is_changed = true;
  }
  if (!role) return;
  DeviceFields(ui, editing, hand, role->device);
  RodFields(ui, editing, hand, *role);
}

void DeviceList(Ui& ui, EditorState& state) {
  const RigEditing& editing = *state.steps.practice->rig;
  CommandButton(ui, state, "find-devices", {-FLT_MIN, 0});
  for (const simulation::SurveyedDevice& found : editing.devices) {
    const std::string& serial = found.device.node.serial;
    Text(ui, fmt::format("{}{}", simulation::Name(found.device.family),
                         serial.empty() ? "" : ", serial " + serial));
    if (HasHand(found.caps)) {
      const glm::dvec3 box = (found.caps.max_hip - found.caps.min_hip) / kMetrePerMillimetre;
      QuietText(ui, fmt::format("Workspace {:.0f} × {:.0f} × {:.0f} mm, {:.1f} N", box.x, box.y,
                                box.z, found.caps.peak_force));
    }
    if (found.can_be_used)
      QuietText(ui, found.sentence);
    else
      ColouredText(ui, found.sentence, kWarning);
  }
}

void InstrumentFields(Ui& ui, EditorState& state) {
  Heading(ui, "Instruments of this scene");
  using simulation::ToolKind;
  constexpr std::pair<ToolKind, const char*> kKinds[] = {{ToolKind::kProbe, "Offer the probe"},
                                                         {ToolKind::kPunch, "Offer the punch"},
                                                         {ToolKind::kShaver, "Offer the shaver"},
                                                         {ToolKind::kGrasper, "Offer the grasper"}};
  for (const auto& [kind, words] : kKinds) {
    bool is_offered = simulation::IsOffered(state.document().scene, kind);
    if (Checkbox(ui, words, is_offered)) OfferInstrument(state, kind, is_offered);
  }
  QuietText(ui, "A practice gives only these. They are saved with the scene.");
}

}  // namespace

void RigPanel(Ui& ui, EditorState& state) {
  RigEditing& editing = *state.steps.practice->rig;
  const float half = (ImGui::GetContentRegionAvail().x - ui.Px(8)) / 2;
  InstrumentFields(ui, state);
  Gap(ui);
  Heading(ui, "Devices");
  CommandButton(ui, state, "open-rig", {half, 0});
  ImGui::SameLine(0, ui.Px(8));
  CommandButton(ui, state, "new-rig", {half, 0});
  if (editing.rig.scope || editing.rig.instrument) {
    if (TextField(ui, "Title of the rig", editing.rig.title,
                  "name of this set of devices, such as that of its room"))
      editing.is_changed = true;
    HandFields(ui, editing, "Scope", editing.rig.scope);
    HandFields(ui, editing, "Instrument", editing.rig.instrument);
    if (editing.rig.instrument) TipFields(ui, editing, editing.rig.instrument->tip_offsets);
    CommandButton(ui, state, "save-rig", {half, 0});
    ImGui::SameLine(0, ui.Px(8));
    CommandButton(ui, state, "use-rig", {half, 0});
    if (editing.is_changed) QuietText(ui, "Save the rig before it is used.");
  } else {
    QuietText(ui, "Mouse and keys hold both hands until a rig is opened and used.");
  }
  CommandButton(ui, state, "use-no-rig", {-FLT_MIN, 0});
  if (!editing.outcome.empty()) {
    if (editing.is_fault)
      ColouredText(ui, editing.outcome, kWarning);
    else
      QuietText(ui, editing.outcome);
  }
  Gap(ui);
  GridLensFields(ui, state);
  Gap(ui);
  DeviceList(ui, state);
  Gap(ui);
  if (Button(ui, "Hide the rig", true, {-FLT_MIN, ui.Px(36)})) Run(state, "rig");
}

}  // namespace arthro::app
