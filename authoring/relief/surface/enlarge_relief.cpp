#include "authoring/relief/surface/enlarge_relief.h"

#include <algorithm>
#include <cmath>

namespace arthro::authoring {

DepthMap EnlargedMap(const DepthMap& map, int factor, float most_step) {
  DepthMap large(map.width * factor, map.height * factor);
  const auto cell = [factor](int pixel) {
    return (static_cast<float>(pixel) + 0.5f) / static_cast<float>(factor) - 0.5f;
  };
  for (int y = 0; y < large.height; ++y)
    for (int x = 0; x < large.width; ++x) {
      const float u = std::clamp(cell(x), 0.0f, static_cast<float>(map.width - 1)),
                  v = std::clamp(cell(y), 0.0f, static_cast<float>(map.height - 1));
      const int left = static_cast<int>(u), top = static_cast<int>(v);
      const int right = std::min(left + 1, map.width - 1), low = std::min(top + 1, map.height - 1);
      const float a = map.at(left, top), b = map.at(right, top), c = map.at(left, low),
                  d = map.at(right, low);
      const auto [least, most] = std::minmax({a, b, c, d});
      const float fu = u - static_cast<float>(left), fv = v - static_cast<float>(top);
      const bool is_smooth = most - least <= most_step && std::isfinite(a + b + c + d);
      large.at(x, y) = is_smooth ? (1 - fv) * ((1 - fu) * a + fu * b) + fv * ((1 - fu) * c + fu * d)
                                 : map.at(fu < 0.5f ? left : right, fv < 0.5f ? top : low);
    }
  return large;
}

OriginMap EnlargedMap(const OriginMap& map, int factor) {
  OriginMap large(map.width * factor, map.height * factor);
  for (int y = 0; y < large.height; ++y)
    for (int x = 0; x < large.width; ++x) large.at(x, y) = map.at(x / factor, y / factor);
  return large;
}

}  // namespace arthro::authoring
