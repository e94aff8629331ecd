// Gain of a camera that adapts to the light of its own lamp on what it shows: the backdrop with its
// relief, and models in front of or behind it. Plain values, no OpenGL; portal frame, m.
#pragma once

#include "app/view/drawing/metered_models.h"
#include "app/view/exposure/footage_light.h"
#include "simulation/scene/scene.h"
#include "simulation/scope/window_lens.h"

namespace arthro::app {

// Returns the gain at which the lit picture is as bright as the footage. Brightness is the root
// mean square of the light, because a mean would make near parts white when the rest is far. The
// gain is a smooth function of the scope's pose. Some 200 rays over the window, weighted towards
// its middle, are followed to the relief of the grid's blocks; a part that a ray passes within a
// few hundredths of the radius occludes partly, so that nothing appears suddenly. The instrument
// does not count. Returns 1 when neither an imaged part nor a model is in sight.
double AutomaticGain(const LightGrid& grid, const FootageLight& footage, const Backdrop& backdrop,
                     const simulation::ScopeView& view, const simulation::ScopeOptics& optics,
                     double light_reach, const MeteredModels* models = nullptr);

}  // namespace arthro::app
