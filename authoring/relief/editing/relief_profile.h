// Range of the surface along a straight line across the panorama.
#pragma once

#include <vector>

#include "authoring/relief/editing/relief_view.h"

namespace arthro::authoring {

struct ProfileSample {
  ReliefReading reading;
  double angle = 0;  // rad at the portal, from the line's first end
};

// One sample per pixel of the line, at least two and at most `most`. Empty where the line is
// shorter than a pixel.
std::vector<ProfileSample> SampleProfile(const ReliefView& view, const glm::dvec2& from,
                                         const glm::dvec2& to, int most = 600);

// Longest and shortest range of the samples whose range is known, with one sigma around each.
struct RangeSpan {
  double nearest = 0, furthest = 0;  // m; equal: nothing is known
};
RangeSpan RangesOf(const std::vector<ProfileSample>& samples);

}  // namespace arthro::authoring
