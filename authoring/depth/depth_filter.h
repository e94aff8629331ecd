// Relief from brightness [paper, 3.4]: a light at the scope makes near tissue bright, so a grey
// with little red is normalised to the depth range of the scene and cleaned by a median. An
// ordering of what is nearer, not a measurement: dark tissue reads as far, pale as near.
//
// In: a panorama, 8-bit colour. Out: the relief h [method.md, Backdrop], m, larger is nearer the
// scope, NaN where nothing was imaged. Steps: grey by weights; surround and rim masked; glints
// filled; median; percentiles to [far, near] through the law. The paper normalises before its
// median; the two commute, and this way noise does not set the range, and the range is filled
// exactly. The other estimators (light_falloff.h) find a relative distance, whose percentiles
// become the range in the same way.
#pragma once

#include "authoring/depth/depth_options.h"
#include "simulation/core/progress.h"
#include "simulation/scene/image.h"

namespace arthro::authoring {

struct DepthReport {
  double imaged_share = 0;      // of all pixels, 0 to 1; 0: nothing but surround
  double highlight_share = 0;   // of the imaged pixels that were glints
  double low_grey = 0;          // 0 to 255: what became furthest…
  double high_grey = 0;         // …and nearest; the paper's estimator only
  double distance_ratio = 0;    // furthest over nearest distance; the other estimators only
  bool is_flat = false;         // one grey throughout: everything lies at the far relief
  bool is_overexposed = false;  // too much is saturated to be glints; it was left as it is
};

// Throws Error(kBadArgument) for options outside their ranges or against each other. The same
// picture and options give the same bytes whatever the number of threads.
DepthMap DepthFromColour(const ColourImage& panorama, const DepthOptions& options,
                         DepthReport* report = nullptr, const Progress& progress = {});

// Checks ranges, and that the weights are not all zero, low lies below high and far not above near.
void CheckDepthOptions(const DepthOptions& options);

}  // namespace arthro::authoring
