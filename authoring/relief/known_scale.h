// The scale of a reconstruction, from lengths that the author knows. Motion gives ratios of
// lengths; one known length makes them metres. Several lengths are joined as the weighted mean of
// the logarithms of their factors.
#pragma once

#include <span>

#include "authoring/relief/bundle.h"
#include "authoring/relief/known_length.h"
#include "authoring/relief/relief_report.h"
#include "authoring/relief/sweep.h"
#include "simulation/scene/lens.h"

namespace arthro::authoring {

// Throw Error(kBadArgument) where no surface was measured at a pixel, or the pixels are one.
ScalePart ScaleOf(const KnownLength& length, const SweptSurface& surface);
// `lens` describes the frame as it was filmed; the pose is that of the frame.
ScalePart ScaleOf(const KnownInstrument& instrument, const Lens& lens, const CameraPose& pose,
                  const SweptSurface& surface);

struct JoinedScale {
  double factor = 1, sigma = 0;  // sigma: of the factor's logarithm
};

// Throws Error(kBadArgument) where two parts differ by more than 10 %. Needs one part.
JoinedScale JoinScales(std::span<const ScalePart> parts);

}  // namespace arthro::authoring
