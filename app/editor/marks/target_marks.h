// Targets of the exercise that is edited, over the scope's picture: where each of them lies, by its
// name; the chosen one is bright. Portal frame, m.
#pragma once

#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "app/panels/fixed_window.h"
#include "app/state/editor_state.h"
#include "simulation/scope/window_lens.h"

namespace arthro::app {

class TargetMarks {
 public:
  // `window`: of the picture's panel; `picture`: its square. Draws nothing where no exercise is
  // edited.
  void Draw(Ui& ui, const EditorState& state, const Area& window, const Area& picture,
            const simulation::ScopeView& view, const simulation::ScopeOptics& optics);

 private:
  void Find(const EditorState& state, const Exercise& exercise);

  // The scene in which the places were found: they are found again where it has changed.
  std::vector<ExerciseTarget> targets_;
  std::vector<Tissue> tissues_;
  int document_ = -1;
  std::vector<std::optional<glm::dvec3>> places_;  // nothing: the target lies on no surface
};

}  // namespace arthro::app
