#include "authoring/relief/editing/relief_profile.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace arthro::authoring {

std::vector<ProfileSample> SampleProfile(const ReliefView& view, const glm::dvec2& from,
                                         const glm::dvec2& to, int most) {
  std::vector<ProfileSample> samples;
  const double length = glm::distance(from, to);
  if (!(length >= 1)) return samples;
  const int count = std::clamp(static_cast<int>(std::ceil(length)) + 1, 2, std::max(2, most));
  samples.reserve(static_cast<std::size_t>(count));
  glm::dvec3 last = DirectionFromPixel(view.projection, from);
  double angle = 0;
  for (int i = 0; i < count; ++i) {
    const glm::dvec2 pixel = glm::mix(from, to, static_cast<double>(i) / (count - 1));
    const glm::dvec3 direction = DirectionFromPixel(view.projection, pixel);
    // Twice the arc sine of half the chord is exact for small angles too.
    angle += 2 * std::asin(std::min(1.0, 0.5 * glm::distance(last, direction)));
    last = direction;
    samples.push_back({ReadRelief(view, pixel), angle});
  }
  return samples;
}

RangeSpan RangesOf(const std::vector<ProfileSample>& samples) {
  RangeSpan span;
  for (const ProfileSample& sample : samples) {
    const ReliefReading& reading = sample.reading;
    if (!std::isfinite(reading.range)) continue;
    const double sigma = std::isfinite(reading.sigma) ? reading.sigma : 0;
    const bool is_first = span.furthest == 0;
    span.nearest = is_first ? reading.range - sigma : std::min(span.nearest, reading.range - sigma);
    span.furthest = std::max(span.furthest, reading.range + sigma);
  }
  return span;
}

}  // namespace arthro::authoring
