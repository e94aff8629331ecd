#include "app/steps/panorama/rights_fields.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "app/panels/widgets.h"
#include "app/state/edits.h"
#include "app/steps/panorama/panorama_step.h"
#include "simulation/scene/files/scene_check.h"

namespace arthro::app {

void RightsFields(Ui& ui, EditorState& state) {
  const Scene scene = state.document().scene;  // a copy: edits below move it
  Gap(ui);
  Heading(ui, "Rights");
  std::vector<std::string> assets = {"panorama"};
  for (const Tissue& tissue : scene.tissues) assets.push_back(tissue.name);
  int& chosen = state.steps.panorama->rights_of;
  chosen = std::clamp(chosen, 0, static_cast<int>(assets.size()) - 1);
  if (assets.size() > 1)
    Combo(ui, "Asset", chosen, assets, "The panorama, or one of the scene's tissues.");
  const int asset = chosen - 1;
  AssetRights rights =
      asset < 0 ? scene.backdrop.rights : scene.tissues[static_cast<std::size_t>(asset)].rights;
  if (TextField(ui, "Source", rights.source, "who made it, or where it comes from"))
    SetRights(state, asset, rights, "source");
  if (TextField(ui, "Licence", rights.licence, "for example CC BY 4.0, or own use only"))
    SetRights(state, asset, rights, "licence");
  if (TextField(ui, "Consent", rights.consent, "consent of the patient, or none needed"))
    SetRights(state, asset, rights, "consent");
  const std::vector<std::string> missing = MissingForSharing(state.document().scene);
  if (missing.empty())
    return QuietText(ui, "All is stated that a scene should state before it is shared.");
  std::string words = "Before this scene is shared: ";
  for (std::size_t i = 0; i < missing.size(); ++i) words += (i > 0 ? "; " : "") + missing[i];
  QuietText(ui, words + ".");
}

}  // namespace arthro::app
