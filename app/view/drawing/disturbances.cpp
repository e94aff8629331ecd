#include "app/view/drawing/disturbances.h"

#include <algorithm>
#include <cmath>

namespace arthro::app {

double BlurDiameter(const Disturbances& disturbances, double distance, double field_of_view,
                    double window_radius_px) {
  const double nearer = std::max(1.0 / distance - 1.0 / kNearBlurFocus, 0.0);
  const double further = std::max(1.0 / kFarBlurFocus - 1.0 / distance, 0.0);
  const double angle =
      kBlurAperture * std::max(disturbances.near_blur * nearer, disturbances.far_blur * further);
  return angle * window_radius_px / (2.0 * std::sin(field_of_view / 4.0));
}

double ExposureGain(double overexposure) { return std::exp2(kOverexposureStops * overexposure); }

}  // namespace arthro::app
