// Maps over a coarse grid brought to the size of a picture that is a whole multiple of it. Cell i
// covers the pixels i·factor … i·factor + factor − 1.
#pragma once

#include "simulation/scene/image.h"

namespace arthro::authoring {

// Bilinear between the cells' middles; the nearest cell's value where one of the four is unknown.
DepthMap MapAtPictureSize(const DepthMap& map, int factor);
OriginMap MapAtPictureSize(const OriginMap& map, int factor);  // the nearest cell's value

}  // namespace arthro::authoring
