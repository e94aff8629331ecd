// Error of a relief against the small cavity that it was made from.
#pragma once

#include "authoring/relief/make/make_relief.h"
#include "tests/support/relief/cavity_clip.h"

namespace arthro::test {

// Median of |radius - truth| of the measured cells after the similarity that fits the cameras best,
// m: motion knows no scale, and the portal frame is found from the poses.
double MedianRadialError(const authoring::ReliefResult& result, const CavityOptions& clip);

}  // namespace arthro::test
