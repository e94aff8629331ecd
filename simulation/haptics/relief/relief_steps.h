// Steps of a relief with noise: connected lines along which it changes by far more than its
// standard error explains [method.md, Backdrop force]. Beside them a smoothing takes care not to
// mix the two sides; elsewhere what looks like a step is noise.
#pragma once

#include <vector>

namespace arthro::simulation {

struct StepLimits {
  double errors = 7;           // least height of a step: five standard errors of a difference
  double slope = 1;            // least slope across it
  double extent = 4;           // least extent of a line, standard deviations of the smoothing
  int reach = 8;               // px to either side within which a step rises; footage is blurred
  double certain_share = 0.5;  // share of a line that has the least height; the rest has half of it
};

// Returns how near each pixel is to a step: 1 within two standard deviations of the smoothing, 0
// far from all of them. Empty where there is no step.
//
// `smooth`: the relief smoothed over some 2 px, so that white noise within reach does not exceed
// its standard error. `sigma`: that error before the smoothing, m; `smoothing`: standard deviation
// of the smoothing that it asks for, px; `pixel_size`: m. One value per pixel; NaN is unknown.
std::vector<float> NearSteps(int width, int height, const std::vector<float>& smooth,
                             const std::vector<float>& sigma, const std::vector<float>& smoothing,
                             const std::vector<float>& pixel_size, const StepLimits& limits = {});

}  // namespace arthro::simulation
