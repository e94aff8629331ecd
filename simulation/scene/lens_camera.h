// Effects of the optics and of the sensor behind a lens, beside its projection. Lengths are
// shares of the radius of the round window; grey levels are those of 8 bits.
#pragma once

#include "simulation/core/options.h"

namespace arthro {

struct LensCamera {
  double fringe = 0.0015;
  double rim_blur = 0.6;
  double sharpening = 1.0;
  double grain = 1.0;
  friend bool operator==(const LensCamera&, const LensCamera&) = default;
  template <class V>
  void Visit(V&& v) {
    v("fringe", fringe, Range{0, 0.02}, "",
      "Lateral colour of the lens: displacement of red outwards and of blue inwards at the rim, as "
      "a share of the window's radius.");
    v("rim_blur", rim_blur, Range{0, 1}, "",
      "Loss of sharpness at the rim: 0 is as sharp as the centre, 1 averages each pixel with its "
      "neighbours.");
    v("sharpening", sharpening, Range{0, 3}, "",
      "Gain of the sensor's sharpening on the detail of a pixel against its neighbours.");
    v("grain", grain, Range{0, 20}, "grey levels", "Largest noise of the sensor, of 255.");
  }
};

}  // namespace arthro
