#include "app/steps/portals/reach_fields.h"

#include <cmath>
#include <string>

#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/widgets.h"
#include "app/steps/portals/portals_step.h"
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

}  // namespace

void ReachFields(Ui& ui, EditorState& state) {
  ReachBoard& board = state.steps.portals->reach;
  const double spacing = state.document().scene.portals.incision_spacing;
  if (std::abs(spacing) < kLeastSpacing)
    Text(ui, "The rods are about 4 mm thick, so portals nearer than 10 mm leave them no room.");
  QuietText(ui, fmt::format("The rods are held at {:.0f}° to each other. 45° to 75° is recommended "
                            "for two instruments.",
                            DegreesFromRadians(AngleBetweenRods(state))));
  for (const std::string& conflict : ShaftConflictWords(state))
    ColouredText(ui, conflict, kWarning);
  const bool has_panorama = state.document().panorama != nullptr;
  if (ToggleButton(ui, "Show reach", board.is_shown, has_panorama, {},
                   "Colour the overview by what scope and instrument reach through these portals."))
    board.is_shown = !board.is_shown;
  ImGui::SameLine(0, ui.Px(6));
  const auto& tissues = state.document().scene.tissues;
  const int target = state.tissue >= 0 && state.tissue < static_cast<int>(tissues.size())
                         ? state.tissue
                         : (tissues.empty() ? -1 : 0);
  const std::string target_name =
      target < 0 ? "the relief" : tissues[static_cast<std::size_t>(target)].name;
  if (Button(ui, "Suggest spacing", has_panorama && !state.jobs.busy(), {0, 0},
             ("Set the spacing at which most of " + target_name +
              " is seen and touched with the rods at 45° to 75°.")
                 .c_str()))
    SuggestSpacing(state, target);
  if (!board.is_shown || !has_panorama) return;
  if (board.jobs.busy()) QuietText(ui, "Being computed…");
  if (!board.made) return;
  Legend(ui);
  Shares(ui, "Relief", board.made->reach.relief);
  for (std::size_t i = 0; i < board.made->reach.tissues.size() && i < tissues.size(); ++i)
    Shares(ui, tissues[i].name, board.made->reach.tissues[i]);
}

}  // namespace arthro::app
