// Smoothness of a movement from its speed, one value every 10 ms. Both numbers are negative; more
// is smoother. They do not depend on how fast or how far the movement goes.
#pragma once

#include <optional>
#include <span>

namespace arthro::simulation {

// Spectral arc length: minus the length of the curve that the normalised amplitudes of the speed
// draw over the frequencies, up to 10 Hz and down to 5 % of the largest amplitude [Balasubramanian
// et al. 2015]. Nothing for a tool that does not move.
std::optional<double> SpectralArcLength(std::span<const double> speed);

// Log dimensionless jerk: −ln(T³ / v² ∫ v''² dt) with the largest speed v and the duration T
// [Balasubramanian et al. 2015]. Nothing for a tool that does not move.
std::optional<double> LogDimensionlessJerk(std::span<const double> speed);

// Number of maxima of the speed that reach `least` m/s, stand out by 10 mm/s and lie at least
// 0.1 s apart, the higher first.
int MoveCount(std::span<const double> speed, double least);

}  // namespace arthro::simulation
