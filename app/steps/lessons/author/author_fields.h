// Parts of the author's page of exercises; each shows the chosen exercise.
#pragma once

#include <string>
#include <vector>

#include "app/panels/widgets.h"
#include "app/steps/lessons/exercise_edit.h"

namespace arthro::app {

void TargetsPanel(Ui& ui, EditorState& state);
void StepsPanel(Ui& ui, EditorState& state);
void CriteriaPanel(Ui& ui, EditorState& state);
void StartPanel(Ui& ui, EditorState& state);  // tools and disturbances at the start
void MorePanel(Ui& ui, EditorState& state);   // order, gate, limits, zones, picture

// Fields of one step beside its words, targets and numbers.
void MoreOfStep(Ui& ui, EditorState& state, std::size_t step);

// A list of targets by their names: buttons move and remove each, and a choice adds one of those
// that suit the list `key` (step_edit.h). `repeats`: a target may be in it several times, as in a
// path that closes. Returns true when the list changed.
bool TargetListField(Ui& ui, const Exercise& exercise, const std::string& key,
                     const std::string& words, bool repeats, std::vector<std::string>& ids);
// A choice of one target. Returns true when another one was chosen.
bool TargetField(Ui& ui, const Exercise& exercise, const std::string& key, const std::string& words,
                 std::string& id);

// Picture of the exercise, or of a step of it: −1, the exercise.
void PictureField(Ui& ui, EditorState& state, int step);

// A changed copy of the exercise, which becomes an edit when the fields are done.
class EditedExercise {
 public:
  Exercise changed;

  explicit EditedExercise(EditorState& state) : changed(*ChosenExercise(state)), state_(state) {}
  // A change that is complete at once.
  void Note(bool is_changed, const char* what) {
    if (is_changed) what_ = what;
  }
  // A slider or a field that is dragged.
  void Note(const Change& change, const char* what) {
    if (change.changed) what_ = what, is_dragged_ = true;
    is_released_ = is_released_ || change.released;
  }
  void Apply();

 private:
  EditorState& state_;
  const char* what_ = nullptr;
  bool is_dragged_ = false, is_released_ = false;
};

}  // namespace arthro::app
