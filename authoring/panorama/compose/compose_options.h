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
      "A larger panorama is reduced to this size.");
    v("most_stretch", most_stretch, Range{2, 1000}, "",
      "A frame whose area grows by more than this from its middle to its rim, or beyond the other "
      "frames, is left out.");
    v("even_light", even_light, Any{}, "",
      "Remove the light's falloff and the exposure of each frame.");
    v("estimate_response", estimate_response, Any{}, "",
      "Estimate the camera's compression of bright tones from the frames; otherwise assume a power "
      "law.");
    v("light_reach", light_reach, Range{0, 4}, "",
      "Freedom of a low-frequency correction of brightness per frame; 0 removes only the light "
      "common to all frames.");
    v("outlier", outlier, Range{0.02, 2}, "",
      "Cells whose brightness or colour differs from the consensus by more than this share (tool, "
      "debris, highlight) get no weight.");
    v("averaging", averaging, Range{0, 1}, "",
      "1 averages frames whose places are certain to a pixel, which lowers noise; 0 takes each "
      "place "
      "from one frame.");
    v("feather", feather, Range{0, 64}, "px", "Width of the soft border of the imaged region.");
    v("preview_every", preview_every, Range{1, 1000}, "frames",
      "Interval between two previews of the growing panorama.");
  }
};

}  // namespace arthro::authoring
