// Documents from and to scene folders. Saving never changes an asset that is already there: what is
// new gets a free name ("depth-2.tiff"), and the rename of scene.json, last, is the moment at which
// the folder becomes the new scene. So a full disk, a crash or a pulled stick leaves the old scene
// whole.
#pragma once

#include <filesystem>

#include "authoring/project/document.h"

namespace arthro::authoring {

// A scene (its folder, scene.json or archive), or a bare picture as the start of a new one.
Document OpenDocument(const std::filesystem::path& file);

// A new document over a PNG, JPEG or TIFF panorama, not saved yet.
Document DocumentFromPanorama(const std::filesystem::path& picture);

// What is assumed of a picture that comes without a report: gnomonic, its middle straight ahead of
// the portal, and its longer side 105 degrees wide, the view of the scopes that clips are mostly
// made with. The author corrects it; nothing that is drawn or felt hides a wrong guess.
Projection GuessProjection(int width, int height);

// Writes the document as a scene into `folder`, which is made if its parent is there. Files that
// the document was read from are copied byte for byte; parts that changed are written from memory.
// A name that ends in .arthro is written as one archive. Returns the document as it now lies on
// disk: folder, names of assets and where their files are. Throws Error and leaves the folder as it
// was when anything cannot be written.
Document SaveDocument(const Document& document, const std::filesystem::path& folder);

}  // namespace arthro::authoring
