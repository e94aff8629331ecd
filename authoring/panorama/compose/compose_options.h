// Options of composition.
#pragma once

#include "simulation/core/options.h"

namespace arthro::authoring {

struct ComposeOptions {
  double most_megapixels = 16;
  double most_stretch = 12;
  bool even_light = true;
  bool estimate_response = true;
  double light_reach = 0.5;
  double outlier = 0.12;
  double averaging = 1.0;
  double feather = 8;
  int preview_every = 4;

  template <class V>
  void Visit(V&& v) {
    v("most_megapixels", most_megapixels, Range{0.1, 200}, "Mpx",
      "A panorama larger than this is made smaller.");
    v("most_stretch", most_stretch, Range{2, 1000}, "",
      "A frame whose area grows by more than this from its middle to its rim, or beyond the other "
      "frames, is left out.");
    v("even_light", even_light, Any{}, "",
      "Take the light's falloff and the exposure of each frame out.");
    v("estimate_response", estimate_response, Any{}, "",
      "Find how the camera compresses bright tones from how colours change with the light; "
      "otherwise a plain power law is assumed.");
    v("light_reach", light_reach, Range{0, 4}, "",
      "How freely a slow change of brightness within a frame follows its neighbours; 0: only the "
      "light common to all frames is taken out.");
    v("outlier", outlier, Range{0.02, 2}, "",
      "A part of a frame whose brightness or colour is off from what most frames show by more than "
      "this share (tool, debris, glint) loses its say.");
    v("averaging", averaging, Range{0, 1}, "",
      "1: frames that agree share in a place, which lowers noise; 0: each place comes from one "
      "frame.");
    v("feather", feather, Range{0, 64}, "px", "Width of the soft border of the imaged region.");
    v("preview_every", preview_every, Range{1, 1000}, "frames",
      "How often the observer is shown the growing panorama.");
  }
};

}  // namespace arthro::authoring
