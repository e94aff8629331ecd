// The balls of a tissue: their list, the radius of the chosen one, and the buttons that add more.
#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/chosen_row.h"
#include "app/panels/command_button.h"
#include "app/panels/fixed_window.h"
#include "app/state/command.h"
#include "app/state/edits.h"
#include "app/steps/tissue/tissue_balls.h"
#include "app/steps/tissue/tissue_step.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

// Commands of the buttons of a kind (tissue_commands.cpp).
struct Buttons {
  const char *remove, *remove_all, *brush, *at_instrument;
};
Buttons ButtonsOf(BallKind kind) {
  if (kind == BallKind::kHeld)
    return {"release-ball", "release-tissue", "hold-brush", "hold-at-instrument"};
  return {"remove-probed", "remove-all-probed", "probe-brush", "probe-at-instrument"};
}

void ListOf(Ui& ui, EditorState& state, const std::vector<Ball>& balls) {
  constexpr int kRows = 6;  // seen at once; the rest is scrolled to
  const float row = ImGui::GetTextLineHeightWithSpacing();
  const float rows = static_cast<float>(std::min<std::size_t>(balls.size(), kRows));
  ImGui::BeginChild("balls", {0, rows * row + ui.Px(14)}, true);
  for (int i = 0; i < static_cast<int>(balls.size()); ++i) {
    const glm::dvec3 mm = balls[static_cast<std::size_t>(i)].centre / kMetrePerMillimetre;
    const std::string name = fmt::format("Ball {}", i + 1);
    const std::string words = fmt::format("{}: {:.1f}, {:.1f}, {:.1f} mm", name, mm.x, mm.y, mm.z);
    if (ImGui::Selectable(ui.translation.Label(words).c_str(), state.steps.tissue->ball == i))
      state.steps.tissue->ball = i;
    ScrollToChosen(i, state.steps.tissue->ball);
    RecordItem(ui, name, true, state.steps.tissue->ball == i ? "on" : "off");
  }
  ImGui::EndChild();
}

}  // namespace

void BallFields(Ui& ui, EditorState& state, const Tissue& tissue, BallKind kind) {
  const Buttons buttons = ButtonsOf(kind);
  // Controls that add a ball come first, so that they keep their place while the list grows.
  double mm = MmFromMetres(state.steps.tissue->ball_radius);
  if (Slider(ui, "Radius of the next ball", mm, 0.2, 15.0, "%.1f mm",
             "Radius of the ball that the next click adds."))
    state.steps.tissue->ball_radius = MetresFromMm(mm);
  CommandToggle(ui, state, buttons.brush, state.steps.tissue->brush == kind, {-FLT_MIN, 0});
  CommandButton(ui, state, buttons.at_instrument, {-FLT_MIN, 0});
  const std::vector<Ball>& balls = BallsOf(tissue, kind);
  if (!balls.empty()) ListOf(ui, state, balls);
  ScrollToListOf("##list of balls", balls.empty() ? -1 : state.steps.tissue->ball);
  // A ball that was added just now is not yet in `tissue`.
  const auto chosen = static_cast<std::size_t>(std::max(state.steps.tissue->ball, 0));
  if (!HasChosenBall(state, kind) || chosen >= balls.size()) return;
  Ball ball = balls[chosen];
  mm = MmFromMetres(ball.radius * tissue.pose.scale);
  const Change change = Slider(ui, "Radius of this ball", mm, 0.2, 15.0, "%.1f mm",
                               "Radius of the ball that is chosen in the list.");
  if (change) {
    ball.radius = MetresFromMm(mm) / tissue.pose.scale;
    SetBall(state, kind, state.tissue, state.steps.tissue->ball, ball, "Change a ball of");
  }
  if (change.held) state.dragging = true;
  if (change.released) EndDrag(state);
  const float half = (ImGui::GetContentRegionAvail().x - ui.Px(8)) / 2;
  CommandButton(ui, state, buttons.remove, {half, 0});
  ImGui::SameLine(0, ui.Px(8));
  CommandButton(ui, state, buttons.remove_all, {half, 0});
}

}  // namespace arthro::app
