// The black frame that a camera unit puts round the scope's picture: as high as the picture, and
// the picture in its middle. px.
#pragma once

#include <string_view>

#include "simulation/scene/image.h"

namespace arthro::app {

enum class FrameShape { kSquare, k4x3, k16x9 };

// Reads "square", "4:3" or "16:9", as on the command line. Throws Error(kBadArgument) otherwise.
FrameShape FrameShapeOf(std::string_view word);
std::string_view ToString(FrameShape shape);

// To the next even number, which films need.
int FrameWidth(FrameShape shape, int height);

// Place of the square picture on a screen: the frame as large as the screen lets it be, in its
// middle, and in that the picture. From the top left.
struct ScreenPlace {
  int x = 0, y = 0, edge = 0;
  friend bool operator==(const ScreenPlace&, const ScreenPlace&) = default;
};
ScreenPlace PlaceOnScreen(FrameShape shape, int width, int height);

// A square picture in its frame.
ColourImage LaidOut(const ColourImage& picture, FrameShape shape);

}  // namespace arthro::app
