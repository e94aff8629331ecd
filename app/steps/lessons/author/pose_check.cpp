// Search, beside the window, for poses of the scope that see the targets of the chosen exercise.
#include <fmt/format.h>

#include "app/state/editor_state.h"
#include "app/steps/lessons/exercise_edit.h"
#include "simulation/training/robot/unseen_targets.h"

namespace arthro::app {

bool MayCheckTargets(const EditorState& state) {
  return HasExercise(state) && !state.jobs.busy() && !ChosenExercise(state)->steps.empty();
}

void CheckTargets(EditorState& state) {
  const Exercise exercise = *ChosenExercise(state);
  state.steps.lessons->pose_check.reset();
  state.jobs.Start(
      "Looking for poses",
      [exercise, loaded = LoadedScene(state.document())](const Progress& progress) -> Jobs::Apply {
        PoseCheck check{exercise, loaded.scene.tissues, {}};
        for (const auto& unseen : simulation::UnseenTargets(loaded, exercise, progress))
          check.sentences.push_back(fmt::format("No pose sees \"{}\" with {}.", unseen.target,
                                                simulation::AnglesOf(unseen)));
        return [check](EditorState& now) {
          now.steps.lessons->pose_check = check;
          now.message = check.sentences.empty()
                            ? "Some pose of the scope sees each target of the steps."
                            : fmt::format("No pose of the scope sees {} of the targets.",
                                          check.sentences.size());
        };
      });
}

const PoseCheck* PoseCheckOf(const EditorState& state) {
  const auto& check = state.steps.lessons->pose_check;
  const Exercise* exercise = ChosenExercise(state);
  if (!check || exercise == nullptr) return nullptr;
  // Words, criteria and the version do not change what is seen.
  const bool is_same =
      check->exercise.id == exercise->id && check->exercise.targets == exercise->targets &&
      check->exercise.steps == exercise->steps && check->exercise.setup == exercise->setup &&
      check->tissues == state.document().scene.tissues;
  return is_same ? &*check : nullptr;
}

}  // namespace arthro::app
