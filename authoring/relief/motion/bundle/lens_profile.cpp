#include "authoring/relief/motion/bundle/lens_profile.h"

#include <algorithm>

#include "simulation/core/units.h"

namespace arthro::authoring {

LensProfile::LensProfile(const Lens& lens)
    : focal_px_(FocalAtAxis(lens)), cx_(lens.cx), cy_(lens.cy), aspect_(lens.aspect) {
  // The largest angle whose pixel the model gives, and not further off the axis than any use.
  constexpr double kLargest = 110, kPinholeLargest = 80, kStep = 0.5;  // degrees
  const double most = lens.model == LensModel::kPinhole ? kPinholeLargest : kLargest;
  double largest = kStep;
  for (double angle = kStep; angle <= most; angle += kStep) {
    if (!RadiusFromAngle(lens, RadiansFromDegrees(angle))) break;
    largest = angle;
  }
  least_cosine_ = std::cos(RadiansFromDegrees(largest));
  step_ = (1 - least_cosine_) / kCells;
  table_.resize(kCells + 1);
  for (int i = 0; i <= kCells; ++i) {
    const double cosine = std::clamp(least_cosine_ + i * step_, -1.0, 1.0);
    const double angle = std::acos(cosine), sine = std::sin(angle);
    table_[static_cast<std::size_t>(i)] =
        sine > 1e-6 ? RadiusFromAngle(lens, angle).value_or(focal_px_ * angle) / sine : focal_px_;
  }
}

}  // namespace arthro::authoring
