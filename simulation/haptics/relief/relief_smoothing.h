// Relief as it is touched: smoothed against noise of single pixels and, where its standard error is
// known, until the noise that is left has a bounded slope [method.md, Backdrop force].
#pragma once

#include <atomic>
#include <vector>

#include "simulation/scene/image.h"
#include "simulation/scene/pixel_bounds.h"
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
// unknown. Throws Error(kCancelled) once `stop` is set; null: it never is.
DepthMap WithoutNoise(const DepthMap& depth, const DepthMap& sigma, const Backdrop& backdrop,
                      const std::atomic<bool>* stop = nullptr);

// Part of such a map.
struct QuietPart {
  PixelBounds box;
  DepthMap relief;  // size of the box
  int read = 0;     // pixels that were computed
};

// The part of WithoutNoise(depth, sigma, backdrop) that a change of depth or sigma within `changed`
// alters: the smoothing reaches so far. The same bytes where no step lies near; a step is judged by
// the part of its line within the pixels that were read. The whole map where `sigma` lacks a value,
// which counts as the largest of all.
QuietPart WithoutNoiseAround(const DepthMap& depth, const DepthMap& sigma, const Backdrop& backdrop,
                             const PixelBounds& changed, const std::atomic<bool>* stop = nullptr);

}  // namespace arthro::simulation
