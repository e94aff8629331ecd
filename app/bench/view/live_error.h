// Difference of a moving picture from that of a scope at rest, which has four rays and eight
// texture samples per pixel.
#pragma once

#include "app/view/arthroscopic_view.h"

namespace arthro::app {

// Returns the root mean square difference of the green channel in the inner part of the window, of
// 255. Grain is left out. The picture needs a camera.
double ErrorAgainstStill(ArthroscopicView& view, const Picture& picture, int size);

}  // namespace arthro::app
