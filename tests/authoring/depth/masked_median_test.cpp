#include "authoring/depth/masked_median.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

namespace arthro::authoring {
namespace {

GreyPlane RandomPlane(int width, int height, double imaged, unsigned seed) {
  GreyPlane plane{width, height, {}, {}};
  std::mt19937 random(seed);
  for (int i = 0; i < width * height; ++i) {
    plane.grey.push_back(static_cast<std::uint16_t>(random() % (kWhite + 1u)));
    plane.imaged.push_back(random() % 1000 < 1000 * imaged);
  }
  return plane;
}

// Median by its definition: sorts the imaged values in the window and takes the lower middle one.
std::vector<std::uint16_t> ByDefinition(const GreyPlane& plane, int radius) {
  std::vector<std::uint16_t> result = plane.grey;
  for (int y = 0; y < plane.height; ++y)
    for (int x = 0; x < plane.width; ++x) {
      if (!plane.imaged[plane.Index(x, y)]) continue;
      std::vector<std::uint16_t> values;
      for (int v = std::max(0, y - radius); v <= std::min(plane.height - 1, y + radius); ++v)
        for (int u = std::max(0, x - radius); u <= std::min(plane.width - 1, x + radius); ++u)
          if (plane.imaged[plane.Index(u, v)]) values.push_back(plane.grey[plane.Index(u, v)]);
      std::sort(values.begin(), values.end());
      result[plane.Index(x, y)] = values[(values.size() - 1) / 2];
    }
  return result;
}

// Every implementation (vector network, sorting near the mask, moving histogram) gives the values
// of the definition.
TEST(MaskedMedian, IsTheMedianOfTheImagedPixelsExactly) {
  for (const double imaged : {1.0, 0.999, 0.7, 0.05, 0.0})
    for (const auto& [width, height] :
         {std::pair{50, 140}, std::pair{5, 70}, std::pair{70, 3}, std::pair{1, 1}})
      for (const int radius : {0, 1, 2, 3, 6, 15}) {
        GreyPlane plane = RandomPlane(width, height, imaged, 11u * radius + width);
        const auto expected = ByDefinition(plane, radius);
        MaskedMedian(plane, radius);
        EXPECT_EQ(plane.grey, expected)
            << width << " x " << height << ", radius " << radius << ", imaged " << imaged;
      }
}

}  // namespace
}  // namespace arthro::authoring
