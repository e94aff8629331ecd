#include "app/editor/marks/target_marks.h"

#include <utility>

#include "app/editor/marks/cue_marks.h"
#include "app/steps/lessons/author/target_edit.h"
#include "app/steps/lessons/lessons_step.h"
#include "simulation/core/error.h"
#include "simulation/training/observe/exercise_targets.h"

namespace arthro::app {
namespace {

// The place of a target does not depend on its size and its name.
std::vector<ExerciseTarget> PlacesOf(std::vector<ExerciseTarget> targets) {
  for (ExerciseTarget& target : targets) {
    target.radius = 0;
    target.id.clear();
  }
  return targets;
}

}  // namespace

void TargetMarks::Find(const EditorState& state, const Exercise& exercise) {
  std::vector<ExerciseTarget> targets = PlacesOf(exercise.targets);
  const auto& scene = state.document().scene;
  if (document_ == state.document_number && targets == targets_ && scene.tissues == tissues_)
    return;
  targets_ = std::move(targets);
  tissues_ = scene.tissues;
  document_ = state.document_number;
  places_.assign(exercise.targets.size(), std::nullopt);
  if (places_.empty()) return;
  const simulation::DepthField relief = simulation::ReliefOf(state.document());
  for (std::size_t i = 0; i < places_.size(); ++i) try {
      Exercise one;
      one.targets = {exercise.targets[i]};
      const auto place = simulation::PlacesOfTargets(state.document(), one, relief).front();
      places_[i] = place.point;
      if (place.tissue >= 0) {
        const Pose& pose = scene.tissues[static_cast<std::size_t>(place.tissue)].pose;
        places_[i] = pose.quaternion * place.point + pose.position;
      }
    } catch (const Error&) {  // the check of the scene and the attempt name it
    }
}

void TargetMarks::Draw(Ui& ui, const EditorState& state, const Area& window, const Area& picture,
                       const simulation::ScopeView& view, const simulation::ScopeOptics& optics) {
  if (state.step != Step::kExercises || !HasExercise(state)) return;
  const LessonsStep& step = *state.steps.lessons;
  const Exercise& exercise = *ChosenExercise(state);
  Find(state, exercise);
  const FixedWindow same(ui, "picture", window, kPictureWindow);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const bool is_chosen = static_cast<int>(i) == step.target;
    // A target that waits for its click lies nowhere yet.
    if (places_[i] && !(is_chosen && step.takes_target))
      MarkTarget(ui, picture, view, optics, *places_[i], exercise.targets[i].id, is_chosen);
  }
}

}  // namespace arthro::app
