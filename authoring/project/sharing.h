// Statements that an author owes before a scene is shared, over all that the scene holds: beside
// the scene's own assets (simulation/scene/files/scene_check.h) the clips that its panorama was
// made from and a depth map that was brought along.
#pragma once

#include <string>
#include <vector>

#include "authoring/project/document.h"

namespace arthro::authoring {

// An asset whose rights are stated: the panorama, a tissue, a depth map or a clip.
struct Asset {
  enum class Kind { kPanorama, kTissue, kDepth, kClip };
  Kind kind = Kind::kPanorama;
  std::size_t index = 0;  // index of the tissue or the clip
  std::string name;
};
std::vector<Asset> AssetsOf(const Document& document);

AssetRights RightsOf(const Document& document, const Asset& asset);
void PutRights(Document& document, const Asset& asset, const AssetRights& rights);

// A depth map that was neither made from the panorama nor measured from its clip.
bool HasForeignDepth(const Document& document);

// One line per lack. The last lines say what a copy of the scene would leave out.
std::vector<std::string> MissingForSharing(const Document& document);

}  // namespace arthro::authoring
