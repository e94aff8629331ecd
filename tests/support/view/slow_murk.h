// Reference of the murk (app/view/disturbances/murk_field.h) at one place, without shortcuts: each
// noise from the eight corners of its cell, in double precision.
#pragma once

#include <array>

#include <glm/vec2.hpp>

namespace arthro::test {

// Density of the near and of the far fluid and unevenness of the dew, 0 to 1. `at`: share of the
// window from the left and from below. `time`: s.
std::array<double, 3> SlowMurk(int seed, double time, const glm::dvec2& at);

}  // namespace arthro::test
