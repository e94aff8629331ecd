// The direction in which the scope looks, and the figure that validates it.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include "app/state/edits.h"
#include "app/steps/panorama/panorama_step.h"
#include "app/steps/portals/centres_figure.h"
#include "app/steps/portals/portals_step.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/practice/hands/practice.h"
#include "simulation/scene/image_io.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

// Writes NAME.png, NAME-grid.png and NAME.csv. Neither of the last two is overwritten where
// NAME.png was not there before.
void Save(EditorState& state, const fs::path& picture) {
  const fs::path stem = picture.parent_path() / picture.stem();
  const fs::path grid = fs::path(stem) += "-grid.png", table = fs::path(stem) += ".csv";
  std::error_code ignored;
  // Consent to replace the picture covers all three files.
  if (!fs::exists(picture, ignored))
    for (const fs::path& beside : {grid, table})
      if (fs::exists(beside, ignored))
        throw Error(Code::kFile, "is already there and would be overwritten; choose another name",
                    beside);
  CentresChoice choice;
  choice.view_angle =
      state.practice ? state.practice->view_angle() : state.document().scene.scope.view_angle;
  // Before anything is written: what cannot be drawn is said.
  CentresFigure figure = CentresOf(state.document().scene.backdrop, choice);
  state.jobs.Start("Validation plot", [picture, grid, table, figure = std::move(figure),
                                       panorama = state.document().panorama](const Progress&) {
    ColourImage drawn = *panorama;
    DrawCentres(drawn, figure.rod, figure.lines);
    WriteColourImage(picture, drawn);
    drawn = GridOf(panorama->width, panorama->height);
    DrawCentres(drawn, figure.rod, figure.lines);
    WriteColourImage(grid, drawn);
    WriteAtomically(table, figure.table);
    return [picture, grid, table](EditorState& now) {
      now.message = fmt::format("Validation plot: {}, {} and {} in {}", picture.filename().string(),
                                grid.filename().string(), table.filename().string(),
                                picture.parent_path().string());
    };
  });
}

void SaveValidationPlot(EditorState& state) {
  Browse(
      state, BrowseFor::kSaveFile,
      "Save the centres of the view at 5, 10 and 15 mm, on the panorama and on a grid", "Save",
      {{"Picture (.png)", {".png"}}},
      [](EditorState& now, const fs::path& file) { Save(now, file); }, "validation");
}

}  // namespace

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

template <int degrees>
bool MayLookAt(const State& state) {
  return ShowsScope(state) &&
         (!state.practice || state.practice->OffersAngle(RadiansFromDegrees(degrees)));
}

constexpr const char* kOtherAngle = "The exercise asks for another view angle.";

void ShowReach(State& state, const CommandArguments& arguments) {
  if (arguments.size() != 1 || (arguments[0] != "on" && arguments[0] != "off"))
    throw Error(Code::kBadArgument, "write on or off after it");
  state.step = Step::kPortals;
  state.steps.portals->reach.is_shown = arguments[0] == "on";
}

void SuggestFor(State& state, const CommandArguments& arguments) {
  state.steps.portals->reach.targets = SpacingTargetsOf(state.document().scene, arguments);
  SuggestSpacing(state);
}

constexpr Command kPortalsCommands[] = {
    {"view-0",
     "0°",
     "Look along the scope.",
     "Practice",
     {GLFW_KEY_1},
     {},
     MayLookAt<0>,
     LookAt<0>,
     kOtherAngle},
    {"view-30",
     "30°",
     "Look 30° away from the scope.",
     "Practice",
     {GLFW_KEY_2},
     {},
     MayLookAt<30>,
     LookAt<30>,
     kOtherAngle},
    {"view-70",
     "70°",
     "Look 70° away from the scope.",
     "Practice",
     {GLFW_KEY_3},
     {},
     MayLookAt<70>,
     LookAt<70>,
     kOtherAngle},
    {"view-90",
     "90°",
     "Look straight to the side.",
     "Practice",
     {GLFW_KEY_4},
     {},
     MayLookAt<90>,
     LookAt<90>,
     kOtherAngle},
    {"show-reach",
     "Show reach",
     "Colour the overview by what scope and instrument reach through these portals.",
     "Incision",
     {},
     {},
     HasPicture,
     [](State& state) {
       state.step = Step::kPortals;
       state.steps.portals->reach.is_shown = !state.steps.portals->reach.is_shown;
     },
     "",
     "on|off",
     ShowReach},
    {"suggest-spacing",
     "Suggest spacing",
     "Set the spacing at which most of the targets is seen and touched with the rods at 45° to "
     "75°.",
     "Incision",
     {},
     {},
     HasPictureAndTime,
     SuggestSpacing,
     "",
     "TARGET…",
     SuggestFor},
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

std::span<const Command> PortalsCommands() { return kPortalsCommands; }

}  // namespace arthro::app
