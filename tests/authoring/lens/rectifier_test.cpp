#include "authoring/lens/rectifier.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "simulation/core/error.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

Lens Equisolid() {
  Lens lens;
  lens.width = 400;
  lens.height = 320;
  lens.focal_px = 233.3;
  lens.cx = 201.25;
  lens.cy = 158.75;
  lens.field_of_view = RadiansFromDegrees(75);
  lens.circle = {201.25, 158.75, 2 * 233.3 * std::sin(RadiansFromDegrees(37.5) / 2)};
  return lens;
}

// A raw picture with the position of each pixel in its colours: x/2 in red, y/2 in green.
cv::Mat Ramp(const Lens& lens) {
  cv::Mat raw(lens.height, lens.width, CV_8UC3);
  for (int y = 0; y < raw.rows; ++y)
    for (int x = 0; x < raw.cols; ++x)
      raw.at<cv::Vec3b>(y, x) =
          cv::Vec3b(static_cast<uchar>(x / 2), static_cast<uchar>(y / 2), 200);
  return raw;
}

TEST(Rectifier, ViewJustHoldsTheCircle) {
  const Lens lens = Equisolid();
  RectifyOptions options;
  options.rim_margin = 0;
  const RectifiedView view = ViewOf(lens, options);
  const double reach = 233.3 * std::tan(RadiansFromDegrees(37.5));
  EXPECT_EQ(view.focal_px, 233.3);
  EXPECT_GE(view.cx, reach);
  EXPECT_LE(view.cx, reach + 2);
  EXPECT_GE(view.width - 1 - view.cx, reach);
  EXPECT_LE(view.width - 1 - view.cx, reach + 3);
  EXPECT_LE(std::abs(view.width - view.height), 1);
}

TEST(Rectifier, FlattenedCircleGivesAFlatView) {
  Lens lens = Equisolid();
  lens.height = 240;
  lens.cy = lens.circle.cy = 118.75;
  const RectifiedView view = ViewOf(lens, {});
  EXPECT_LT(view.height, view.width - 40);
  const Rectifier rectifier(lens, {});
  const int middle = static_cast<int>(view.cx);
  // Above the axis the picture ends at its first row.
  const double theta = 2 * std::asin(118.75 / (2 * 233.3));
  const int top = static_cast<int>(std::ceil(view.cy - 233.3 * std::tan(theta)));
  EXPECT_EQ(rectifier.mask().at<uchar>(top, middle), 255);
  EXPECT_EQ(rectifier.mask().at<uchar>(top - 1, middle), 0);
}

TEST(Rectifier, EachPixelComesFromWhereTheLensSays) {
  Lens sphere = Equisolid();
  sphere.model = LensModel::kDoubleSphere;
  sphere.k = {-0.2, 0.55, 0, 0};
  sphere.focal_px = 233.3 * 0.8;
  Lens polynomial = Equisolid();
  polynomial.model = LensModel::kKannalaBrandt;
  polynomial.k = {-0.04, 0.001, 0, 0};
  Lens tall = Equisolid();
  tall.aspect = 1.1;
  for (const Lens& lens : {Equisolid(), sphere, polynomial, tall})
    for (const double scale : {1.0, 0.5, 0.3}) {
      const Rectifier rectifier(lens, {}, scale);
      cv::Mat raw(lens.height, lens.width, CV_8UC3), rectified;
      raw = Ramp(lens);
      rectifier.Rectify(raw, rectified);
      ASSERT_EQ(rectified.size(), rectifier.size());
      const RectifiedView& view = rectifier.view();
      int compared = 0;
      for (int y = 0; y < rectified.rows; y += 3)
        for (int x = 0; x < rectified.cols; x += 3) {
          if (!rectifier.mask().at<uchar>(y, x)) {
            EXPECT_EQ(rectified.at<cv::Vec3b>(y, x), cv::Vec3b(0, 0, 0));
            continue;
          }
          const glm::dvec3 ray(((x + 0.5) / scale - 0.5 - view.cx) / view.focal_px,
                               ((y + 0.5) / scale - 0.5 - view.cy) / view.focal_px, 1);
          const auto pixel = PixelFromRay(lens, ray);
          ASSERT_TRUE(pixel);
          // The ramp is two px per grey level and rounded down: -0.25 level on average. Maps of
          // 1/32 px and the 8-bit result add up to 0.6 more.
          EXPECT_NEAR(rectified.at<cv::Vec3b>(y, x)[0], pixel->x / 2 - 0.25, 0.9);
          EXPECT_NEAR(rectified.at<cv::Vec3b>(y, x)[1], pixel->y / 2 - 0.25, 0.9);
          ++compared;
        }
      EXPECT_GT(compared, 500);
    }
}

