#include "app/steps/practice/start_practice.h"

#include <memory>
#include <utility>

#include "app/steps/depth/depth_step.h"

namespace arthro::app {

const simulation::Practice* LiveSession(const EditorState& state) {
  if (state.practice) return &*state.practice;
  return state.steps.practice->poke ? &*state.steps.practice->poke : nullptr;
}

bool MayPractise(const EditorState& state) {
  return !state.practice && !state.jobs.busy() && state.document().panorama;
}

void StartPractice(EditorState& state, std::function<void(EditorState&)> then) {
  WhenDepthIsReady(state, [then = std::move(then)](EditorState& ready) {
    authoring::Document mounted = ready.document();
    ready.steps.practice->hands->Mount(mounted.scene);
    ready.jobs.Start("Practise", [document = std::move(mounted), presets = ready.tissue_presets,
                                  pace = ready.steps.practice->pace,
                                  options = ready.steps.practice->session_options,
                                  then](const Progress&) {
      const auto practice = std::make_shared<simulation::Practice>(
          simulation::MakePractice(document, presets, pace, options));
      return [practice, then](EditorState& now) {  // shared only because a std::function is copied
        now.practice.emplace(std::move(*practice));
        now.steps.practice->head.turn = 0;
        now.message = "Practice. Esc leaves it.";
        if (now.record.is_on) {
          now.message =
              "Practice. Esc leaves it. The script takes its buttons and not its hands, which "
              "follow time: practise --log records those.";
          now.record.lines.push_back(
              "# The hands of a practice follow time and are not here; practise --log records "
              "them.");
        }
        if (then) then(now);
      };
    });
  });
}

}  // namespace arthro::app
