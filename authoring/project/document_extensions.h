// Keys that this program itself keeps at the top of scene.json, beside the values of the scene.
#pragma once

#include <string>

#include "authoring/project/document.h"

namespace arthro::authoring {

// How the depth map is made, for the next time the scene is opened here.
inline constexpr const char* kDepthOptionsKey = "x-depth-options";
// Strokes that mended the depth map (authoring/depth/strokes), to be applied again when it is made
// anew.
inline constexpr const char* kDepthStrokesKey = "x-depth-strokes";
// Fingerprint of the depth map that was made with those options. A map that does not have it was
// brought along by a person.
inline constexpr const char* kDepthMadeKey = "x-depth-made";

// Puts these keys as they are for this document.
void PutDocumentKeys(Document& document);

// Puts the key of the files of the unmended depth only.
void PutUnmendedKey(Document& document);

// Fingerprint as JSON text, over width, height and relief, however the file packs them.
std::string DepthFingerprint(const DepthMap& depth);

}  // namespace arthro::authoring
