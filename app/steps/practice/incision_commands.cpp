// Calibration of the hands' incisions.
#include <GLFW/glfw3.h>

#include "app/steps/practice/calibrate_incision.h"

namespace arthro::app {
namespace {

using State = EditorState;
using simulation::DeviceRole;
using simulation::PivotSource;

bool Calibrating(const State& state) { return state.steps.practice->calibrating.has_value(); }

template <DeviceRole role>
bool May(const State& state) {
  return MayCalibrate(state, role);
}

template <DeviceRole role>
void Calibrate(State& state) {
  CalibrateIncision(state, role);
}

constexpr Command kIncisionCommands[] = {
    {"calibrate-scope",
     "Calibrate scope incision…",
     "Find where the incision lies in the frame of the scope's device.",
     "Incision",
     {},
     {},
     May<DeviceRole::kScope>,
     Calibrate<DeviceRole::kScope>,
     "No device that is ready holds the scope."},
    {"calibrate-instrument",
     "Calibrate instrument incision…",
     "Find where the incision lies in the frame of the instrument's device.",
     "Incision",
     {},
     {},
     May<DeviceRole::kInstrument>,
     Calibrate<DeviceRole::kInstrument>,
     "No device that is ready holds the instrument."},
    {"press-incision",
     "Press",
     "Measure the rod's pose now; a button of its handle does the same.",
     "Incision",
     {GLFW_KEY_B},
     {},
     [](const State& state) {
       return Calibrating(state) &&
              state.steps.practice->calibrating->work.source() == PivotSource::kPresses &&
              !state.steps.practice->calibrating->work.pressing();
     },
     [](State& state) { state.steps.practice->calibrating->work.Press(); },
     "A press is being measured, or this device needs none."},
    {"begin-incision-again",
     "Begin again",
     "Discard all presses and poses so far.",
     "Incision",
     {},
     {},
     Calibrating,
     [](State& state) { state.steps.practice->calibrating->work.Begin(); },
     "No calibration is under way."},
    {"use-incision",
     "Use this incision",
     "Use it for this hand at once, and save it in the rig's file.",
     "Incision",
     {},
     {},
     [](const State& state) {
       return Calibrating(state) && state.steps.practice->calibrating->work.MayBeUsed();
     },
     UseIncision,
     "The incision is not known well enough yet."},
    {"save-rig-as",
     "Save rig as…",
     "Write the rig with its new incisions into another file.",
     "Incision",
     {},
     {},
     [](const State& state) {
       return Calibrating(state) && !state.steps.practice->calibrating->outcome.empty() &&
              state.steps.practice->hands->IsInRig(state.steps.practice->calibrating->role);
     },
     SaveRigAs,
     "First use the incision."},
    {"close-calibration",
     "Close calibration",
     "Return to the devices; Esc does the same.",
     "Incision",
     {},
     {},
     Calibrating,
     EndCalibration,
     "No calibration is under way."},
};

}  // namespace

std::span<const Command> IncisionCommands() { return kIncisionCommands; }

}  // namespace arthro::app
