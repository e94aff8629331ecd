// Steps that tests of lessons share: the presets of the tissues, the choice of an exercise, and a
// frame of the window.
#pragma once

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "app/platform/resource_folder.h"
#include "app/steps/lessons/lessons_step.h"
#include "app/steps/practice/practice_step.h"
#include "app/steps/tissue/tissue_step.h"

namespace arthro::app {

inline constexpr double kWindowFrame = 1.0 / 60;  // s

inline void Prepare(EditorState& state) {
  state.steps.practice->pace = simulation::TissuePace::kInline;
  state.steps.tissue->preset_folder = ResourceFolder() / "presets" / "tissues";
  LoadTissuePresets(state);
}

inline void Choose(EditorState& state, const std::string& id) {
  const auto& exercises = state.document().scene.exercises;
  const auto found = std::find_if(exercises.begin(), exercises.end(),
                                  [&](const Exercise& exercise) { return exercise.id == id; });
  ASSERT_NE(found, exercises.end()) << id;
  state.steps.lessons->chosen = static_cast<int>(found - exercises.begin());
}

inline void Frame(EditorState& state) {
  state.practice->Advance(kWindowFrame);
  FollowAttempt(state);
}

}  // namespace arthro::app
