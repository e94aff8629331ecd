// Standard deviations of camera poses that a bundle adjustment left, with the points free: what the
// pixels know of the poses as a whole (free network; Triggs et al., Bundle Adjustment - A Modern
// Synthesis, 2000, §9). The similarity is taken out that brings all poses nearest, where a turn
// counts as the way that it gives a point at the mean range. Unit of the poses.
#pragma once

#include <optional>
#include <vector>

#include "authoring/relief/motion/bundle/bundle.h"

namespace arthro::authoring {

// Factor between the true error of poses and the standard deviation that independent observations
// would give: points that are near each other, or followed for long, share their errors. Twelve
// cavity clips with known poses have 1.3 to 5.5, with a median of 3.3.
inline constexpr double kSharedErrors = 3;

struct PoseSigma {
  double centre = 0;    // root of the three variances' sum
  double rotation = 0;  // rad, likewise
};

struct PoseSigmas {
  std::vector<std::optional<PoseSigma>> frames;  // nothing where a frame has no pose
  double pixel = 0;  // px, standard deviation of one coordinate of an observation
};

// Independent observations are assumed. The weights are those of the adjustment's robust loss. Up
// to `most_frames` frames enter, evenly spread; the others take the values of the nearest one,
// which are then upper bounds. Nothing in `frames` where fewer observations than unknowns are left.
PoseSigmas SigmasOf(const std::vector<Track>& tracks, const LensProfile& lens,
                    const Reconstruction& scene, int most_frames = 120);

// Root mean square over the frames, rad; 0 where no frame has a value.
double RmsRotation(const PoseSigmas& sigmas);

}  // namespace arthro::authoring
