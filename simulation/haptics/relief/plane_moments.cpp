#include "simulation/haptics/relief/plane_moments.h"

#include <cstddef>
#include <limits>
#include <thread>
#include <utility>

namespace arthro::simulation {

PlaneMoments::PlaneMoments(FloatPlane mass, const FloatPlane& height, int map_width, int map_height,
                           const MapFrame& frame)
    : width_(map_width),
      frame_(frame),
      centre_x_(0.5f * static_cast<float>(frame.width)),
      centre_y_(0.5f * static_cast<float>(frame.height)),
      m_(std::move(mass)) {
  const auto w = static_cast<std::size_t>(map_width);
  // `term(x, y)`: factor of the mass or of the height at a pixel.
  const auto fill = [&](FloatPlane& to, const FloatPlane& of, const auto& term) {
    to.resize(of.size());
    for (int row = 0; row < map_height; ++row) {
      const float y = static_cast<float>(frame_.top + row) - centre_y_;
      const float* __restrict const from = of.data() + static_cast<std::size_t>(row) * w;
      float* __restrict const put = to.data() + static_cast<std::size_t>(row) * w;
      for (int column = 0; column < map_width; ++column)
        put[column] = from[column] * term(static_cast<float>(frame_.left + column) - centre_x_, y);
    }
  };
  const std::jthread other([&] {
    fill(xx_, m_, [](float x, float) { return x * x; });
    fill(xy_, m_, [](float x, float y) { return x * y; });
    fill(yy_, m_, [](float, float y) { return y * y; });
  });
  fill(x_, m_, [](float x, float) { return x; });
  fill(y_, m_, [](float, float y) { return y; });
  fill(hx_, height, [](float x, float) { return x; });
  fill(hy_, height, [](float, float y) { return y; });
}

void PlaneMoments::PlanesAt(const FloatPlane& height, int row, int first, int last,
                            float* heights) const {
  // A pixel is as wide as a variance of 1/12; this also keeps a single row from being singular.
  constexpr float kOfPixel = 1.0f / 12.0f;
  const auto begin = static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                     static_cast<std::size_t>(first);
  const float *const m = m_.data() + begin, *const mh = height.data() + begin,
                     *const mx = x_.data() + begin, *const my = y_.data() + begin,
                     *const mxx = xx_.data() + begin, *const mxy = xy_.data() + begin,
                     *const myy = yy_.data() + begin, *const mhx = hx_.data() + begin,
                     *const mhy = hy_.data() + begin;
  float* __restrict const to = heights;
  const float centre_x = centre_x_, row_y = static_cast<float>(frame_.top + row) - centre_y_;
  const int left = frame_.left + first;
  for (int i = 0; i < last - first; ++i) {
    const float per_mass = 1.0f / m[i];
    const float x = mx[i] * per_mass, y = my[i] * per_mass, h = mh[i] * per_mass;
    const float xx = mxx[i] * per_mass - x * x + kOfPixel, xy = mxy[i] * per_mass - x * y,
                yy = myy[i] * per_mass - y * y + kOfPixel;
    const float hx = mhx[i] * per_mass - h * x, hy = mhy[i] * per_mass - h * y;
    const float det = xx * yy - xy * xy;
    const float du = static_cast<float>(left + i) - centre_x - x, dv = row_y - y;
    // Infinity where there is no plane, so that the loop has no branch.
    const float divisor = det > 0.0f ? det : std::numeric_limits<float>::infinity();
    to[i] = h + ((yy * hx - xy * hy) * du + (xx * hy - xy * hx) * dv) / divisor;
  }
}

}  // namespace arthro::simulation
