// The scale that makes one length on a measured surface true; joined_scale.h joins several.
#pragma once

#include "authoring/relief/joined_scale.h"
#include "authoring/relief/known_length.h"
#include "authoring/relief/motion/bundle/bundle.h"
#include "authoring/relief/surface/sweep.h"
#include "simulation/scene/lens.h"

namespace arthro::authoring {

// Throw Error(kBadArgument) where no surface was measured at a pixel, or the pixels are one.
ScalePart ScaleOf(const KnownLength& length, const SweptSurface& surface);
// `lens` describes the frame as it was filmed; the pose is that of the frame.
ScalePart ScaleOf(const KnownInstrument& instrument, const Lens& lens, const CameraPose& pose,
                  const SweptSurface& surface);

}  // namespace arthro::authoring
