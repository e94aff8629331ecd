#include "app/bench/view/live_error.h"

#include <algorithm>
#include <cmath>

#include "app/view/exposure/picture_statistics.h"

namespace arthro::app {

double ErrorAgainstStill(ArthroscopicView& view, const Picture& picture, int size) {
  Picture live = picture;
  live.camera->grain = 0;
  Picture still = live;
  still.rays = 2;
  still.samples = 8;
  view.Render(still, size);
  const ColourImage wanted = view.ReadPixels();
  view.Render(live, size);
  const ColourImage drawn = view.ReadPixels();
  const PictureMask mask =
      DiscMask(size, size, 0.5 * (size - 1), 0.5 * (size - 1), 0.5 * kMeasuredRadius * size);
  double squares = 0;
  int count = 0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      if (mask.at(x, y)) squares += std::pow(drawn.at(x, y)[1] - wanted.at(x, y)[1], 2), ++count;
  return std::sqrt(squares / std::max(count, 1));
}

}  // namespace arthro::app
