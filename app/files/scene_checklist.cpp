#include "app/files/scene_checklist.h"

namespace arthro::app {

std::vector<MissingPart> MissingParts(const EditorState& state) {
  const authoring::Document& document = state.document();
  if (!document.panorama) return {{"There is no panorama yet.", Step::kPanorama, -1, {}}};
  const Scene& scene = document.scene;
  std::vector<MissingPart> missing;
  if (scene.title.empty() || scene.title == "Untitled")
    missing.push_back({"The scene has no title.", Step::kPanorama, -1, {}});
  if (scene.author.empty()) missing.push_back({"It names no author.", Step::kPanorama, -1, {}});
  if (!document.depth)
    missing.push_back({"The backdrop has no depth: it is felt as a sphere.", Step::kDepth, -1, {}});
  if (scene.tissues.empty())
    missing.push_back({"There is no tissue to probe or to cut.", Step::kTissue, -1, {}});
  for (std::size_t i = 0; i < scene.tissues.size(); ++i) {
    const Tissue& tissue = scene.tissues[i];
    const int index = static_cast<int>(i);
    if (tissue.is_implicit || simulation::IsThinLayer(tissue, state.tissue_presets)) continue;
    if (tissue.mesh.empty())
      missing.push_back({"\"" + tissue.name + "\" has no tetrahedra: it does not give way.",
                         Step::kTissue, index, TissuePage::kMesh});
    else if (tissue.fixed.empty())
      missing.push_back({"Nothing holds \"" + tissue.name + "\": it drifts when it is touched.",
                         Step::kTissue, index, TissuePage::kHold});
  }
  return missing;
}

void GoToMissingPart(EditorState& state, const MissingPart& part) {
  state.step = part.step;
  state.message.clear();
  if (part.tissue >= 0) state.tissue = part.tissue;
  if (part.page) state.steps.tissue->page = *part.page;
}

}  // namespace arthro::app
