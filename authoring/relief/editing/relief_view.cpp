#include "authoring/relief/editing/relief_view.h"

#include <cmath>
#include <limits>

namespace arthro::authoring {

ReliefReading ReadRelief(const ReliefView& view, const glm::dvec2& pixel) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  ReliefReading reading{pixel, {}, kUnknown, kUnknown, ReliefOrigin::kNone};
  const DepthMap& relief = view.relief;
  const double x = std::round(pixel.x), y = std::round(pixel.y);
  if (!(x >= 0 && y >= 0 && x < relief.width && y < relief.height)) return reading;
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  reading.range = view.radius - static_cast<double>(relief.at(column, row));
  reading.point = DirectionFromPixel(view.projection, pixel) * reading.range;
  const auto fits = [&](const auto& map) {
    return map.width == relief.width && map.height == relief.height;
  };
  if (fits(view.sigma)) reading.sigma = static_cast<double>(view.sigma.at(column, row));
  if (fits(view.origin)) reading.origin = view.origin.at(column, row);
  return reading;
}

}  // namespace arthro::authoring
