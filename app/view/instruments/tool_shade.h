// Parts of the instrument that shade what is behind it: its rod, and the hook or moving jaw of its
// contact shape. m, in the lens frame.
#pragma once

#include "app/view/drawing/lens_shade.h"
#include "app/view/drawing/picture.h"
#include "simulation/tissue/contact/tool_shape.h"

namespace arthro::app {

// Whether the picture shows an instrument.
bool ShowsTool(const Picture& picture);

// The rod's shadow is thinner towards its tip, by kRodTaper. A probe's rod ends where its hook
// begins, and as thick, so that the two shadows are one hook.
LensShade ShadeOf(const Picture& picture, const simulation::ToolShape& shape);

}  // namespace arthro::app
