// Step 5 in the editor, and the panel beside the large picture while a practice runs.
#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/fixed_window.h"
#include "app/state/clock_words.h"
#include "app/state/command.h"
#include "app/steps/practice/film.h"
#include "app/steps/practice/practice_step.h"
#include "app/steps/practice/rig_edit.h"
#include "simulation/core/units.h"
#include "simulation/practice/hands/offered_instruments.h"
#include "simulation/practice/shaft_notice.h"

namespace arthro::app {
namespace {

// Above it tissue is hurt; marked on the bar, which goes on a little.
constexpr double kForceOfHarm = simulation::kSafeProbingForce;
constexpr double kForceOfFullBar = 10.0;  // N
constexpr double kForceOfCare = 3.0;      // N: amber from here

std::string ContactWords(const EditorState& state, int contact) {
  if (contact == simulation::kNoContact) return "nothing";
  if (contact == simulation::kBackdropContact) return "joint surface";
  const auto& tissues = state.document().scene.tissues;
  const auto index = static_cast<std::size_t>(contact - 1);
  return index < tissues.size() ? tissues[index].name : "tissue";
}

// Advice to the trainee about a hand that gets no force.
const char* FaultWords(simulation::Fault fault) {
  switch (fault) {
    case simulation::Fault::kNone:
      return "";
    case simulation::Fault::kNoSample:
      return "No force: the device gives no position.";
    case simulation::Fault::kStale:
      return "No force: the device pauses.";
    case simulation::Fault::kLost:
      return "No force: the device is lost; check its cable.";
    case simulation::Fault::kNotFinite:
      return "No force: the device sent something unreadable.";
    case simulation::Fault::kTooFar:
      return "No force: the device reports that the hand is metres away.";
    case simulation::Fault::kTooFast:
      return "No force: the hand is too fast; slow down.";
    case simulation::Fault::kNotArmed:
      return "No force: hold the dead-man of the device.";
    case simulation::Fault::kTissue:
      return "No force: the tissue was reset.";
  }
  return "";
}

void ForceBar(Ui& ui, double force, double peak) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = ui.Px(26);
  const auto at = [&](double newton) {
    return corner.x + width * static_cast<float>(std::clamp(newton / kForceOfFullBar, 0.0, 1.0));
  };
  const unsigned colour = force < kForceOfCare ? kGood : force < kForceOfHarm ? kWarning : kBad;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(corner, {corner.x + width, corner.y + height},
                      ImGui::GetColorU32(ImGuiCol_FrameBg), ui.Px(4));
  if (force > 0)
    draw->AddRectFilled(corner, {std::max(at(force), corner.x + ui.Px(3)), corner.y + height},
                        colour, ui.Px(4));
  // The largest force so far as a line, and where care begins as a thin one.
  // With dark edges, so that they are seen on a bar of any colour.
  const auto mark = [&](double newton, unsigned of_colour, double thick) {
    draw->AddLine({at(newton), corner.y}, {at(newton), corner.y + height}, 0xD0000000,
                  ui.Px(thick + 2));
    draw->AddLine({at(newton), corner.y}, {at(newton), corner.y + height}, of_colour, ui.Px(thick));
  };
  mark(kForceOfCare, kQuiet, 1);
  mark(kForceOfHarm, kBad, 2);
  if (peak > 0) mark(peak, 0xFFFFFFFF, 2);
  ImGui::Dummy({width, height});
  RecordItem(ui, "Force bar", true, fmt::format("{:.2f} N", force), WidgetKind::kShown);
}

// Only the regions that something was taken of.
void TakenByRegion(Ui& ui, const EditorState& state, const simulation::BodyPicture& body) {
  const auto& tissue = state.document().scene.tissues[static_cast<std::size_t>(body.tissue)];
  for (std::size_t i = 0; i < body.cut.by_region.size(); ++i)
    if (const double mm3 = body.cut.by_region[i] * 1e9; mm3 >= 0.05)
      QuietText(ui, fmt::format("{:.1f} mm³ of {}, {}", mm3, tissue.name,
                                i < tissue.regions.size() ? tissue.regions[i].name : kElsewhere));
}

double Taken(const EditorState& state) {
  double removed = 0;
  if (const auto* world = state.practice->tissues())
    for (const auto& body : world->bodies) removed += body.cut.removed;
  return removed;
}

// How the camera's head is held, and by how much it was turned from there.
void CameraHead(Ui& ui, EditorState& state) {
  const double turn = DegreesFromRadians(state.steps.practice->head.turn);
  QuietText(ui, std::abs(turn) < 0.5 ? std::string("Camera head (T, U; G and H turn it)")
                                     : fmt::format("Camera head, turned {:.0f}° to the {}",
                                                   std::abs(turn), turn < 0 ? "left" : "right"));
  ImGui::PushButtonRepeat(true);
  CommandRow(ui, state,
             {{"head-with-scope", !state.steps.practice->head.is_upright},
              {"head-upright", state.steps.practice->head.is_upright},
              {"head-left", false},
              {"head-right", false}},
             ui.Px(kThumbButton));
  ImGui::PopButtonRepeat();
}

// Instrument in the hand, and the volume that was removed.
void Instruments(Ui& ui, EditorState& state) {
  QuietText(ui, "Instrument (C closes or runs it)");
  using simulation::ToolKind;
  const ToolKind kind = state.practice->instrument_kind();
  CommandRow(ui, state,
             {{"instrument-probe", kind == ToolKind::kProbe},
              {"instrument-punch", kind == ToolKind::kPunch},
              {"instrument-shaver", kind == ToolKind::kShaver},
              {"instrument-grasper", kind == ToolKind::kGrasper}},
             ui.Px(kThumbButton));
  if (const std::size_t offered = simulation::OfferedInstruments(state.document().scene).size();
      offered < static_cast<std::size_t>(ToolKind::kGrasper))
    QuietText(ui, fmt::format("This scene offers {} of {}; the rig page of step 5 offers more.",
                              offered, static_cast<int>(ToolKind::kGrasper)));
  const auto* world = state.practice->tissues();
  if (world == nullptr) return;
  const double removed = Taken(state);
  int debris = 0;
  for (const auto& body : world->bodies) debris += body.cut.debris;
  const double mm3 = removed * 1e9;
  Text(ui, debris == 0   ? fmt::format("{:.1f} mm³ removed", mm3)
           : debris == 1 ? fmt::format("{:.1f} mm³ removed, 1 loose piece", mm3)
                         : fmt::format("{:.1f} mm³ removed, {} loose pieces", mm3, debris));
  for (const auto& body : world->bodies) TakenByRegion(ui, state, body);
}

// A lit dot and how long the film is, at the right of a line of text whose top is `top`; under it
// how many pictures were left out.
void FilmMark(Ui& ui, const EditorState& state, float top) {
  if (!state.steps.practice->film) return;
  const ImVec2 back = ImGui::GetCursorPos();
  const float left = ui.Px(190);
  ImGui::SetCursorPos({left + ui.Px(18), top});
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ColouredText(ui,
               state.steps.practice->film->is_ending()
                   ? std::string("Writing the film")
                   : "Recording " + ClockWords(FilmSeconds(state)),
               kBad);
  ImGui::GetWindowDrawList()->AddCircleFilled(
      {corner.x - ui.Px(11), corner.y + 0.5f * ImGui::GetTextLineHeight()}, ui.Px(6), kBad);
  if (const int left_out = state.steps.practice->film->left_out(); left_out > 0) {
    ImGui::SetCursorPosX(left);
    QuietText(ui, left_out == 1 ? std::string("1 picture left out")
                                : fmt::format("{} pictures left out", left_out));
  }
  ImGui::SetCursorPos(back);
}

// Results of the last film and of the trainee's screen. Returns whether there was any.
bool ScreenNews(Ui& ui, const EditorState& state) {
  const std::string& of_screen = state.steps.practice->trainee_screen.words;
  if (!of_screen.empty()) QuietText(ui, of_screen);
  if (state.steps.practice->film || state.steps.practice->film_words.empty())
    return !of_screen.empty();
  if (state.steps.practice->is_film_lost)
    ColouredText(ui, state.steps.practice->film_words, kWarning);
  else
    QuietText(ui, state.steps.practice->film_words);
  return true;
}

// Devices that a rig names and that are missing. Returns whether there was any message.
bool MissingDevices(Ui& ui, const EditorState& state) {
  bool is_any = state.steps.practice->hands->is_zero_force();
  for (const auto role : {simulation::DeviceRole::kScope, simulation::DeviceRole::kInstrument})
    if (const std::string sentence = state.steps.practice->hands->Missing(role); !sentence.empty())
      ColouredText(ui, sentence, kWarning), is_any = true;
  if (state.steps.practice->hands->is_zero_force())
    ColouredText(ui, "Zero-force mode: no device pushes. Press 0 to end it.", kWarning);
  return is_any;
}

unsigned ColourOfForce(double force) {
  return force < kForceOfCare ? kBright : force < kForceOfHarm ? kWarning : kBad;
}

}  // namespace

