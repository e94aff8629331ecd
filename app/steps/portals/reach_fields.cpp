#include "app/steps/portals/reach_fields.h"

#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/widgets.h"
#include "app/state/command.h"
#include "app/steps/portals/portals_step.h"
#include "app/steps/portals/spacing_targets.h"
#include "simulation/core/units.h"
#include "simulation/practice/reach/reach_picture.h"

namespace arthro::app {
namespace {

using simulation::ReachShares;

// Rods are about 4 mm thick.
constexpr double kLeastSpacing = 1e-2;  // m

std::string Percent(double share) { return fmt::format("{:.0f} %", 100 * share); }

void Legend(Ui& ui) {
  for (const simulation::ReachClass reached : simulation::kReachClasses) {
    const simulation::ReachColour& colour = simulation::ColourOf(reached);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float edge = ImGui::GetTextLineHeight();
    ImGui::GetWindowDrawList()->AddRectFilled(
        at, {at.x + edge, at.y + edge}, IM_COL32(colour.rgb[0], colour.rgb[1], colour.rgb[2], 255),
        ui.Px(2));
    ImGui::Dummy({edge, edge});
    ImGui::SameLine(0, ui.Px(6));
    Text(ui, colour.words);
  }
}

void Shares(Ui& ui, const std::string& target, const ReachShares& shares) {
  std::string words = fmt::format("{}: seen {}, touched {}, both {}", target, Percent(shares.seen),
                                  Percent(shares.touched), Percent(shares.both));
  if (shares.both > 0)
    words += fmt::format("; {} with the rods at 45° to 75°, median {:.0f}°", Percent(shares.good),
                         DegreesFromRadians(shares.median_angle));
  Text(ui, words + ".");
}

// The angle between the rods as two rods with the recommended range between them, and in words.
void AngleGauge(Ui& ui, double angle) {
  const simulation::ReachLimits limits;
  const float radius = ui.Px(46), margin = ui.Px(4);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 centre{corner.x + radius + margin, corner.y + radius + margin};
  // Angles count from the scope's rod on the right, against the clock.
  const auto at = [&](double a, float r) {
    return ImVec2{centre.x + r * static_cast<float>(std::cos(a)),
                  centre.y - r * static_cast<float>(std::sin(a))};
  };
  const auto arc = [&](double from, double to, float r) {
    ImDrawList* draw = ImGui::GetWindowDrawList();
    constexpr int kParts = 24;
    for (int i = 0; i <= kParts; ++i) draw->PathLineTo(at(from + (to - from) * i / kParts, r));
  };
  const bool is_good = angle >= limits.least_angle && angle <= limits.most_angle;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->PathLineTo(centre);
  arc(limits.least_angle, limits.most_angle, radius);
  draw->PathFillConvex((kGood & 0x00FFFFFF) | 0x60000000);
  arc(0, std::numbers::pi, radius);
  draw->PathStroke(kQuiet, 0, ui.Px(1));
  for (const double edge : {limits.least_angle, limits.most_angle})
    draw->AddLine(at(edge, radius - ui.Px(6)), at(edge, radius + ui.Px(3)), kGood, ui.Px(2));
  draw->AddLine(centre, at(0, radius), kBright, ui.Px(3));
  draw->AddLine(centre, at(angle, radius), is_good ? kGood : kWarning, ui.Px(3));
  draw->AddCircleFilled(centre, ui.Px(3), kBright);
  ImGui::Dummy({2 * (radius + margin), radius + 2 * margin});
  RecordItem(ui, "Angle of the rods", true, fmt::format("{:.0f}°", DegreesFromRadians(angle)),
             WidgetKind::kShown);
  ImGui::SameLine(0, ui.Px(8));
  ImGui::BeginGroup();
  QuietText(ui, fmt::format("The rods are held at {:.0f}° to each other. 45° to 75° is recommended "
                            "for two instruments.",
                            DegreesFromRadians(angle)));
  ImGui::EndGroup();
}

CommandArguments WordsOfTargets(const EditorState& state) {
  CommandArguments words;
  for (const SpacingTarget& target : ChosenSpacingTargets(state)) words.push_back(WordsOf(target));
  return words;
}

void TargetChooser(Ui& ui, EditorState& state) {
  std::string words;
  for (const std::string& target : WordsOfTargets(state))
    words += (words.empty() ? "" : ", ") + target;
  QuietText(ui, fmt::format("Suggested for: {}", words));
  if (!Section(ui, "Targets of the suggestion")) return;
  for (const SpacingTarget& target : EverySpacingTarget(state.document().scene)) {
    bool is_chosen = IsChosen(state, target);
    if (Checkbox(ui, WordsOf(target), is_chosen,
                 "The suggested spacing suits every ticked target the same."))
      ToggleSpacingTarget(state, target);
  }
}

}  // namespace

void ReachFields(Ui& ui, EditorState& state) {
  ReachBoard& board = state.steps.portals->reach;
  const double spacing = state.document().scene.portals.incision_spacing;
  if (std::abs(spacing) < kLeastSpacing)
    Text(ui, "The rods are about 4 mm thick, so portals nearer than 10 mm leave them no room.");
  AngleGauge(ui, AngleBetweenRods(state));
  for (const ShaftFinding& conflict : FindShaftConflicts(state))
    ColouredText(ui, conflict.words, kWarning);
  const bool has_panorama = state.document().panorama != nullptr;
  if (ToggleButton(ui, "Show reach", board.is_shown, has_panorama, {},
                   "Colour the overview by what scope and instrument reach through these portals."))
    Run(state, "show-reach", {board.is_shown ? "off" : "on"});
  ImGui::SameLine(0, ui.Px(6));
  if (Button(
          ui, "Suggest spacing", has_panorama && !state.jobs.busy(), {0, 0},
          "Set the spacing at which most of the targets is seen and touched with the rods at 45° "
          "to 75°."))
    Run(state, "suggest-spacing", WordsOfTargets(state));
  TargetChooser(ui, state);
  const auto& tissues = state.document().scene.tissues;
  if (!board.is_shown || !has_panorama) return;
  if (board.jobs.busy()) QuietText(ui, "Being computed…");
  if (!board.made) return;
  Legend(ui);
  Shares(ui, "Relief", board.made->reach.relief);
  for (std::size_t i = 0; i < board.made->reach.tissues.size() && i < tissues.size(); ++i)
    Shares(ui, tissues[i].name, board.made->reach.tissues[i]);
}

}  // namespace arthro::app
