// A rectangular part of a scene's backdrop: panorama, relief, its standard error and its origins,
// with every direction as it was.
#pragma once

#include "authoring/footage/pixel_box.h"
#include "authoring/project/document.h"

namespace arthro::authoring {

// Throws Error(kBadArgument) for a rectangle that leaves the panorama or is narrower than
// kLeastCrop.
inline constexpr int kLeastCrop = 16;  // px
void CropBackdrop(Document& document, const PixelBox& box);

}  // namespace arthro::authoring
