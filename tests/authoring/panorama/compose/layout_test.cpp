#include "authoring/panorama/compose/layout.h"

#include <limits>

#include <gtest/gtest.h>

#include "tests/authoring/panorama/compose/small_clip.h"

namespace arthro::authoring {
namespace {

Layout Lay(const std::vector<FrameResult>& places, const ComposeOptions& options = {}) {
  const Rectifier& rectifier = test::PinholeRectifier();
  return LayOut(rectifier.mask(), rectifier.view(), places, options);
}

std::vector<FrameResult> ThreePlaces() {
  test::SmallClip clip;
  clip.corners = {{0, 0}, {50, 10}, {100, 20}};
  return clip.Places();
}

TEST(Layout, EveryOutlineLiesInsideThePanorama) {
  const Layout layout = Lay(ThreePlaces());
  ASSERT_EQ(layout.frames.size(), 3u);
  for (const LaidFrame& frame : layout.frames)
    for (const cv::Point2d& p : frame.outline) {
      EXPECT_GE(p.x, -1.0);
      EXPECT_GE(p.y, -1.0);
      EXPECT_LE(p.x, layout.size.width);
      EXPECT_LE(p.y, layout.size.height);
    }
  EXPECT_LE(layout.size.width, test::kWindowWidth + 100 + 2);
}

TEST(Layout, PerspectiveBlowUpIsLeftOutWithItsReason) {
  auto places = ThreePlaces();
  places[1].panorama_from_rectified(2, 0) = -0.0055;  // the horizon just beyond the right rim
  const Layout layout = Lay(places);
  ASSERT_EQ(layout.left_out.size(), 1u);
  EXPECT_EQ(layout.left_out[0].index, 1);
  EXPECT_NE(layout.left_out[0].reason.find("stretched"), std::string::npos);
  EXPECT_LT(layout.size.area(), 300 * 300);
}

TEST(Layout, HugeNotANumberAndMirroredFramesAreLeftOut) {
  auto places = ThreePlaces();
  places[0].panorama_from_rectified = cv::Matx33d(100, 0, 0, 0, 100, 0, 0, 0, 1);
  places[1].panorama_from_rectified(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Lay(places).left_out.size(), 2u);
  auto mirrored = ThreePlaces();
  mirrored[2].panorama_from_rectified(0, 0) = -1;
  EXPECT_EQ(Lay(mirrored).left_out.size(), 1u);
}

TEST(Layout, SignOfTheHomographyDoesNotMatter) {
  auto places = ThreePlaces();
  for (FrameResult& place : places) place.panorama_from_rectified *= -3.0;
  const Layout a = Lay(ThreePlaces()), b = Lay(places);
  EXPECT_EQ(a.size, b.size);
  EXPECT_NEAR(a.frames[1].outline[0].x, b.frames[1].outline[0].x, 1e-9);
}

TEST(Layout, OtherPiecesStayOut) {
  auto places = ThreePlaces();
  places[2].component = 1;
  const Layout layout = Lay(places);
  EXPECT_EQ(layout.frames.size(), 2u);
  EXPECT_TRUE(layout.left_out.empty());
}

TEST(Layout, CellsGrowWhenFramesAreMany) {
  std::vector<FrameResult> places;
  for (int i = 0; i < 9000; ++i) {
    places.push_back(ThreePlaces()[0]);
    places.back().index = i;
  }
  // 9000 frames of 0.02 Mpx: 11 million cells of 4 px, more than the limit.
  EXPECT_EQ(Lay(places).cell, 8);
}

}  // namespace
}  // namespace arthro::authoring
