// Presets of the weights by which colours become grey.
#pragma once

#include "authoring/depth/depth_options.h"

namespace arthro::authoring {

struct ColourFilter {
  const char* words;
  const char* help;
  double red, green, blue;  // weights, of which only the ratio counts
};

inline constexpr ColourFilter kColourFilters[] = {
    {"Little red", "For muscle and synovium, which are redder and not nearer.", 0.2, 0.4, 0.4},
    {"Green", "Strongest contrast of vessels and folds.", 0.0, 1.0, 0.0},
    {"Green and blue", "No red at all, for bloody footage.", 0.0, 0.5, 0.5},
    {"Luminance", "Brightness as the eye sees it, for cartilage and meniscus.", 0.2126, 0.7152,
     0.0722},
    {"Red", "Least of the blood and the vessels, for pale tissue under a red film.", 1.0, 0.0, 0.0},
};

// Index of the preset with these weights; -1: none.
inline int ColourFilterOf(const DepthOptions& options) {
  int index = 0;
  for (const ColourFilter& filter : kColourFilters) {
    if (filter.red == options.red_weight && filter.green == options.green_weight &&
        filter.blue == options.blue_weight)
      return index;
    ++index;
  }
  return -1;
}

inline void SetColourFilter(DepthOptions& options, const ColourFilter& filter) {
  options.red_weight = filter.red;
  options.green_weight = filter.green;
  options.blue_weight = filter.blue;
}

}  // namespace arthro::authoring
