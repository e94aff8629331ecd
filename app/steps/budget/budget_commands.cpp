// The budget panel: show it, make the change that helps most, take back that of the picture.
#include <GLFW/glfw3.h>

#include "app/steps/budget/frame_budget.h"
#include "app/steps/practice/practice_step.h"

namespace arthro::app {
namespace {

using State = EditorState;

std::optional<BudgetChange> ChangeAtHand(const State& state) {
  return HelpfulChange(*state.steps.practice->budget, state.document().scene,
                       state.settings.moving_picture);
}

bool HasChange(const State& state) {
  const FrameBudget& budget = *state.steps.practice->budget;
  return budget.is_shown && !state.jobs.busy() && ChangeAtHand(state).has_value();
}

void MakeChange(State& state) {
  const auto change = ChangeAtHand(state);
  if (!change) return;
  Make(state, *change);
  // The measured costs are those before the change.
  FrameBudget fresh;
  fresh.is_shown = true;
  *state.steps.practice->budget = fresh;
  if (state.practice && change->tissue >= 0)
    state.message = "The change is made in the scene; the next practice uses it.";
}

// Starts to measure anew each time. From another step it is shown, whatever it was there.
void ToggleBudget(State& state) {
  const bool is_in_sight = state.practice || state.step == Step::kPractice;
  FrameBudget fresh;
  fresh.is_shown = !(is_in_sight && state.steps.practice->budget->is_shown);
  *state.steps.practice->budget = fresh;
  if (!state.practice) state.step = Step::kPractice;
  state.steps.practice->shows_devices = state.steps.practice->disturbing.shows_panel = false;
}

constexpr Command kBudgetCommands[] = {
    {"budget",
     "Budget",
     "Measure what tissue, force and picture cost on this machine, and show what would help.",
     "Practice",
     {GLFW_KEY_F3, true},
     {},
     [](const State& state) { return state.document().panorama != nullptr; },
     ToggleBudget},
    {"make-budget-change",
     "Make this change",
     "Make the change that helps most. Undo takes back a change of the scene.",
     "Practice",
     {},
     {},
     HasChange,
     MakeChange,
     "There is no change that would help."},
    {"full-picture",
     "Draw moving pictures in full",
     "Draw moving pictures as finely as the machine can.",
     "Practice",
     {},
     {},
     [](const State& state) { return state.settings.moving_picture != MovingPicture::kAutomatic; },
     [](State& state) { state.settings.moving_picture = MovingPicture::kAutomatic; },
     "Moving pictures are drawn in full already."},
};

}  // namespace

std::span<const Command> BudgetCommands() { return kBudgetCommands; }

}  // namespace arthro::app
