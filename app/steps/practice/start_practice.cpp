#include "app/steps/practice/start_practice.h"

#include <memory>
#include <utility>

#include "app/steps/depth/depth_step.h"
#include "simulation/core/error.h"
#include "simulation/practice/living_tissues.h"

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
                                  pace = ready.steps.practice->pace, then](const Progress&) {
      const auto practice =
          std::make_shared<simulation::Practice>(MakePractice(document, presets, pace));
      return [practice, then](EditorState& now) {  // shared only because a std::function is copied
        now.practice.emplace(std::move(*practice));
        now.steps.practice->head.turn = 0;
        now.message = "Practice. Esc leaves it.";
        if (then) then(now);
      };
    });
  });
}

simulation::Practice MakePractice(const authoring::Document& document,
                                  const std::vector<simulation::TissuePreset>& presets,
                                  simulation::TissuePace pace) {
  if (!document.panorama || document.panorama->empty())
    throw Error(Code::kBadScene,
                "a scene without a panorama cannot be practised; import one first");
  std::vector<SurfaceMesh> surfaces;
  for (const auto& surface : document.surfaces)
    surfaces.push_back(surface ? *surface : SurfaceMesh{});
  const Backdrop& backdrop = document.scene.backdrop;
  auto field = document.depth ? simulation::DepthField(backdrop, *document.depth)
                              : simulation::DepthField(backdrop, document.panorama->width,
                                                       document.panorama->height);
  auto session = std::make_unique<simulation::Session>(document.scene, std::move(field), surfaces);
  const auto file_of = [&document](const std::filesystem::path& name) {
    const auto found = document.files.find(name.generic_string());
    return found != document.files.end() ? found->second.file : document.folder / name;
  };
  session->Enliven(simulation::LivingTissues(document.scene, surfaces, file_of, presets), pace,
                   simulation::LayersOf(document.scene, surfaces, presets));
  return {std::move(session), document.scene};
}

}  // namespace arthro::app
