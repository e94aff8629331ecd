// Rectangle of whole pixels of a picture: columns x to x + width - 1, rows y to y + height - 1,
// with (0, 0) at the top left.
#pragma once

#include "simulation/core/options.h"

namespace arthro::authoring {

struct PixelBox {
  int x = 0, y = 0, width = 0, height = 0;
  friend bool operator==(const PixelBox&, const PixelBox&) = default;
  template <class V>
  void Visit(V&& v) {
    constexpr Range kPixel{0, 65535}, kSize{1, 65535};
    v("x", x, Required{kPixel}, "px", "Left column.");
    v("y", y, Required{kPixel}, "px", "Top row.");
    v("width", width, Required{kSize}, "px", "Number of columns.");
    v("height", height, Required{kSize}, "px", "Number of rows.");
  }
};

}  // namespace arthro::authoring
