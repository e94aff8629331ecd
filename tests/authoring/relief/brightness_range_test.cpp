// Range from brightness in a Lambertian cavity that is lit from the tip.
#include "authoring/relief/surface/brightness_range.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "simulation/core/units.h"
#include "simulation/scene/relief_origin.h"
#include "tests/support/relief/cavity_clip.h"

namespace arthro::authoring {
namespace {

using Eigen::Vector3d;

Vector3d CavityNormal(const Vector3d& point) {
  constexpr double kStep = 1e-5;
  const auto depth = [](const Vector3d& p) {
    return p.norm() - test::CavityRadius(p.normalized());
  };
  Vector3d gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d step = kStep * Vector3d::Unit(axis);
    gradient[axis] = depth(point + step) - depth(point - step);
  }
  return -gradient.normalized();
}

// Frames of a scope that goes in and out, so that the ranges of the frames differ.
struct LitCavity {
  std::vector<SurfaceView> views;
  std::vector<cv::Mat> pictures;
  LensProfile lens{test::CavityLens()};
  SurfaceCells cells;
  cv::Mat truth;  // radius

  LitCavity() {
    const Lens model = test::CavityLens();
    test::CavityOptions options;
    options.frames = 9;
    auto poses = test::CavityPoses(options);
    cv::RNG random(3);
    for (std::size_t f = 0; f < poses.size(); ++f) {
      poses[f].centre *= 0.5 + 0.13 * static_cast<double>(f);
      const double gain = 0.8 + 0.06 * static_cast<double>(f % 4);
      SurfaceView view;
      view.frame = static_cast<int>(f);
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c)
          view.camera_from_portal(r, c) = static_cast<float>(poses[f].world_from_camera(c, r));
        view.centre[r] = static_cast<float>(poses[f].centre[r]);
      }
      cv::Mat picture(model.height, model.width, CV_8UC3, cv::Scalar::all(0));
      view.mask = cv::Mat::zeros(picture.size(), CV_8U);
      for (int y = 0; y < picture.rows; ++y)
        for (int x = 0; x < picture.cols; ++x) {
          if (std::hypot(x - model.cx, y - model.cy) > model.circle.r) continue;
          const auto ray = RayFromPixel(model, {x, y});
          if (!ray) continue;
          const Vector3d d = poses[f].world_from_camera * Vector3d(ray->x, ray->y, ray->z);
          const double range = test::CavityRange(poses[f].centre, d);
          const double cosine = -CavityNormal(poses[f].centre + range * d).dot(d);
          const double grey =
              255 * 0.5 * gain * cosine * std::pow(0.022 / range, 2) + random.gaussian(1.0);
          picture.at<cv::Vec3b>(y, x) = cv::Vec3b::all(cv::saturate_cast<std::uint8_t>(grey));
          view.mask.at<std::uint8_t>(y, x) = 255;
        }
      views.push_back(view);
      pictures.push_back(picture);
    }
    const Projection projection{ProjectionType::kEquirectangular, {35, 35}, 1000, 1};
    cells = CellDirections(projection, {71, 71});
    truth = cv::Mat(cells.size, CV_32F);
    for (int y = 0; y < 71; ++y)
      for (int x = 0; x < 71; ++x) {
        const cv::Vec3f& d = cells.Row(y)[x];
        truth.at<float>(y, x) = static_cast<float>(test::CavityRadius({d[0], d[1], d[2]}));
      }
  }
};

TEST(BrightnessRange, BringsABumpNearerThatMotionDidNotMeasure) {
  const LitCavity cavity;
  // All is measured but the surroundings of the first bump, which is 10 mm high.
  OpenSurface open{
      cavity.truth.clone(), cv::Mat(cavity.cells.size, CV_32F, cv::Scalar(1e-4)), {}, {}};
  const cv::Rect bump(41, 24, 22, 22);
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  open.matched(bump).setTo(kUnknown);
  open.sigma(bump).setTo(kUnknown);
  const ClosedSurface flat = CloseSurface(open);
  const auto visible = VisibleCells(cavity.views, cavity.lens, cavity.cells, flat.radius, 2);
  const BrightnessRange lit = RangeFromBrightness(cavity.views, cavity.pictures, cavity.lens,
                                                  cavity.cells, flat, visible, 2, {});
  open.estimate = lit.radius;
  open.estimate_sigma = lit.sigma;
  const ClosedSurface closed = CloseSurface(open);
  int found = 0, within = 0;
  double before = 0, after = 0;
  for (int y = bump.y; y < bump.br().y; ++y)
    for (int x = bump.x; x < bump.br().x; ++x) {
      if (!(lit.radius.at<float>(y, x) > 0)) continue;
      const double truth = cavity.truth.at<float>(y, x);
      ++found;
      before += std::pow(flat.radius.at<float>(y, x) - truth, 2);
      const double error = closed.radius.at<float>(y, x) - truth;
      after += error * error;
      within += std::abs(error) < 2 * closed.sigma.at<float>(y, x);
    }
  constexpr int kEnough = 50;  // for the statistics
  ASSERT_GT(found, kEnough) << "cells where brightness says more than the membrane";
  // A weak measurement, since the slopes are the membrane's; but better than none.
  EXPECT_LT(std::sqrt(after / found), std::sqrt(before / found)) << "m";
  constexpr double kWithinTwoSigma = 0.8;  // 0.95 of normal errors; these are joined by the normals
  EXPECT_GT(within, kWithinTwoSigma * found);
}

TEST(BrightnessRange, IsTheSameForAnyNumberOfThreads) {
  const LitCavity cavity;
  OpenSurface open{
      cavity.truth.clone(), cv::Mat(cavity.cells.size, CV_32F, cv::Scalar(1e-4)), {}, {}};
  open.sigma(cv::Rect(30, 30, 20, 20)).setTo(std::numeric_limits<float>::quiet_NaN());
  const ClosedSurface closed = CloseSurface(open);
  const auto visible = VisibleCells(cavity.views, cavity.lens, cavity.cells, closed.radius, 1);
  const auto made = [&](int threads) {
    return RangeFromBrightness(cavity.views, cavity.pictures, cavity.lens, cavity.cells, closed,
                               visible, threads, {});
  };
  const cv::Mat one = made(1).radius, four = made(4).radius;
  EXPECT_TRUE(
      std::equal(one.begin<float>(), one.end<float>(), four.begin<float>(),
                 [](float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }));
}

}  // namespace
}  // namespace arthro::authoring