// A pattern of single px, which skipping would keep and averaging turns grey.
TEST(Rectifier, SmallerScalesAverage) {
  const Lens lens = Equisolid();
  cv::Mat raw(lens.height, lens.width, CV_8UC1), half;
  for (int y = 0; y < raw.rows; ++y)
    for (int x = 0; x < raw.cols; ++x) raw.at<uchar>(y, x) = (x + y) % 2 ? 255 : 0;
  const Rectifier rectifier(lens, {}, 0.5);
  rectifier.Rectify(raw, half);
  const cv::Rect middle(rectifier.size().width / 2 - 20, rectifier.size().height / 2 - 20, 40, 40);
  cv::Scalar mean, deviation;
  cv::meanStdDev(half(middle), mean, deviation);
  EXPECT_NEAR(mean[0], 127.5, 3);
  EXPECT_LT(deviation[0], 20);  // bilinear skipping: above 60
}

TEST(Rectifier, RimMarginAndAngleLimitTheMask) {
  const Lens lens = Equisolid();
  RectifyOptions wide, narrow;
  wide.rim_margin = 0;
  narrow.rim_margin = 0;
  narrow.largest_half_angle = RadiansFromDegrees(20);
  const Rectifier whole(lens, wide), part(lens, narrow);
  const double f = 233.3, pi = 3.14159265358979;
  // Area of the discs; a rim of half a pixel is 1 %.
  const auto Disc = [&](double degrees) {
    return pi * std::pow(f * std::tan(RadiansFromDegrees(degrees)), 2);
  };
  EXPECT_NEAR(cv::countNonZero(whole.mask()), Disc(37.5), 0.01 * Disc(37.5));
  EXPECT_NEAR(cv::countNonZero(part.mask()), Disc(20), 0.02 * Disc(20));
}

TEST(Rectifier, RefusesWhatItCannotDo) {
  const Lens lens = Equisolid();
  const Rectifier rectifier(lens, {});
  cv::Mat out;
  EXPECT_THROW(rectifier.Rectify(cv::Mat(320, 401, CV_8UC3), out), Error);
  EXPECT_THROW(rectifier.Rectify(cv::Mat(), out), Error);
  EXPECT_THROW(rectifier.Rectify(cv::Mat(320, 400, CV_16UC3), out), Error);
  EXPECT_THROW(rectifier.Rectify(cv::Mat(320, 400, CV_8UC4), out), Error);
  EXPECT_THROW(Rectifier(lens, {}, 0.0), Error);
  EXPECT_THROW(Rectifier(lens, {}, std::numeric_limits<double>::quiet_NaN()), Error);
  Lens aside = lens;
  aside.cx = 900;
  EXPECT_THROW(ViewOf(aside, {}), Error);
  Lens huge = lens;
  huge.focal_px = 1e6;
  huge.circle = {};
  EXPECT_NO_THROW(ViewOf(huge, {}));  // nearly no field of view: as large as the picture
  Lens tiny = lens;
  tiny.circle.r = 2;
  EXPECT_THROW(ViewOf(tiny, {}), Error);
  EXPECT_THROW(ViewOf(Lens{}, {}), Error);
}

}  // namespace
}  // namespace arthro::authoring
