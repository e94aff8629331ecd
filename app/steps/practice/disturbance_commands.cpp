// Disturbances of the picture of a practice, one command each.
#include <algorithm>
#include <string>

#include <GLFW/glfw3.h>

#include "app/state/command.h"
#include "app/steps/practice/practice_step.h"

namespace arthro::app {
namespace {

using State = EditorState;

template <Strength strength>
void Toggle(State& state) {
  ToggleDisturbance(state, strength);
}

constexpr DisturbanceSwitch kSwitches[] = {
    {"disturb-haze", &Disturbances::haze},
    {"disturb-bubbles", &Disturbances::bubbles},
    {"disturb-debris", &Disturbances::debris},
    {"disturb-fog", &Disturbances::fog},
    {"disturb-near-blur", &Disturbances::near_blur},
    {"disturb-far-blur", &Disturbances::far_blur},
    {"disturb-overexposure", &Disturbances::overexposure},
};

constexpr Command kDisturbanceCommands[] = {
    {"disturbances",
     "Disturbances",
     "Choose disturbances of the picture and their strength.",
     "Disturbances",
     {GLFW_KEY_F3},
     {},
     Practising,
     [](State& state) {
       state.steps.practice->disturbing.shows_panel = !state.steps.practice->disturbing.shows_panel;
       state.steps.practice->shows_devices = false;
     },
     "No practice is under way."},
    {"disturb-haze",
     "Bleeding",
     "Blood in the fluid hides distant tissue.",
     "Disturbances",
     {},
     {},
     Practising,
     Toggle<&Disturbances::haze>,
     "No practice is under way."},
    {"disturb-bubbles",
     "Bubbles",
     "Air bubbles rise, and some stay on the lens.",
     "Disturbances",
     {},
     {},
     Practising,
     Toggle<&Disturbances::bubbles>,
     "No practice is under way."},
    {"disturb-debris",
     "Debris",
     "Loose flakes and fibres drift by.",
     "Disturbances",
     {},
     {},
     Practising,
     Toggle<&Disturbances::debris>,
     "No practice is under way."},
    {"disturb-fog",
     "Fogged lens",
     "A milky veil covers the picture from the rim inwards.",
     "Disturbances",
     {},
     {},
     Practising,
     Toggle<&Disturbances::fog>,
     "No practice is under way."},
    {"disturb-near-blur",
     "Near blur",
     "The camera is focused too far away; near tissue is blurred.",
     "Disturbances",
     {},
     {},
     Practising,
     Toggle<&Disturbances::near_blur>,
     "No practice is under way."},
    {"disturb-far-blur",
     "Far blur",
     "The camera is focused too near; distant tissue is blurred.",
     "Disturbances",
     {},
     {},
     Practising,
     Toggle<&Disturbances::far_blur>,
     "No practice is under way."},
    {"disturb-overexposure",
     "Overexposed",
     "The light is too bright for the camera.",
     "Disturbances",
     {},
     {},
     Practising,
     Toggle<&Disturbances::overexposure>,
     "No practice is under way."},
    {"clear-view",
     "Clear view",
     "Switch off all disturbances.",
     "Disturbances",
     {},
     {},
     [](const State& state) {
       return Practising(state) && state.steps.practice->disturbing.now.is_any();
     },
     [](State& state) { state.steps.practice->disturbing.now = {}; },
     "No disturbance is switched on."},
};

}  // namespace

std::span<const Command> DisturbanceCommands() { return kDisturbanceCommands; }

std::span<const DisturbanceSwitch> DisturbanceSwitches() { return kSwitches; }

void ToggleDisturbance(State& state, Strength strength) {
  double& now = state.steps.practice->disturbing.now.*strength;
  now = now > 0 ? 0.0 : state.steps.practice->disturbing.chosen.*strength;
}

void SetDisturbance(State& state, Strength strength, double value) {
  const double kept = std::clamp(value, kLeastStrength, 1.0);
  state.steps.practice->disturbing.chosen.*strength = kept;
  if (state.steps.practice->disturbing.now.*strength > 0)
    state.steps.practice->disturbing.now.*strength = kept;
}

}  // namespace arthro::app
