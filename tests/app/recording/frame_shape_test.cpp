#include "app/recording/frame_shape.h"

#include <gtest/gtest.h>

#include "simulation/core/error.h"

namespace arthro::app {
namespace {

TEST(FrameShape, AFrameIsAsWideAsItsNameSaysAndEven) {
  EXPECT_EQ(FrameWidth(FrameShape::kSquare, 480), 480);
  EXPECT_EQ(FrameWidth(FrameShape::k4x3, 480), 640);
  EXPECT_EQ(FrameWidth(FrameShape::k16x9, 720), 1280);
  EXPECT_EQ(FrameWidth(FrameShape::k16x9, 1080), 1920);
  for (int height = 16; height < 200; height += 2)
    for (const auto shape : {FrameShape::k4x3, FrameShape::k16x9})
      EXPECT_EQ(FrameWidth(shape, height) % 2, 0) << height;
}

TEST(FrameShape, WordsAreReadBackAndOthersRefused) {
  for (const auto shape : {FrameShape::kSquare, FrameShape::k4x3, FrameShape::k16x9})
    EXPECT_EQ(FrameShapeOf(ToString(shape)), shape);
  for (const char* word : {"", "16:10", "Square", "4x3"}) EXPECT_THROW(FrameShapeOf(word), Error);
}

TEST(FrameShape, APictureStandsInTheMiddleOfItsBlackFrame) {
  ColourImage picture(6, 6);
  for (std::size_t i = 0; i < picture.rgb.size(); ++i)
    picture.rgb[i] = static_cast<std::uint8_t>(10 + i);
  const ColourImage frame = LaidOut(picture, FrameShape::k16x9);
  ASSERT_EQ(frame.width, 10);
  ASSERT_EQ(frame.height, 6);
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 10; ++x)
      for (int c = 0; c < 3; ++c)
        EXPECT_EQ(frame.at(x, y)[c], x >= 2 && x < 8 ? picture.at(x - 2, y)[c] : 0)
            << x << " " << y;
  EXPECT_EQ(LaidOut(picture, FrameShape::kSquare).rgb, picture.rgb);
}

TEST(FrameShape, OnAScreenTheFrameFillsWhatItCan) {
  // A screen wider than the frame: as high as the screen.
  EXPECT_EQ(PlaceOnScreen(FrameShape::k4x3, 1920, 1080), (ScreenPlace{420, 0, 1080}));
  EXPECT_EQ(PlaceOnScreen(FrameShape::kSquare, 1920, 1080), (ScreenPlace{420, 0, 1080}));
  // A screen narrower than the frame: bars above and below it too.
  EXPECT_EQ(PlaceOnScreen(FrameShape::k16x9, 1280, 1024), (ScreenPlace{280, 152, 720}));
  EXPECT_EQ(PlaceOnScreen(FrameShape::k16x9, 0, 0).edge, 0);
}

}  // namespace
}  // namespace arthro::app
