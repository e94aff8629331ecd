// A picture as JPEG in memory, for pages that hold their pictures.
#pragma once

#include <string>

#include "simulation/scene/image.h"

namespace arthro {

// `quality`: 0 to 100.
std::string JpegFromColourImage(const ColourImage& image, int quality);

}  // namespace arthro
