// Costs by item as bars of their allowance, the verdicts, and the change that helps most.
#include <string>

#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/fixed_window.h"
#include "app/steps/budget/frame_budget.h"
#include "app/steps/practice/practice_step.h"

namespace arthro::app {
namespace {

constexpr double kNothing = 1e-4;  // s; a stage that draws nothing takes less

unsigned ColourOf(const std::optional<double>& share) {
  if (!share) return kQuiet;
  return *share > 1.0 ? kBad : *share > kTight ? kWarning : kGood;
}

// A line with the name on the left and the time on the right, and a bar below it.
void Item(Ui& ui, const std::string& name, double seconds, double allowance,
          const std::string& more = {}) {
  const std::string time = fmt::format("{:.2f} ms", 1e3 * seconds);
  const float width = ImGui::CalcTextSize(time.c_str()).x;
  const std::string& words = ui.In(name);
  const float left = ImGui::GetCursorPosX(), room = ImGui::GetContentRegionAvail().x;
  ShortenedText(ui, words, more.empty() ? words : words + ": " + ui.In(more),
                room - width - ui.Px(8));
  ImGui::SameLine(left + room - width);
  ImGui::TextUnformatted(time.c_str());
  MarkedBar(ui, name + " cost", seconds / allowance, ColourOf(seconds / allowance), 0, time);
}

void Judgement(Ui& ui, const Verdict& verdict) {
  if (verdict.share)
    ColouredText(ui, verdict.words, ColourOf(verdict.share));
  else
    QuietText(ui, verdict.words);
}

void TissueItems(Ui& ui, const FrameBudget& budget, const Scene& scene) {
  for (const TissueCost& cost : budget.tissues) {
    const auto at = static_cast<std::size_t>(cost.tissue);
    if (cost.step.empty() || at >= scene.tissues.size()) continue;
    Item(ui, scene.tissues[at].name, cost.step.median(), kTissueAllowance,
         cost.elements > 0 ? fmt::format("{} elements, longest step {:.1f} ms", cost.elements,
                                         1e3 * cost.step.largest())
                           : std::string("touched without elements"));
  }
}

void PictureItems(Ui& ui, const FrameBudget& budget) {
  if (budget.whole.empty()) return;
  Item(ui, "Backdrop and models", budget.scene.median(), kPictureAllowance);
  Item(ui, "Soft shade", budget.occlusion.median(), kPictureAllowance);
  if (budget.disturbances.median() > kNothing)
    Item(ui, "Disturbances", budget.disturbances.median(), kPictureAllowance);
  Item(ui, "Camera", budget.camera.median(), kPictureAllowance,
       "exposure, grain, sharpness, colour fringe and edges");
  if (budget.overview.median() > kNothing)
    Item(ui, "Overview", budget.overview.median(), kPictureAllowance);
  Item(ui, "Window and force loop", budget.rest.median(), kPictureAllowance);
}

void Costs(Ui& ui, EditorState& state) {
  const FrameBudget& budget = *state.steps.practice->budget;
  const Scene& scene = state.document().scene;
  const auto verdicts = VerdictsOf(budget, scene);
  QuietText(ui, "Medians of the newest frames and steps, measured on this machine.");
  Heading(ui, "Tissue");
  Judgement(ui, verdicts[0]);
  TissueItems(ui, budget, scene);
  Heading(ui, "Force");
  Judgement(ui, verdicts[1]);
  if (budget.force)
    Item(ui, "One tick of the force loop", budget.force->median, budget.force->period,
         fmt::format("99 of 100 ticks take at most {:.2f} ms", 1e3 * budget.force->p99));
  Heading(ui, "Picture");
  Judgement(ui, verdicts[2]);
  PictureItems(ui, budget);
  Gap(ui);
  if (const auto change = HelpfulChange(budget, scene, state.settings.moving_picture)) {
    Text(ui, "What helps most:");
    ColouredText(ui, WordsOf(*change, scene), kAccent);
    CommandButton(ui, state, "make-budget-change", {-FLT_MIN, ui.Px(40)});
  } else if (!budget.whole.empty() || !budget.tissues.empty()) {
    QuietText(ui, "Nothing needs to change.");
  }
  if (state.settings.moving_picture != MovingPicture::kAutomatic)
    CommandButton(ui, state, "full-picture", {-FLT_MIN, ui.Px(40)});
}

}  // namespace

void BudgetFields(Ui& ui, EditorState& state) {
  const bool is_shown = state.steps.practice->budget->is_shown;
  CommandToggle(ui, state, "budget", is_shown, {-FLT_MIN, 0});
  if (is_shown) Costs(ui, state);
}

void BudgetPage(Ui& ui, EditorState& state, const Area& area) {
  const FixedWindow window(ui, "budget", area, kPageWindow);
  Heading(ui, "Budget");
  Costs(ui, state);
  Gap(ui);
  if (Button(ui, "Hide the budget", true, {-FLT_MIN, ui.Px(44)})) Run(state, "budget");
  if (!state.message.empty()) QuietText(ui, state.message);
}

}  // namespace arthro::app
