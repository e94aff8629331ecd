// The gain of a camera unit that adapts to what the scope shows in its own lamp's light: backdrop
// with its relief, and models before or behind it. Plain values, no OpenGL; portal frame, m.
#pragma once

#include "app/view/drawing/metered_models.h"
#include "app/view/exposure/footage_light.h"
#include "simulation/scene/scene.h"
#include "simulation/scope/window_lens.h"

namespace arthro::app {

// Gain at which the lit picture is as bright as the footage, by the root mean square of the light
// (by its mean, what is near would be white when the rest is far), as a smooth function of where
// the scope is: an unhurried camera. Some 200 rays over the window, which count more in its middle,
// each followed to the relief of the grid's blocks; what they pass closer than a few hundredths of
// the radius hides what is behind it by halves, so that nothing comes into view at a stroke. The
// instrument does not count. 1 where it sees nothing that was imaged, and no model.
double AutomaticGain(const LightGrid& grid, const FootageLight& footage, const Backdrop& backdrop,
                     const simulation::ScopeView& view, const simulation::ScopeOptics& optics,
                     double light_reach, const MeteredModels* models = nullptr);

}  // namespace arthro::app
