// Relief from brightness [paper, 3.4]: a light at the scope makes near tissue bright, so a grey
// with little red is normalised to the depth range of the scene and filtered by a median. The
// result ranks depth and is not a measurement: dark tissue reads as far, pale tissue as near.
//
// Input: a panorama, 8-bit colour. Output: the relief h [method.md, Backdrop], m, larger is nearer
// the scope, NaN where nothing was imaged. Steps: weighted grey; mask of surround and rim; filled
// highlights; median; percentiles to [far, near] through the law.
//
// The paper normalises before its median. The two commute; in this order noise does not set the
// range, and the range is filled exactly. The other estimators (light_falloff.h) find a relative
// distance, whose percentiles become the range in the same way.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "authoring/depth/depth_histogram.h"
#include "authoring/depth/depth_options.h"
#include "simulation/core/progress.h"
#include "simulation/scene/image.h"

namespace arthro::authoring {

// Mark of an author on a pixel of the panorama.
enum class DepthMark : std::uint8_t {
  kNone,    // unmarked
  kMasked,  // glint or instrument: filled from its surroundings
  kKept,    // tissue, although it looks like a glint
};

struct DepthReport {
  double imaged_share = 0;      // share of all pixels, 0 to 1; 0: surround only
  double highlight_share = 0;   // share of the imaged pixels that are highlights
  double low_grey = 0;          // 0 to 255, mapped to the far relief; the paper's estimator only
  double high_grey = 0;         // 0 to 255, mapped to the near relief; the paper's estimator only
  double distance_ratio = 0;    // furthest over nearest distance; the other estimators only
  DepthHistogram histogram;     // greys or nearness, before the percentiles
  bool is_flat = false;         // one grey throughout: everything lies at the far relief
  bool is_overexposed = false;  // too much is saturated for highlights; it was not filled
};

// Throws Error(kBadArgument) for options outside their ranges or inconsistent with each other. The
// same picture, options and marks give the same bytes for any number of threads. `marks`: one per
// pixel, or none at all.
DepthMap DepthFromColour(const ColourImage& panorama, const DepthOptions& options,
                         DepthReport* report = nullptr, const Progress& progress = {},
                         std::span<const DepthMark> marks = {});

// 1 at the pixels that are taken for highlights, before any mark; none where too much is saturated.
std::vector<std::uint8_t> FoundHighlights(const ColourImage& panorama, const DepthOptions& options);

// Checks the ranges of options, that weights which are used are not all zero, that low lies below
// high, and that far is not above near.
void CheckDepthOptions(const DepthOptions& options);

}  // namespace arthro::authoring
