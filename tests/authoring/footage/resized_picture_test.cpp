#include "authoring/footage/resized_picture.h"

#include <gtest/gtest.h>

namespace arthro::authoring {
namespace {

// Red counts the pixels, row by row.
ColourImage Counted(int width, int height) {
  ColourImage picture(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) picture.at(x, y)[0] = static_cast<std::uint8_t>(y * width + x);
  return picture;
}

TEST(ResizedPicture, ANarrowerOneHasTheMeansOfThePixelsThatItCovers) {
  const ColourImage small = Resized(Counted(8, 4), 4, 2);
  ASSERT_EQ(small.width, 4);
  ASSERT_EQ(small.height, 2);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x)
      EXPECT_NEAR(small.at(x, y)[0], 16 * y + 2 * x + 4.5, 0.5) << x << " " << y;
}

TEST(ResizedPicture, APartIsCutOut) {
  const ColourImage part = Resized(Counted(8, 4), {2, 1, 5, 3}, 3, 2);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) EXPECT_EQ(part.at(x, y)[0], 8 * (y + 1) + x + 2);
}

TEST(ResizedPicture, AnEmptyOneStaysEmpty) { EXPECT_TRUE(Resized({}, 4, 2).empty()); }

}  // namespace
}  // namespace arthro::authoring