void SessionStrip(Ui& ui, const EditorState& state) {
  if (!state.practice) return;
  const auto& instrument = state.practice->snapshot().instrument;
  const double force = glm::length(instrument.tip_force);
  ColouredText(ui,
               fmt::format("{}   {:.2f} N on {}", ClockWords(state.practice->snapshot().t), force,
                           ContactWords(state, instrument.contact)),
               ColourOfForce(force));
  ForceBar(ui, force, state.practice->peak_force());
  Gap(ui);
}

void PracticeStepPanel(Ui& ui, EditorState& state) {
  if (state.steps.practice->shows_devices) return DevicesPanel(ui, state);
  if (state.steps.practice->rig->is_shown) return RigPanel(ui, state);
  Text(ui, "Practise in the scene as it stands. Esc brings you back to exactly this place.");
  Gap(ui);
  CommandButton(ui, state, "practise", {-FLT_MIN, ui.Px(48)});
  const float half = (ImGui::GetContentRegionAvail().x - ui.Px(8)) / 2;
  CommandButton(ui, state, "devices", {half, ui.Px(48)});
  ImGui::SameLine(0, ui.Px(8));
  CommandButton(ui, state, "rig", {half, ui.Px(48)});
  MissingDevices(ui, state);
  Gap(ui);
  QuietText(ui,
            "Drag over the picture to swing the scope; turn the wheel to move it in and out. The "
            "right button moves the instrument. Press ? for help.");
  Gap(ui);
  ForcePanel(ui, state);
}

