// Relief as it is touched: smoothed against noise of single pixels and, where its standard error is
// known, until the noise that is left has a bounded slope [method.md, Backdrop force].
#pragma once

#include <vector>

#include "simulation/scene/image.h"
#include "simulation/scene/scene.h"

namespace arthro::simulation {

struct TouchedRelief {
  std::vector<float> height;  // m, per pixel
  std::vector<float> sigma;   // m, smoothed standard error; empty where none is known
};

// Binomial smoothing by normalised convolution, so that holes (NaN) neither pull nor spread.
TouchedRelief SmoothRelief(const DepthMap& depth, int passes);

// Limits of the smoothing by standard error.
struct NoiseLimits {
  double slope = 0.1;    // rms, of the noise that is left
  double widest = 5e-3;  // m, standard deviation of the widest smoothing
};

// The same, and beyond it a smoothing of the standard deviation s = σ / (2√2 slope), m. Noise of
// the standard deviation σ and any correlation length then has at most the rms slope `slope` per
// axis. The smoothing is exact on planes, also beside holes, and does not cross a connected step
// that is large against the error (relief_steps.h). `sigma` has the size of `depth`; NaN in it
// counts as its largest value.
TouchedRelief SmoothRelief(const DepthMap& depth, int passes, const DepthMap& sigma,
                           const Backdrop& backdrop, const NoiseLimits& limits);

// The depth map with the noise that `sigma` explains removed in this way, for the picture; medians
// of 3 x 3 pixels take the place of the smoothing of single pixels, and unknown depths stay
// unknown.
DepthMap WithoutNoise(const DepthMap& depth, const DepthMap& sigma, const Backdrop& backdrop);

}  // namespace arthro::simulation
