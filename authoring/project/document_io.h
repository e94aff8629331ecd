// Documents from and to scene folders. Saving never changes an asset that is already there: what is
// new gets a free name ("depth-2.tiff"), and the rename of scene.json is the moment at which the
// folder becomes the new scene. So a full disk, a crash or a pulled stick leaves the old scene
// whole. After that, files that earlier saves of this scene wrote and that nothing names any more
// are removed (written_files.h).
//
// A copy (another folder, an archive) holds pixels, shapes and values only: PNG and JPEG panoramas
// lose their metadata and keep their compressed pixels, all other assets are written anew, and what
// other tools keep in scene.json ("x-…") is left out. Assets that already lie in the folder that is
// saved into stay as they are.
#pragma once

#include <filesystem>
#include <set>

#include "authoring/project/document.h"

namespace arthro::authoring {

// A scene (its folder, scene.json or archive), or a bare picture as the start of a new one.
Document OpenDocument(const std::filesystem::path& file);

// A new document over a PNG, JPEG or TIFF panorama, not saved yet.
Document DocumentFromPanorama(const std::filesystem::path& picture);

// Projection assumed for a picture without a report: gnomonic, its middle straight ahead of the
// portal, and its longer side 105 degrees wide, which is the field of view of common scopes. The
// author corrects it.
Projection GuessProjection(int width, int height);

struct SaveOptions {
  // Files that other steps of the history still need (History::FilesOnlyOnDisk).
  std::set<std::filesystem::path> needed_files;
  // The scene on disk is not the one that this document was opened from or saved to last, so none
  // of its files is removed.
  bool keeps_all_files = false;
  // Keeps the scene that the save replaces as a backup (scene_versions.h).
  bool keeps_backup = false;
  // Packs maps of depth for speed, not for size: for a copy that is replaced within seconds.
  bool packs_quickly = false;
};

// Writes the document as a scene into `folder`, which is made if its parent is there. A name that
// ends in .arthro is written as one archive. Returns the document as it now lies on disk: folder,
// names of assets and where their files are. Throws Error and leaves the folder as it was when
// anything cannot be written, or when a copy would follow a link out of the scene's folder.
Document SaveDocument(const Document& document, const std::filesystem::path& folder,
                      const SaveOptions& options = {});

}  // namespace arthro::authoring
