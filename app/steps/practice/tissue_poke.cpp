#include "app/steps/practice/tissue_poke.h"

#include "app/steps/depth/depth_step.h"

namespace arthro::app {

void StartPoke(EditorState& state) {
  WhenDepthIsReady(state, [](EditorState& ready) {
    ready.jobs.Start("Poke", [document = ready.document(), presets = ready.tissue_presets,
                              pace = ready.steps.practice->pace,
                              options = ready.steps.practice->session_options](const Progress&) {
      const auto session = std::make_shared<simulation::Practice>(
          simulation::MakePractice(document, presets, pace, options));
      return [session](EditorState& now) {  // shared only because a std::function is copied
        if (now.practice || now.practice_only) return;
        session->SetViewAngle(now.document().scene.scope.view_angle);
        session->scope().Set(now.scope);
        session->instrument().Set(now.instrument);
        now.steps.practice->poke.emplace(std::move(*session));
        now.steps.practice->poke_of = now.history.Position();
        now.message = "Poke it: right drag over the picture moves the instrument.";
      };
    });
  });
}

void EndPoke(EditorState& state) {
  if (!state.steps.practice->poke) return;
  state.steps.practice->poke.reset();
  state.message = "Poking ended.";
}

void KeepPokeFresh(EditorState& state) {
  if (state.steps.practice->poke &&
      (state.practice || state.steps.practice->poke_of != state.history.Position()))
    EndPoke(state);
}

}  // namespace arthro::app
