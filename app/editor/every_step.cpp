#include "app/editor/every_step.h"

#include <utility>
#include <vector>

#include <GLFW/glfw3.h>

#include "app/editor/help/open_help.h"
#include "app/files/browse_preview.h"
#include "app/files/scene_files.h"
#include "app/files/start_page.h"
#include "app/steps/budget/frame_budget.h"
#include "app/steps/depth/depth_step.h"
#include "app/steps/lessons/instructor/cohort_board.h"
#include "app/steps/lessons/instructor/rating_board.h"
#include "app/steps/lessons/keeping/lesson_records.h"
#include "app/steps/lessons/keeping/start_board.h"
#include "app/steps/lessons/lessons_step.h"
#include "app/steps/lessons/running_attempt.h"
#include "app/steps/panorama/footage_work.h"
#include "app/steps/portals/portals_step.h"
#include "app/steps/practice/film.h"
#include "app/steps/practice/lens/grid_lens.h"
#include "app/steps/practice/rig_edit.h"
#include "app/steps/practice/tissue_poke.h"
#include "app/steps/solids/solid_edit.h"
#include "app/steps/tissue/fault_board.h"
#include "app/steps/tissue/import_frames.h"
#include "app/steps/tissue/library/tissue_library.h"
#include "app/steps/tissue/tissue_step.h"

