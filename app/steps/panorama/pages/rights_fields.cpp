#include "app/steps/panorama/pages/rights_fields.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "app/panels/widgets.h"
#include "app/state/edits.h"
#include "app/steps/panorama/panorama_step.h"
#include "authoring/project/sharing.h"

namespace arthro::app {

void RightsFields(Ui& ui, EditorState& state) {
  Gap(ui);
  Heading(ui, "Rights");
  const std::vector<authoring::Asset> assets = authoring::AssetsOf(state.document());
  std::vector<std::string> names;
  names.reserve(assets.size());
  for (const authoring::Asset& asset : assets) names.push_back(asset.name);
  int& chosen = state.steps.panorama->rights_of;
  chosen = std::clamp(chosen, 0, static_cast<int>(assets.size()) - 1);
  if (assets.size() > 1)
    Combo(ui, "Asset", chosen, names,
          "The panorama, its clips, an imported depth map, or one of the scene's tissues.");
  const authoring::Asset& asset = assets[static_cast<std::size_t>(chosen)];
  AssetRights rights = RightsOf(state.document(), asset);
  if (TextField(ui, "Source", rights.source, "who made it, or where it comes from"))
    SetRights(state, asset, rights, "source");
  if (TextField(ui, "Licence", rights.licence, "for example CC BY 4.0, or own use only"))
    SetRights(state, asset, rights, "licence");
  if (TextField(ui, "Consent", rights.consent, "consent of the patient, or none needed"))
    SetRights(state, asset, rights, "consent");
  const std::vector<std::string> missing = authoring::MissingForSharing(state.document());
  if (missing.empty())
    return QuietText(ui, "All is stated that a scene should state before it is shared.");
  std::string words = "Before this scene is shared: ";
  for (std::size_t i = 0; i < missing.size(); ++i) words += (i > 0 ? "; " : "") + ui.In(missing[i]);
  QuietText(ui, words + ".");
}

}  // namespace arthro::app
