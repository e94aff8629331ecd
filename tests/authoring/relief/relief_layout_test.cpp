// Light over a closed surface, on surfaces with a closed form. Cells are half a degree wide.
#include "authoring/relief/surface/relief_layout.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "simulation/core/units.h"
#include "simulation/scene/relief_origin.h"

namespace arthro::authoring {
namespace {

constexpr double kSphere = 0.040;  // m
constexpr int kWidth = 120, kHeight = 60;
const double kCellAngle = RadiansFromDegrees(0.5);

SurfaceCells Cells() {
  return CellDirections({ProjectionType::kEquirectangular, {kWidth / 2, kHeight / 2}, 1000, 2},
                        {kWidth, kHeight});
}

ClosedSurface Sphere(double sigma) {
  return {cv::Mat(kHeight, kWidth, CV_32F, cv::Scalar(kSphere)),
          cv::Mat(kHeight, kWidth, CV_32F, cv::Scalar(sigma)),
          cv::Mat(kHeight, kWidth, CV_8U, cv::Scalar(static_cast<int>(ReliefOrigin::kMeasured)))};
}

// Angle between the normal and the way to the portal, rad.
double SlopeAt(const SurfaceCells& cells, const LitSurface& lit, int x, int y) {
  return std::acos(
      std::min(1.0, -static_cast<double>(lit.normals.at<cv::Vec3f>(y, x).dot(cells.Row(y)[x]))));
}

// An error of the measurement at the rim must not be taken for a slope that turns away from the
// light: dividing by its cosine would draw the rim too bright.
TEST(LitSurface, TakesNoSlopeFromAnUncertainRim) {
  const SurfaceCells cells = Cells();
  ClosedSurface closed = Sphere(1e-4);
  constexpr int kRim = 12;  // cells, of 45 degrees and an error of up to six deviations
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kRim; ++x) {
      closed.radius.at<float>(y, x) = static_cast<float>(kSphere * (1 + kCellAngle * (kRim - x)));
      closed.sigma.at<float>(y, x) = 7e-4f;
    }
  const LitSurface lit = LitSurfaceOf(cells, closed);
  constexpr double kTenth = 0.45;  // rad; cosine of 0.9: a tenth of the light
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) ASSERT_LT(SlopeAt(cells, lit, x, y), kTenth) << x << ' ' << y;
}

TEST(LitSurface, KeepsTheSlopesOfAWellMeasuredSurface) {
  const SurfaceCells cells = Cells();
  ClosedSurface closed = Sphere(5e-5);
  constexpr double kHeightOfWaves = 1e-3, kWave = 40;  // m, cells
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      closed.radius.at<float>(y, x) += static_cast<float>(
          kHeightOfWaves * std::sin(2 * std::numbers::pi * (x - kWidth / 2) / kWave));
  const LitSurface lit = LitSurfaceOf(cells, closed);
  const double slope =
      std::atan(kHeightOfWaves * 2 * std::numbers::pi / (kWave * kCellAngle * kSphere));
  // A Gaussian of 3 cells leaves exp(-2 π² 3² / 40²) = 0.895 of such waves; differences over two
  // cells to either side leave 0.984 of that.
  const double seen = SlopeAt(cells, lit, kWidth / 2, kHeight / 2);
  EXPECT_NEAR(seen, std::atan(0.895 * 0.984 * std::tan(slope)), 0.01);
}

}  // namespace
}  // namespace arthro::authoring
