// A rectangular part of a finished panorama, with the report of that part.
#pragma once

#include "authoring/footage/pixel_box.h"
#include "authoring/panorama/make_panorama.h"

namespace arthro::authoring {

// The places of the frames move with the top left corner. Throws Error(kBadArgument) for a
// rectangle that leaves the panorama.
void CropPanorama(PanoramaResult& result, const PixelBox& box);

}  // namespace arthro::authoring
