#include "app/steps/practice/tissue_poke.h"

#include "app/steps/depth/depth_work.h"

namespace arthro::app {

void StartPoke(EditorState& state) {
  WhenDepthIsReady(state, [](EditorState& ready) {
    ready.jobs.Start("Poke", [document = ready.document(), presets = ready.tissue_presets,
                              pace = ready.pace](const Progress&) {
      const auto session = std::make_shared<Practice>(document, presets, pace);
      return [session](EditorState& now) {  // shared only because a std::function is copied
        if (now.practice || now.practice_only) return;
        session->SetViewAngle(now.document().scene.scope.view_angle);
        session->scope().Set(now.scope);
        session->instrument().Set(now.instrument);
        now.poke.emplace(std::move(*session));
        now.poke_of = now.history.Position();
        now.message = "Poke it: right drag over the picture moves the instrument.";
      };
    });
  });
}

void EndPoke(EditorState& state) {
  if (!state.poke) return;
  state.poke.reset();
  state.message = "Poking ended.";
}

void KeepPokeFresh(EditorState& state) {
  if (state.poke && (state.practice || state.poke_of != state.history.Position())) EndPoke(state);
}

}  // namespace arthro::app
