#include "app/commands/start_practice.h"

#include <memory>
#include <utility>

#include "app/commands/depth_work.h"

namespace arthro::app {

bool MayPractise(const EditorState& state) {
  return !state.practice && !state.jobs.busy() && state.document().panorama;
}

void StartPractice(EditorState& state, std::function<void(EditorState&)> then) {
  WhenDepthIsReady(state, [then = std::move(then)](EditorState& ready) {
    authoring::Document mounted = ready.document();
    ready.hands->Mount(mounted.scene);
    ready.jobs.Start("Practise", [document = std::move(mounted), presets = ready.tissue_presets,
                                  pace = ready.pace, options = ready.session_options,
                                  then](const Progress&) {
      const auto practice = std::make_shared<Practice>(document, presets, pace, options);
      return [practice, then](EditorState& now) {  // shared only because a std::function is copied
        now.practice.emplace(std::move(*practice));
        now.head.turn = 0;
        now.message = "Practice. Esc leaves it.";
        if (then) then(now);
      };
    });
  });
}

}  // namespace arthro::app
