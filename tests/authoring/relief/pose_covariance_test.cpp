// Standard deviations of poses against the scatter of poses from tracks with new noise each time.
#include "authoring/relief/motion/bundle/pose_covariance.h"

#include <cmath>
#include <random>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "authoring/relief/motion/growth.h"
#include "authoring/relief/motion/motion.h"
#include "tests/support/relief/cavity_clip.h"

namespace arthro::authoring {
namespace {

using test::CavityOptions;

constexpr double kNoise = 0.3;  // px

// The true poses and points of tracks without noise.
Reconstruction Truth(const CavityOptions& options, const std::vector<Track>& tracks,
                     const LensProfile& lens) {
  Reconstruction scene;
  for (const CameraPose& pose : test::CavityPoses(options)) scene.poses.emplace_back(pose);
  RefreshPoints(tracks, lens, scene);
  return scene;
}

double RmsCentre(const PoseSigmas& sigmas) {
  double squares = 0;
  for (const auto& frame : sigmas.frames) squares += frame->centre * frame->centre;
  return std::sqrt(squares / static_cast<double>(sigmas.frames.size()));
}

double MeanRange(const std::vector<Track>& tracks, const Reconstruction& scene) {
  double sum = 0;
  int count = 0;
  for (const TrackPoint& point : scene.points)
    for (const Observation& seen : tracks[static_cast<std::size_t>(point.track)].seen) {
      sum += (point.position - scene.poses[static_cast<std::size_t>(seen.frame)]->centre).norm();
      ++count;
    }
  return sum / count;
}

struct Errors {
  double centre = 0, rotation = 0;  // m, rad; rms over the frames
};

// Errors of small size after the turn, shift and growth that leave the least of them, where a turn
// counts as the way of a point at `range`.
Errors ErrorsOf(const Reconstruction& found, const std::vector<CameraPose>& truth, double range) {
  const auto frames = static_cast<Eigen::Index>(truth.size());
  Eigen::MatrixXd moves = Eigen::MatrixXd::Zero(6 * frames, 7);
  Eigen::VectorXd errors(6 * frames);
  for (Eigen::Index f = 0; f < frames; ++f) {
    const CameraPose &to = truth[static_cast<std::size_t>(f)],
                     &from = *found.poses[static_cast<std::size_t>(f)];
    const Eigen::AngleAxisd turn(from.world_from_camera * to.world_from_camera.transpose());
    errors.segment<3>(6 * f) = range * turn.angle() * turn.axis();
    errors.segment<3>(6 * f + 3) = from.centre - to.centre;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
      moves.block<3, 1>(6 * f, axis) = range * unit;
      moves.block<3, 1>(6 * f + 3, axis) = unit.cross(to.centre);
      moves.block<3, 1>(6 * f + 3, 3 + axis) = unit;
    }
    moves.block<3, 1>(6 * f + 3, 6) = to.centre;
  }
  errors -= moves * moves.colPivHouseholderQr().solve(errors);
  Errors rms;
  for (Eigen::Index f = 0; f < frames; ++f) {
    rms.rotation += errors.segment<3>(6 * f).squaredNorm() / (range * range) / frames;
    rms.centre += errors.segment<3>(6 * f + 3).squaredNorm() / frames;
  }
  return {std::sqrt(rms.centre), std::sqrt(rms.rotation)};
}

struct Scatter {  // rms over the trials
  Errors measured, predicted;
  double pixel = 0;
};

// Adjusts from the truth after noise was added to the observations.
Scatter ScatterOf(const CavityOptions& options, int trials, int most_frames = 120) {
  const LensProfile lens(test::CavityLens());
  const std::vector<Track> exact = test::CavityTracks(options);
  const Reconstruction truth = Truth(options, exact, lens);
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, kNoise);
  double measured_centre = 0, measured_rotation = 0, centre = 0, rotation = 0, pixel = 0;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<Track> tracks = exact;
    for (Track& track : tracks)
      for (Observation& seen : track.seen)
        seen.pixel += Eigen::Vector2d(noise(random), noise(random));
    Reconstruction scene = truth;
    AdjustBundle(tracks, lens, {}, scene, nullptr);
    const PoseSigmas sigmas = SigmasOf(tracks, lens, scene, most_frames);
    const Errors errors = ErrorsOf(scene, test::CavityPoses(options), MeanRange(exact, truth));
    measured_centre += errors.centre * errors.centre / trials;
    measured_rotation += errors.rotation * errors.rotation / trials;
    centre += std::pow(RmsCentre(sigmas), 2) / trials;
    rotation += std::pow(RmsRotation(sigmas), 2) / trials;
    pixel += sigmas.pixel * sigmas.pixel / trials;
  }
  return {{std::sqrt(measured_centre), std::sqrt(measured_rotation)},
          {std::sqrt(centre), std::sqrt(rotation)},
          std::sqrt(pixel)};
}

CavityOptions Clip() {
  CavityOptions options;
  options.noise_px = 0;
  options.outliers = 0;
  options.points = 250;
  return options;
}

// Twelve trials of some forty free directions each scatter by about 5 %.
TEST(PoseCovariance, AgreesWithTheScatterOfRepeatedAdjustments) {
  const Scatter scatter = ScatterOf(Clip(), 12);
  EXPECT_NEAR(scatter.predicted.centre / scatter.measured.centre, 1, 0.2);
  EXPECT_NEAR(scatter.predicted.rotation / scatter.measured.rotation, 1, 0.2);
  EXPECT_NEAR(scatter.pixel / kNoise, 1, 0.1);
}

TEST(PoseCovariance, FramesThatDoNotEnterGetAnUpperBound) {
  const Scatter all = ScatterOf(Clip(), 1), some = ScatterOf(Clip(), 1, 7);
  EXPECT_GT(some.predicted.centre, all.predicted.centre);
  EXPECT_LT(some.predicted.centre, 4 * all.predicted.centre);
}

TEST(PoseCovariance, FewPointsHoldTheFramesLessFirmly) {
  CavityOptions few = Clip();
  few.points = 60;
  EXPECT_GT(ScatterOf(few, 1).predicted.centre, 1.4 * ScatterOf(Clip(), 1).predicted.centre)
      << "a quarter of the points, twice the error";
}

TEST(PoseCovariance, IsEmptyWithoutObservations) {
  Reconstruction scene;
  scene.poses = {CameraPose{}, CameraPose{}};
  const PoseSigmas sigmas = SigmasOf({}, LensProfile(test::CavityLens()), scene);
  ASSERT_EQ(sigmas.frames.size(), 2u);
  EXPECT_FALSE(sigmas.frames[0]);
  EXPECT_EQ(RmsRotation(sigmas), 0);
}

}  // namespace
}  // namespace arthro::authoring