void PracticePanel(Ui& ui, EditorState& state, const Area& area) {
  const FixedWindow window(ui, "practice", area, kPageWindow);
  const auto& practice = *state.practice;
  const auto& instrument = practice.snapshot().instrument;
  const double force = glm::length(instrument.tip_force);

  const std::string title = state.document().scene.title;
  Heading(ui, title.empty() ? "Practice" : title);
  const float top = ImGui::GetCursorPosY();
  QuietText(ui, "Time");
  LargeText(ui, ClockWords(practice.snapshot().t));
  FilmMark(ui, state, top);

  QuietText(ui, "Force on the tissue");
  LargeText(ui, fmt::format("{:.2f} N", force), ColourOfForce(force));
  ForceBar(ui, force, practice.peak_force());
  QuietText(ui, fmt::format("largest {:.2f} N; care {:.0f} N (grey), harm {:.1f} N (red)",
                            practice.peak_force(), kForceOfCare, kForceOfHarm));
  Gap(ui);
  QuietText(ui, "The instrument touches");
  Heading(ui, ContactWords(state, instrument.contact));
  if (instrument.fault != simulation::Fault::kNone)
    ColouredText(ui, FaultWords(instrument.fault), kWarning);

  Gap(ui);
  const auto& pose = practice.snapshot().scope.pose;
  QuietText(ui, fmt::format("Scope: {:.0f}° view angle, {:.1f} mm deep",
                            DegreesFromRadians(practice.view_angle()), MmFromMetres(pose.depth)));
  const float width = (ImGui::GetContentRegionAvail().x - 3 * ui.Px(6)) / 4;
  int column = 0;
  for (const int degrees : {0, 30, 70, 90}) {
    if (column++ > 0) ImGui::SameLine(0, ui.Px(6));
    const bool chosen = std::abs(practice.view_angle() - RadiansFromDegrees(degrees)) < 1e-6;
    CommandToggle(ui, state, "view-" + std::to_string(degrees), chosen,
                  {width, ui.Px(kThumbButton)});
  }
  Gap(ui);
  CameraHead(ui, state);
  Gap(ui);
  Instruments(ui, state);
  Gap(ui);
  const bool is_disturbed = state.steps.practice->disturbing.now.is_any();
  if (Taken(state) > 0)
    CommandRow(ui, state,
               {{"reset-hands", false}, {"disturbances", is_disturbed}, {"reset-tissues", false}},
               ui.Px(kThumbButton));
  else
    CommandRow(ui, state, {{"reset-hands", false}, {"disturbances", is_disturbed}},
               ui.Px(kThumbButton));
  Gap(ui);
  // Missing devices are more urgent than the hint, and there is room for one of them.
  if (!MissingDevices(ui, state) && !ScreenNews(ui, state)) {
    if (const char* notice = simulation::ShaftNotice(instrument); *notice != '\0')
      ColouredText(ui, notice, kWarning);
    else
      QuietText(
          ui,
          "Left drag and wheel: scope. Right drag and Ctrl+wheel: instrument. Roll: Shift+wheel.");
  }

  // At the foot, where it is not pressed by chance.
  const float foot = 2 * ui.Px(kThumbButton) + ui.Px(22);
  const float free = ImGui::GetContentRegionAvail().y - foot;
  if (free > 0) ImGui::Dummy({0, free - ImGui::GetStyle().ItemSpacing.y});
  CommandRow(ui, state,
             {{"record", state.steps.practice->film != nullptr},
              {"outside", state.steps.practice->shows_outside},
              {"full-screen", state.full_screen},
              {"budget", false},
              {"help", false}},
             ui.Px(kThumbButton));
  CommandRow(ui, state,
             {{"trainee-screen", state.steps.practice->trainee_screen.is_wanted},
              {"devices", false},
              {"leave-practice", false}},
             ui.Px(kThumbButton));
}

}  // namespace arthro::app
