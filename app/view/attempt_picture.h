// Picture of a moment of an attempt, from the lens and with the instrument as they were.
#pragma once

#include "app/view/drawing/picture.h"
#include "simulation/scope/window_lens.h"
#include "simulation/training/observe/attempt_frame.h"

namespace arthro::app {

Picture PictureOfFrame(const simulation::AttemptFrame& frame,
                       const simulation::ScopeOptics& optics);

}  // namespace arthro::app
