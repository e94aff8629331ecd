// The scores of found surfaces, on surfaces whose error is known.
#include "tests/support/relief/surface_score.h"

#include <cmath>
#include <fstream>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "simulation/core/error.h"
#include "simulation/scene/json/lens_io.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {
namespace {

CavityOptions FewFrames() {
  CavityOptions options;
  options.frames = 5;
  return options;
}

TEST(SurfaceScore, OfTheTruthIsPerfectAndOfAShiftedSurfaceItsShift) {
  const CavityTruth truth = TruthOf(FewFrames());
  const TrueSurface surface = SurfaceOf(truth);
  const SurfaceScore exact = ScoreSurface({surface.radius, {}}, surface);
  EXPECT_EQ(exact.coverage, 1.0);
  EXPECT_EQ(exact.rmse, 0.0);
  EXPECT_NEAR(exact.spearman, 1.0, 1e-12);
  DepthMap shifted = surface.radius;
  for (float& r : shifted.relief) r += 2e-3f;
  const SurfaceScore off = ScoreSurface({shifted, {}}, surface);
  EXPECT_NEAR(off.rmse, 2e-3, 1e-8);
  EXPECT_NEAR(off.median, 2e-3, 1e-8);
  EXPECT_EQ(off.within_1mm, 0.0);
}

// A relief in another frame and scale, with the cameras in the same: the similarity is undone.
TEST(SurfaceScore, UndoesTheSimilarityOfAMeasuredRelief) {
  const CavityTruth truth = TruthOf(FewFrames());
  const TrueSurface surface = SurfaceOf(truth);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.05, Eigen::Vector3d(1, 2, 0.5).normalized()).toRotationMatrix();
  constexpr double kScale = 1.3;  // true = kScale · found
  const Eigen::Vector3d shift(4e-4, -3e-4, 2e-4);
  authoring::ReliefResult result;
  result.report.radius = 0.06;
  result.report.projection = surface.projection;
  result.relief = DepthMap(surface.radius.width, surface.radius.height);
  for (int y = 0; y < result.relief.height; ++y)
    for (int x = 0; x < result.relief.width; ++x) {
      // Along this ray of the found frame, the true surface by bisection.
      const Eigen::Vector3d ray = turn * surface.Direction(x, y);
      double low = 0, high = 0.06;
      for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        const Eigen::Vector3d at = kScale * middle * ray + shift;
        (at.norm() < truth.radius(at.normalized()) ? low : high) = middle;
      }
      result.relief.at(x, y) = static_cast<float>(0.06 - low);
    }
  for (std::size_t i = 0; i < truth.poses.size(); ++i) {
    authoring::PosedFrame frame;
    frame.index = static_cast<int>(i);
    frame.is_posed = true;
    const Eigen::Matrix3d axes = turn.transpose() * truth.poses[i].world_from_camera;
    const Eigen::Vector3d centre = turn.transpose() * (truth.poses[i].centre - shift) / kScale;
    for (int k = 0; k < 9; ++k) frame.rotation[static_cast<std::size_t>(k)] = axes(k / 3, k % 3);
    frame.centre = {centre.x(), centre.y(), centre.z()};
    result.report.frames.push_back(frame);
  }
  const PoseScore poses = ScorePoses(result.report, truth);
  EXPECT_EQ(poses.posed, 5);
  EXPECT_LT(poses.path, 1e-9);
  EXPECT_LT(poses.rotation, 1e-6) << "arc cosine near one";
  EXPECT_NEAR(poses.portal, shift.norm(), 1e-9);
  const auto found = SurfaceOf(result, truth, surface);
  ASSERT_TRUE(found);
  const SurfaceScore score = ScoreSurface(*found, surface);
  EXPECT_GT(score.coverage, 0.99);
  // Bilinear interpolation over half a degree, 0.4 mm, of bumps that bend by 0.05 per mm at most:
  // 0.4²/8 · 0.05 mm.
  EXPECT_LT(score.rmse, 2e-6);
}

TEST(SurfaceScore, GivesBrightnessTheAffineLawThatFitsBest) {
  const TrueSurface surface = SurfaceOf(TruthOf(FewFrames()));
  // A panorama that shows each direction at its own pixel of the grid.
  PanoramaPlaces places;
  DepthMap depth = surface.radius;
  for (int y = 0; y < depth.height; ++y)
    for (int x = 0; x < depth.width; ++x) {
      places.pixel.push_back({x, y});
      places.spread.push_back(0);
      depth.at(x, y) = 0.5f - 7 * depth.at(x, y);
    }
  const SurfaceScore score = ScoreSurface(SurfaceOf(depth, places, surface), surface);
  EXPECT_GT(score.coverage, 0.95);
  EXPECT_LT(score.rmse, 1e-6) << "float of 0.5";
  EXPECT_NEAR(score.spearman, 1.0, 1e-9);
}

TEST(CavityTruth, ReadsAClipFromItsFolder) {
  const TempFolder folder;
  const CavityTruth truth = TruthOf(FewFrames());
  constexpr int kSide = 1201;
  std::ofstream array(folder / "radius.npy", std::ios::binary);
  std::string head =
      fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}), }}", kSide, kSide);
  head.resize(118, ' ');
  array.write("\x93NUMPY\x01\x00", 8);
  array.put(static_cast<char>(head.size())).put('\0');
  array << head;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const double u = (x - 600) / 6.0 * kRadianPerDegree, v = (y - 600) / 6.0 * kRadianPerDegree;
      const double angle = std::hypot(u, v), s = angle > 0 ? std::sin(angle) / angle : 1;
      const auto r = static_cast<float>(truth.radius({s * u, s * v, std::cos(angle)}));
      array.write(reinterpret_cast<const char*>(&r), sizeof r);
    }
  array.close();
  nlohmann::json json = {{"params", {{"alpha_deg", 30.0}}}, {"frames", nlohmann::json::array()}};
  for (const auto& pose : truth.poses) {
    nlohmann::json axes = nlohmann::json::array();
    for (int row = 0; row < 3; ++row)
      axes.push_back({pose.world_from_camera(row, 0), pose.world_from_camera(row, 1),
                      pose.world_from_camera(row, 2)});
    json["frames"].push_back(
        {{"R", axes}, {"C", {pose.centre.x(), pose.centre.y(), pose.centre.z()}}});
  }
  std::ofstream(folder / "gt.json") << json;
  WriteLens(folder / "lens.json", truth.lens);
  const CavityTruth read = ReadCavityTruth(folder.path());
  ASSERT_EQ(read.poses.size(), truth.poses.size());
  EXPECT_LT((read.poses[2].world_from_camera - truth.poses[2].world_from_camera).norm(), 1e-12);
  EXPECT_LT((read.poses[2].centre - truth.poses[2].centre).norm(), 1e-12);
  for (const Eigen::Vector3d& d :
       {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0.3, -0.4, 1), Eigen::Vector3d(-0.9, 0.2, 0.7)})
    EXPECT_NEAR(read.radius(d.normalized()), truth.radius(d.normalized()), 1e-7);
  std::ofstream(folder / "radius.npy") << "a letter";
  EXPECT_THROW(ReadCavityTruth(folder.path()), Error);
}

}  // namespace
}  // namespace arthro::test
