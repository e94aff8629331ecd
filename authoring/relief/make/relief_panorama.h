// Panorama over a measured relief, in the form of authoring/panorama's result.
#pragma once

#include "authoring/panorama/make_panorama.h"
#include "authoring/relief/make/make_relief.h"

namespace arthro::authoring {

// `relief` must be measured and have a picture.
PanoramaResult PanoramaFromRelief(const ReliefResult& relief, const Lens& lens);

// Expected error of the placed frames on average, in rad as seen from the tip: the same for a
// panorama on a plane and for one over a relief.
double ExpectedErrorAngle(const PanoramaReport& report);

}  // namespace arthro::authoring
