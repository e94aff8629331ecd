// Practice: begin and leave it, the camera head, the instruments, the poke.
#include <optional>
#include <string>

#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include "app/state/command.h"
#include "app/steps/panorama/panorama_step.h"
#include "app/steps/practice/calibrate_incision.h"
#include "app/steps/practice/film.h"
#include "app/steps/practice/hand_motion.h"
#include "app/steps/practice/start_practice.h"
#include "app/steps/practice/tissue_poke.h"

namespace arthro::app {
namespace {

using State = EditorState;

// Measurements of a session that ends with them.
std::string SummaryOf(const simulation::Practice& practice) {
  double removed = 0;
  if (const auto* world = practice.tissues())
    for (const auto& body : world->bodies) removed += body.cut.removed;
  const int seconds = static_cast<int>(practice.snapshot().t);
  return fmt::format("It took {}:{:02} min; largest force {:.2f} N, {:.1f} mm³ removed",
                     seconds / 60, seconds % 60, practice.peak_force(), removed * 1e9);
}

constexpr double kShortSession = 60;  // s; a longer one is not ended by one touch of a key
constexpr double kAnswerTime = 10;    // s of the session for the second touch

// Returns whether the session may end: a long one asks first, since its measurements end with it.
bool MayLeave(State& state) {
  std::optional<double>& asked = state.steps.practice->asked_to_leave;
  const double now = state.practice->snapshot().t;
  const bool has_answer = asked && *asked <= now && now - *asked <= kAnswerTime;
  asked.reset();
  if (now < kShortSession || has_answer) return true;
  asked = now;
  state.message = SummaryOf(*state.practice) + ". Leave once more to end the session.";
  return false;
}

// A calibration first; an attempt at an exercise has an end of its own.
void LeavePractice(State& state) {
  if (state.steps.practice->calibrating) return EndCalibration(state);
  if (const auto end_attempt = state.steps.practice->end_attempt) return end_attempt(state);
  if (!MayLeave(state)) return;
  const double seconds = state.practice->snapshot().t;
  state.message = "Practice left. " + SummaryOf(*state.practice) + ".";
  state.practice.reset();
  state.full_screen = false;
  if (state.practice_only) state.dialogs.push_back(PracticeEndedDialog{seconds});
}

// An attempt at an exercise notes what was put back.
void NoteReset(State& state, const char* what) {
  if (const auto note = state.steps.practice->note_reset) note(state, what);
}

void ResetHands(State& state) {
  if (state.practice) {
    NoteReset(state, "both hands");
    state.practice->scope().Set(simulation::StartOfScope(state.document().scene));
    state.practice->instrument().Set(simulation::StartOfInstrument(state.document().scene));
    state.steps.practice->head.turn = 0;
  }
  state.scope = simulation::StartOfScope(state.document().scene);
  state.instrument = simulation::StartOfInstrument(state.document().scene);
  state.message = "Both hands are back at their starting poses.";
}

// Beside the practice that runs, or in the editor's last step.
void ToggleDevices(State& state) {
  const bool is_in_sight = state.practice || state.step == Step::kPractice;
  state.steps.practice->shows_devices = !(state.steps.practice->shows_devices && is_in_sight);
  state.steps.practice->disturbing.shows_panel = false;
  if (!state.practice) state.step = Step::kPractice;
}

void ToggleZeroForce(State& state) {
  state.steps.practice->hands->SetZeroForce(!state.steps.practice->hands->is_zero_force());
  state.message = state.steps.practice->hands->is_zero_force()
                      ? "Zero-force mode: forces are shown, but no device gets any."
                      : "Zero-force mode has ended.";
}

template <simulation::ToolKind kind>
bool MayTake(const State& state) {
  return Practising(state) && state.practice->Offers(kind);
}

template <simulation::ToolKind kind>
void TakeInstrument(State& state) {
  state.practice->SetInstrument(kind);
}

// However it was turned, the head is straight again.
template <bool is_upright>
void HoldHead(State& state) {
  state.steps.practice->head = {.is_upright = is_upright};
  state.message = is_upright ? "The camera head is held upright; the scope turns in it."
                             : "The camera head turns with the scope.";
}

template <int steps>
void StepHead(State& state) {
  TurnHead(state, steps * kHeadStep);
}

constexpr Command kPracticeCommands[] = {
    {"practise",
     "Practise",
     "Practise in this scene.",
     "Practice",
     {GLFW_KEY_F5},
     {GLFW_KEY_P},
     MayPractise,
     [](State& state) { StartPractice(state); }},
    {"leave-practice",
     "Leave practice",
     "Return to the editor as it was.",
     "Practice",
     {GLFW_KEY_ESCAPE},
     {},
     Practising,
     LeavePractice,
     "No practice is under way."},
    {"reset-hands",
     "Reset both hands",
     "Put both hands back to their starting poses.",
     "Practice",
     {GLFW_KEY_HOME},
     {},
     [](const State& state) { return state.document().panorama != nullptr && ShowsScope(state); },
     ResetHands},
    {"head-with-scope",
     "With scope",
     "The camera head turns with the scope, and the picture with it.",
     "Practice",
     {GLFW_KEY_T},
     {},
     Practising,
     HoldHead<false>,
     "No practice is under way."},
    {"head-upright",
     "Upright",
     "The camera head is held upright while the scope turns in it.",
     "Practice",
     {GLFW_KEY_U},
     {},
     Practising,
     HoldHead<true>,
     "No practice is under way."},
    {"head-left",
     "Turn left",
     "Turn the camera head to the left. Hold G to keep turning.",
     "Practice",
     {},
     {},
     Practising,
     StepHead<-1>,
     "No practice is under way."},
    {"head-right",
     "Turn right",
     "Turn the camera head to the right. Hold H to keep turning.",
     "Practice",
     {},
     {},
     Practising,
     StepHead<1>,
     "No practice is under way."},
    {"instrument-probe",
     "Probe",
     "Feel and lift with the hook.",
     "Practice",
     {GLFW_KEY_5},
     {},
     MayTake<simulation::ToolKind::kProbe>,
     TakeInstrument<simulation::ToolKind::kProbe>,
     "This scene or exercise does not offer it."},
    {"instrument-punch",
     "Punch",
     "Bite with the basket forceps: C closes the jaws.",
     "Practice",
     {GLFW_KEY_6},
     {},
     MayTake<simulation::ToolKind::kPunch>,
     TakeInstrument<simulation::ToolKind::kPunch>,
     "This scene or exercise does not offer it."},
    {"instrument-shaver",
     "Shaver",
     "Remove tissue while C is held.",
     "Practice",
     {GLFW_KEY_7},
     {},
     MayTake<simulation::ToolKind::kShaver>,
     TakeInstrument<simulation::ToolKind::kShaver>,
     "This scene or exercise does not offer it."},
    {"instrument-grasper",
     "Grasper",
     "Blunt jaws: C closes them.",
     "Practice",
     {GLFW_KEY_8},
     {},
     MayTake<simulation::ToolKind::kGrasper>,
     TakeInstrument<simulation::ToolKind::kGrasper>,
     "This scene or exercise does not offer it."},
    {"reset-tissues",
     "Restore tissue",
     "Restore every tissue to its state at the start of the session.",
     "Practice",
     {},
     {},
     [](const State& state) { return Practising(state) && state.practice->tissues() != nullptr; },
     [](State& state) {
       state.practice->ResetTissues();
       NoteReset(state, "tissue");
       state.message = "The tissue is as it was at the start of the session.";
     },
     "No tissue of this scene is deformed or cut."},
    {"devices",
     "Devices",
     "Show the devices that hold the two hands, their state, and why there is no force.",
     "Practice",
     {GLFW_KEY_F4},
     {},
     [](const State& state) { return state.practice.has_value() || InEditor(state); },
     ToggleDevices},
    {"record",
     "Record…",
     "Start or stop recording the scope's picture.",
     "Practice",
     {GLFW_KEY_F2},
     {},
     MayToggleFilm,
     ToggleFilm,
     "No practice is under way, or the last film is still being written."},
    {"outside",
     "From outside",
     "Show or hide a view of both hands from outside, in a corner of the picture.",
     "Practice",
     {GLFW_KEY_O},
     {},
     Practising,
     [](State& state) {
       state.steps.practice->shows_outside = !state.steps.practice->shows_outside;
     },
     "No practice is under way."},
    {"trainee-screen",
     "Trainee's screen",
     "Show only the scope's picture on a second monitor, or close it.",
     "Window",
     {GLFW_KEY_F12},
     {},
     Always,
     [](State& state) {
       state.steps.practice->trainee_screen.is_wanted =
           !state.steps.practice->trainee_screen.is_wanted;
     }},
    {"zero-force",
     "Zero-force mode",
     "Show forces but send none to the devices. Press again to end it.",
     "Practice",
     {GLFW_KEY_0},
     {},
     Always,
     ToggleZeroForce},
    {"poke",
     "Poke it",
     "Let the instrument press on the tissue in your own view.",
     "Edit",
     {},
     {},
     [](const State& state) { return Idle(state) && HasPicture(state) && ShowsScope(state); },
     [](State& state) { state.steps.practice->poke ? EndPoke(state) : StartPoke(state); }},
};

}  // namespace

std::span<const Command> PracticeCommands() { return kPracticeCommands; }

}  // namespace arthro::app