namespace arthro::app {
namespace {

using State = EditorState;

template <Step step>
void Open(State& state) {
  if (state.step != step) state.message.clear();  // it spoke of the page before
  state.step = step;
  HideStartPage(state);
}

constexpr Command kStepCommands[] = {
    {"step-panorama",
     "Panorama",
     "The picture that is the backdrop.",
     "Steps",
     {GLFW_KEY_F6},
     {},
     InEditor,
     Open<Step::kPanorama>},
    {"step-depth",
     "Depth",
     "How brightness is turned into depth.",
     "Steps",
     {GLFW_KEY_F7},
     {},
     InEditor,
     Open<Step::kDepth>},
    {"step-tissue",
     "Tissue",
     "Deformable models in the scene.",
     "Steps",
     {GLFW_KEY_F8},
     {},
     InEditor,
     Open<Step::kTissue>},
    {"step-portals",
     "Portals",
     "Incisions and the scope.",
     "Steps",
     {GLFW_KEY_F9},
     {},
     InEditor,
     Open<Step::kPortals>},
    {"step-practice",
     "Practice",
     "Try the scene as a trainee will.",
     "Steps",
     {GLFW_KEY_F10},
     {},
     InEditor,
     Open<Step::kPractice>},
    {"step-exercises",
     "Exercises",
     "What trainees are asked to do in this scene, and how it is judged.",
     "Steps",
     {GLFW_KEY_F5, true},
     {},
     InEditor,
     Open<Step::kExercises>},
};

using Shown = ViewLayout::Shown;

// The one view alone, or both again.
template <Shown shown>
void Show(State& state) {
  state.views.shown = state.views.shown == shown ? Shown::kBoth : shown;
}

template <OverviewSide side>
void LookFrom(State& state) {
  state.overview_side = side;
  ++state.overview_fits;
}

constexpr Command kViewCommands[] = {
    {"view-scope",
     "Scope alone",
     "Show the scope's picture without the overview, or both again.",
     "Views",
     {GLFW_KEY_1, true},
     {},
     InEditor,
     Show<Shown::kScope>},
    {"view-overview",
     "Overview alone",
     "Show the overview without the scope's picture, or both again.",
     "Views",
     {GLFW_KEY_2, true},
     {},
     InEditor,
     Show<Shown::kOverview>},
    {"view-both",
     "Both views",
     "Show the scope's picture and the overview.",
     "Views",
     {GLFW_KEY_3, true},
     {},
     InEditor,
     Show<Shown::kBoth>},
    {"swap-views",
     "Swap",
     "Let the two views change sides.",
     "Views",
     {GLFW_KEY_4, true},
     {},
     InEditor,
     [](State& state) { state.views.is_swapped = !state.views.is_swapped; }},
    {"fit-overview",
     "Fit",
     "Show the whole scene in the overview.",
     "Views",
     {GLFW_KEY_HOME, true},
     {},
     InEditor,
     LookFrom<OverviewSide::kWhole>},
    {"overview-front",
     "Front",
     "Show the overview from the front, as the operator looks into the joint.",
     "Views",
     {},
     {},
     InEditor,
     LookFrom<OverviewSide::kFront>},
    {"overview-top",
     "Top",
     "Show the overview from above.",
     "Views",
     {},
     {},
     InEditor,
     LookFrom<OverviewSide::kTop>},
    {"overview-right",
     "Right",
     "Show the overview from the right side.",
     "Views",
     {},
     {},
     InEditor,
     LookFrom<OverviewSide::kRight>},
};

constexpr Command kWindowCommands[] = {
    {"full-screen",
     "Full screen",
     "Switch full screen on or off.",
     "Window",
     {GLFW_KEY_F11},
     {},
     Always,
     [](State& state) { state.full_screen = !state.full_screen; }},
};

}  // namespace

std::span<const Command> AllCommands() {
  static const std::vector<Command> all = [] {
    std::vector<Command> commands;
    for (const auto group : {FileCommands(),
                             StartCommands(),
                             PanoramaCommands(),
                             DepthCommands(),
                             TissueCommands(),
                             LibraryCommands(),
                             CutCommands(),
                             PlacingCommands(),
                             SolidCommands(),
                             std::span<const Command>(kStepCommands),
                             PracticeCommands(),
                             PortalsCommands(),
                             LessonCommands(),
                             DisturbanceCommands(),
                             RigCommands(),
                             GridLensCommands(),
                             IncisionCommands(),
                             BudgetCommands(),
                             std::span<const Command>(kViewCommands),
                             std::span<const Command>(kWindowCommands),
                             HelpCommands()})
      commands.insert(commands.end(), group.begin(), group.end());
    return commands;
  }();
  return all;
}

EditorState MakeEditorState(authoring::Document document, std::function<void()> wake,
                            std::filesystem::path recent_file) {
  StepStates steps;
  steps.panorama.emplace(wake);
  steps.depth.emplace(wake);
  steps.tissue.emplace();
  steps.tissue->shelf.emplace();
  steps.tissue->solids.emplace();
  steps.tissue->faults.emplace(wake);
  steps.tissue->imports.emplace();
  steps.portals.emplace(wake);
  steps.practice.emplace(wake);
  steps.practice->rig.emplace();
  steps.practice->grid.emplace();
  steps.lessons.emplace();
  steps.lessons->records.emplace();
  steps.lessons->start.emplace();
  steps.lessons->cohort.emplace();
  steps.lessons->rating.emplace();
  steps.practice->budget.emplace();
  return EditorState(std::move(document), std::move(steps), AllCommands(), std::move(wake),
                     std::move(recent_file));
}

bool HasWork(const EditorState& state) {
  const StepStates& steps = state.steps;
  return state.jobs.busy() || steps.depth->preview_jobs.busy() ||
         steps.panorama->frame_jobs.busy() || steps.practice->pivot_jobs.busy() ||
         steps.portals->reach.jobs.busy() || (state.start && state.start->jobs.busy()) ||
         (state.browsed && state.browsed->jobs.busy()) || steps.tissue->faults->jobs.busy();
}

bool FinishWork(EditorState& state) {
  bool changed = FinishFootage(state);
  changed = KeepStartPageFresh(state) || changed;
  changed = KeepBrowsePreviewFresh(state) || changed;
  if (state.jobs.busy()) {
    const std::string words = state.jobs.words();
    Guarded(state, words, [&] { changed = state.jobs.Finish(state); });
    changed = changed || !state.jobs.busy();
  }
  changed = FinishFilm(state) || changed;
  changed = FinishDepth(state) || changed;
  KeepPokeFresh(state);
  KeepBudgetFresh(state);
  Guarded(state, "Depth", [&] { KeepDepthFresh(state); });
  KeepDepthBoardFresh(state);
  Guarded(state, "Check of the surface", [&] { changed = KeepFaultsFresh(state) || changed; });
  KeepTouchFresh(state, state.steps.practice->session_options);
  Guarded(state, "Reach", [&] { changed = KeepReachFresh(state) || changed; });
  return changed;
}

}  // namespace arthro::app
