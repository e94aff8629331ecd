// Optics of a disturbed picture: the blur of a camera out of focus, and the gain of one with too
// much light. m, px.
#pragma once

#include "simulation/scope/disturbances.h"

namespace arthro::app {

using simulation::Disturbances;

// Optics of a blurred picture. An aperture, opened by the strength, images a point as a disc of
// aperture · |1/distance − 1/focus| rad.
inline constexpr double kBlurAperture = 0.6e-3;  // m, at strength 1
inline constexpr double kNearBlurFocus = 30e-3;  // m; nearer parts are blurred
inline constexpr double kFarBlurFocus = 7e-3;    // m; farther parts are blurred

// Returns the diameter of that disc in the middle of the window, px.
double BlurDiameter(const Disturbances& disturbances, double distance, double field_of_view,
                    double window_radius_px);

// Stops of overexposure at strength 1.
inline constexpr double kOverexposureStops = 2.0;
// Returns the factor on linear light.
double ExposureGain(double overexposure);

}  // namespace arthro::app
