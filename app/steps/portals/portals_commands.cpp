// The direction in which the scope looks, and the figure that validates it.
#include <GLFW/glfw3.h>

#include "app/state/edits.h"
#include "app/steps/panorama/panorama_step.h"
#include "app/steps/portals/portals_step.h"
#include "app/steps/portals/validation_plot.h"
#include "simulation/core/units.h"
#include "simulation/practice/hands/practice.h"

namespace arthro::app {

void SetViewAngle(EditorState& state, double view_angle) {
  if (state.practice) return state.practice->SetViewAngle(view_angle);
  if (view_angle == state.document().scene.scope.view_angle) return;
  Edit(state, "Change the view angle", "",
       [&](auto& next) { next.scene.scope.view_angle = view_angle; });
}

namespace {

using State = EditorState;

template <int degrees>
void LookAt(State& state) {
  SetViewAngle(state, RadiansFromDegrees(degrees));
  state.message = "View angle " + std::to_string(degrees) + "°";
}

constexpr Command kCommands[] = {
    {"view-0", "0°", "Look along the scope.", "Practice", {GLFW_KEY_1}, {}, ShowsScope, LookAt<0>},
    {"view-30",
     "30°",
     "Look 30° away from the scope.",
     "Practice",
     {GLFW_KEY_2},
     {},
     ShowsScope,
     LookAt<30>},
    {"view-70",
     "70°",
     "Look 70° away from the scope.",
     "Practice",
     {GLFW_KEY_3},
     {},
     ShowsScope,
     LookAt<70>},
    {"view-90",
     "90°",
     "Look straight to the side.",
     "Practice",
     {GLFW_KEY_4},
     {},
     ShowsScope,
     LookAt<90>},
    {"validation-plot",
     "Validation plot…",
     "Draw the path of the view's centre as the scope rolls, and write it as a table.",
     "Incision",
     {},
     {},
     [](const State& state) { return !state.jobs.busy() && state.document().panorama != nullptr; },
     SaveValidationPlot},
};

}  // namespace

std::span<const Command> PortalsCommands() { return kCommands; }

}  // namespace arthro::app
