#include "authoring/footage/find_circle.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "authoring/footage/footage.h"
#include "tests/support/shared_data.h"

namespace arthro::authoring {
namespace {

// Tissue with a bright middle and texture, seen through a window, with dark noise beyond. `soft` is
// the standard deviation of the rim's blur, px.
cv::Mat Scene(cv::Size size, const LensCircle& window, double soft = 0.7, double vignette = 0.6,
              unsigned seed = 1) {
  cv::Mat coverage(size, CV_32F), picture(size, CV_8UC3);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      coverage.at<float>(y, x) = static_cast<float>(
          std::clamp(window.r + 0.5 - std::hypot(x - window.cx, y - window.cy), 0.0, 1.0));
  cv::GaussianBlur(coverage, coverage, {}, soft);
  std::mt19937 random(seed);
  std::normal_distribution<float> noise(0, 2);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const double r = std::hypot(x - window.cx, y - window.cy) / window.r;
      const double light =
          (1 - vignette * r * r) * (0.8 + 0.2 * std::sin(0.1 * x) * std::cos(0.13 * y));
      const float value = 6 + coverage.at<float>(y, x) * static_cast<float>(200 * light);
      picture.at<cv::Vec3b>(y, x) = {cv::saturate_cast<uchar>(value + noise(random)),
                                     cv::saturate_cast<uchar>(0.6f * value + noise(random)),
                                     cv::saturate_cast<uchar>(0.5f * value + noise(random))};
    }
  return picture;
}

LensCircle Find(const cv::Mat& rgb) {
  CircleFinder finder;
  finder.Add(rgb);
  return finder.Find().circle;
}

// Tolerance of one pixel: the later stages exclude 3 % of the radius.
void ExpectCircle(const LensCircle& found, const LensCircle& truth, double within = 1.0) {
  EXPECT_NEAR(found.cx, truth.cx, within);
  EXPECT_NEAR(found.cy, truth.cy, within);
  EXPECT_NEAR(found.r, truth.r, within);
}

TEST(FindCircle, WholeAndCutWindowsToLessThanAPixel) {
  const std::vector<LensCircle> windows = {
      {200, 160, 150},  // whole
      {198, 161, 190},  // the sensor cuts top and bottom off
      {205, 158, 235},  // only the corners are dark
      {60, 40, 120},    // off-centre: its middle is near a corner
      {-20, 150, 200},  // its middle is outside the picture
      {330, 250, 25},   // tiny
  };
  for (const LensCircle& window : windows) {
    SCOPED_TRACE(window.r);
    ExpectCircle(Find(Scene({400, 320}, window)), window, 0.7);
  }
}

TEST(FindCircle, SoftAndDarkRim) {
  const LensCircle window{200, 160, 150};
  ExpectCircle(Find(Scene({400, 320}, window, 2.5)), window, 1.0);
  ExpectCircle(Find(Scene({400, 320}, window, 0.7, 0.85)), window, 1.0);
}

TEST(FindCircle, StraightEdgesAndTextInTheSurroundDoNotMoveIt) {
  const LensCircle window{200, 160, 140};
  cv::Mat picture = Scene({400, 320}, window);
  picture.rowRange(0, 55) = cv::Scalar::all(5);  // flattened inside the picture
  picture.rowRange(275, 320) = cv::Scalar::all(5);
  cv::putText(picture, "12:34 ID 0815", {5, 20}, cv::FONT_HERSHEY_SIMPLEX, 0.6,
              cv::Scalar::all(220), 2);
  cv::circle(picture, {75, 90}, 12, cv::Scalar(200, 200, 200), cv::FILLED);  // a mark at the rim
  ExpectCircle(Find(picture), window, 1.0);
}

TEST(FindCircle, NothingWhereThereIsNoRoundWindow) {
  EXPECT_EQ(Find(Scene({400, 320}, {200, 160, 600})).r, 0);  // full to the corners
  EXPECT_EQ(Find(cv::Mat(320, 400, CV_8UC3, cv::Scalar::all(0))).r, 0);
  EXPECT_EQ(Find(cv::Mat(320, 400, CV_8UC3, cv::Scalar::all(255))).r, 0);
  EXPECT_EQ(Find(cv::Mat(1, 1, CV_8UC3, cv::Scalar::all(9))).r, 0);
  EXPECT_EQ(CircleFinder().Find().circle.r, 0);
  cv::Mat noise(320, 400, CV_8UC3);
  cv::RNG random(3);
  random.fill(noise, cv::RNG::UNIFORM, 0, 255);
  EXPECT_EQ(Find(noise).r, 0);
  cv::Mat box(320, 400, CV_8UC3, cv::Scalar::all(4));  // a square window
  Scene({400, 320}, {200, 160, 600})(cv::Rect(90, 50, 220, 220))
      .copyTo(box(cv::Rect(90, 50, 220, 220)));
  EXPECT_EQ(Find(box).r, 0);
  // A strong vignette is not a rim.
  EXPECT_EQ(Find(Scene({400, 320}, {200, 160, 260}, 30.0, 0.3)).r, 0);
}

TEST(FindCircle, AWindowThatWandersIsWhatAllFramesShow) {
  CircleFinder finder;
  const std::vector<cv::Point2d> middles = {{200, 160}, {208, 160}, {204, 154}, {203, 161}};
  for (const cv::Point2d& m : middles) finder.Add(Scene({400, 320}, {m.x, m.y, 140}));
  finder.Add(cv::Mat(320, 400, CV_8UC3, cv::Scalar::all(3)));  // a black frame has no effect
  const ClipCircle found = finder.Find();
  EXPECT_NEAR(found.wanders, 8.5, 1.5);
  for (const cv::Point2d& m : middles)
    EXPECT_LE(std::hypot(found.circle.cx - m.x, found.circle.cy - m.y) + found.circle.r, 140.7);
  EXPECT_GT(found.circle.r, 134);
}

TEST(FindCircle, FramesTooDarkAtTheRimAreTakenTogether) {
  // Each frame lights one side only, so none shows the whole rim.
  const LensCircle window{200, 160, 150};
  CircleFinder finder;
  for (int side = 0; side < 8; ++side) {
    cv::Mat picture = Scene({400, 320}, window);
    for (int y = 0; y < picture.rows; ++y)
      for (int x = 0; x < picture.cols; ++x) {
        const double angle = std::atan2(y - 160.0, x - 200.0) - side * 0.785398;
        if (std::cos(angle) < 0.6) picture.at<cv::Vec3b>(y, x) = {5, 5, 5};
      }
    finder.Add(picture);
  }
  ExpectCircle(finder.Find().circle, window);
}

TEST(FindCircle, RealWindowCutByTheSensor) {
  ARTHRO_REQUIRE_SHARED(clip, "data/laparoscopy_rvim/endo.mp4");
  Footage footage = Footage::Open(clip);
  cv::Mat rgb;
  CircleFinder finder;
  std::vector<LensCircle> circles;
  while (footage.Next(rgb)) {
    if (footage.index() % 40 == 0) {
      finder.Add(rgb);
      const LensCircle circle = Find(rgb);
      // The optics fix the radius, so it is equal in every frame; measured by hand: 566 px.
      EXPECT_NEAR(circle.r, 566.2, 1.0) << footage.index();
      // Black starts just beyond it, all along the visible rim.
      cv::Mat beyond(rgb.size(), CV_8UC1, cv::Scalar(255));
      cv::circle(beyond, cv::Point2d(circle.cx, circle.cy), static_cast<int>(circle.r + 5),
                 cv::Scalar(0), cv::FILLED);
      EXPECT_LT(cv::mean(rgb, beyond)[0], 4.0) << footage.index();
      circles.push_back(circle);
    }
  }
  const ClipCircle found = finder.Find();
  EXPECT_NEAR(found.wanders, 18, 4);
  for (const LensCircle& c : circles)
    EXPECT_LE(std::hypot(found.circle.cx - c.cx, found.circle.cy - c.cy) + found.circle.r, c.r + 1);
}

}  // namespace
}  // namespace arthro::authoring
