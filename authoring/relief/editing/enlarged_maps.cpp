#include "authoring/relief/editing/enlarged_maps.h"

#include <algorithm>
#include <cmath>

namespace arthro::authoring {

DepthMap MapAtPictureSize(const DepthMap& map, int factor) {
  DepthMap large(map.width * factor, map.height * factor);
  for (int y = 0; y < large.height; ++y) {
    const double v = std::clamp((y + 0.5) / factor - 0.5, 0.0, map.height - 1.0);
    const int top = static_cast<int>(v), low = std::min(top + 1, map.height - 1);
    const double fy = v - top;
    for (int x = 0; x < large.width; ++x) {
      const double u = std::clamp((x + 0.5) / factor - 0.5, 0.0, map.width - 1.0);
      const int left = static_cast<int>(u), right = std::min(left + 1, map.width - 1);
      const double fx = u - left;
      const auto at = [&](int i, int j) { return static_cast<double>(map.at(i, j)); };
      double value = (1 - fy) * ((1 - fx) * at(left, top) + fx * at(right, top)) +
                     fy * ((1 - fx) * at(left, low) + fx * at(right, low));
      const double nearest = at(x / factor, y / factor);
      if (std::isnan(value) || std::isnan(nearest)) value = nearest;
      large.at(x, y) = static_cast<float>(value);
    }
  }
  return large;
}

OriginMap MapAtPictureSize(const OriginMap& map, int factor) {
  OriginMap large(map.width * factor, map.height * factor);
  for (int y = 0; y < large.height; ++y)
    for (int x = 0; x < large.width; ++x) large.at(x, y) = map.at(x / factor, y / factor);
  return large;
}

}  // namespace arthro::authoring
