#include "authoring/project/sharing.h"

#include <utility>

#include <fmt/format.h>

#include "simulation/scene/files/archive_io.h"
#include "simulation/scene/files/scene_check.h"

namespace arthro::authoring {

bool HasForeignDepth(const Document& document) {
  return document.depth && !document.depth->empty() && document.is_depth_imported &&
         !document.depth_origin;
}

std::vector<Asset> AssetsOf(const Document& document) {
  std::vector<Asset> assets = {{Asset::Kind::kPanorama, 0, "panorama"}};
  for (std::size_t i = 0; i < document.scene.tissues.size(); ++i)
    assets.push_back({Asset::Kind::kTissue, i, document.scene.tissues[i].name});
  if (HasForeignDepth(document)) assets.push_back({Asset::Kind::kDepth, 0, "depth map"});
  if (document.footage)
    for (std::size_t i = 0; i < document.footage->clips.size(); ++i)
      assets.push_back({Asset::Kind::kClip, i, "clip " + document.footage->clips[i].name});
  return assets;
}

AssetRights RightsOf(const Document& document, const Asset& asset) {
  switch (asset.kind) {
    case Asset::Kind::kPanorama:
      return document.scene.backdrop.rights;
    case Asset::Kind::kTissue:
      return document.scene.tissues.at(asset.index).rights;
    case Asset::Kind::kDepth:
      return document.scene.backdrop.depth_rights;
    case Asset::Kind::kClip:
      return document.footage->clips.at(asset.index).rights;
  }
  return {};
}

void PutRights(Document& document, const Asset& asset, const AssetRights& rights) {
  switch (asset.kind) {
    case Asset::Kind::kPanorama:
      document.scene.backdrop.rights = rights;
      break;
    case Asset::Kind::kTissue:
      document.scene.tissues.at(asset.index).rights = rights;
      break;
    case Asset::Kind::kDepth:
      document.scene.backdrop.depth_rights = rights;
      break;
    case Asset::Kind::kClip: {
      FootageRecord record = *document.footage;
      record.clips.at(asset.index).rights = rights;
      document.footage = Share(std::move(record));
      break;
    }
  }
}

std::vector<std::string> MissingForSharing(const Document& document) {
  std::vector<std::string> missing = arthro::MissingForSharing(document.scene);
  for (const Asset& asset : AssetsOf(document)) {
    if (asset.kind != Asset::Kind::kDepth && asset.kind != Asset::Kind::kClip) continue;
    if (const std::string words = MissingRights(RightsOf(document, asset)); !words.empty())
      missing.push_back(fmt::format("the {} has no {}", asset.name, words));
  }
  if (document.footage && !document.folder.empty() && !IsArchive(document.folder))
    for (const ClipFile& clip : document.footage->clips)
      if (!clip.file.empty())
        missing.push_back(fmt::format(
            "the scene names the file of its clip {}; share a copy (Save as…, or an .arthro "
            "archive), which does not",
            clip.name));
  return missing;
}

}  // namespace arthro::authoring
