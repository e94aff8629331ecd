// Smoothness of bells whose spectral arc length and jerk have closed forms, and its median over the
// stretches of an attempt.
#include "simulation/training/metrics/smoothness.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/simulation/training/metrics/measured_value.h"

namespace arthro::simulation {
namespace {

// Length of the curve M(x) = exp(-a x²) over 0 ≤ x ≤ 1, by Simpson's rule.
double LengthOfGaussian(double a) {
  constexpr int kPieces = 2000;
  double sum = 0;
  for (int i = 0; i <= kPieces; ++i) {
    const double x = static_cast<double>(i) / kPieces;
    const double slope = -2 * a * x * std::exp(-a * x * x);
    const int weight = i == 0 || i == kPieces ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * std::hypot(1.0, slope);
  }
  return sum / (3 * kPieces);
}

// Speed exp(-t² / 2 s²) about the middle of 4 s. Its amplitudes are exp(-2 (π s f)²).
std::vector<double> GaussianSpeed(double deviation) {
  std::vector<double> speed(401);
  for (std::size_t k = 0; k < speed.size(); ++k) {
    const double t = kFrameTime * static_cast<double>(k) - 2;
    speed[k] = std::exp(-0.5 * t * t / (deviation * deviation));
  }
  return speed;
}

// Amplitudes of a Gaussian fall to 5 % at f' with 2 (π s f')² = ln 20. Over x = f / f' they are
// exp(-x² ln 20), whatever the width s is.
const double kGaussianArc = -LengthOfGaussian(std::log(20.0));

TEST(Smoothness, SpectralArcLengthOfAGaussianDoesNotDependOnItsWidth) {
  EXPECT_NEAR(kGaussianArc, -1.41646, 1e-5);
  // The last bin lies up to one bin of 0.0122 Hz below f', that is 0.3 % of f' at 0.1 s.
  EXPECT_NEAR(*SpectralArcLength(GaussianSpeed(0.1)), kGaussianArc, 5e-4);
  for (const double deviation : {0.2, 0.3, 0.4})
    EXPECT_NEAR(*SpectralArcLength(GaussianSpeed(deviation)), kGaussianArc, 4e-3) << deviation;
}

// A Gaussian of 20 ms has f' = 19 Hz, so the curve ends at 10 Hz with M = exp(-2 (0.2 π)²).
TEST(Smoothness, SpectralArcLengthEndsAtTenHertz) {
  const double a = 2 * std::pow(std::numbers::pi * 0.02 * 10, 2);
  EXPECT_LT(a, std::log(20.0));
  EXPECT_NEAR(*SpectralArcLength(GaussianSpeed(0.02)), -LengthOfGaussian(a), 5e-4);
}

// Speed of n bells v (1 - cos ω t) / 2 with ω = 2 π / T₁, in n T₁.
std::vector<double> SpeedOfBells(int bells, double duration) {
  const int last = static_cast<int>(std::lround(bells * duration / kFrameTime));
  std::vector<double> speed;
  for (int k = 0; k <= last; ++k)
    speed.push_back(0.01 * (1 - std::cos(2 * std::numbers::pi * k * kFrameTime / duration)));
  return speed;
}

// v'' = v ω² / 2 · cos ω t, so T³ / v² ∫ v''² dt = (n T₁)³ (ω⁴ / 4) (n T₁ / 2) = 2 π⁴ n⁴.
double JerkOfBells(int bells) {
  return -std::log(2 * std::pow(std::numbers::pi, 4) * std::pow(bells, 4));
}

TEST(Smoothness, LogDimensionlessJerkOfBells) {
  for (const int bells : {1, 2, 3})
    for (const double duration : {1.0, 2.0}) {
      const auto speed = SpeedOfBells(bells, duration);
      // Second differences are those of a cosine: (4 sin²(ω h / 2) / h²)² in place of ω⁴. The sum
      // leaves out the two ends, where the cosine is 1.
      const double m = static_cast<double>(speed.size() - 1), h = kFrameTime;
      const double square = 4 * std::pow(std::sin(std::numbers::pi * h / duration), 2) / (h * h);
      const double sum = 0.25 * square * square * h * (0.5 * m - 1);
      EXPECT_NEAR(*LogDimensionlessJerk(speed), -std::log(std::pow(m * h, 3) * sum), 1e-9);
      // Both together change the integral by 2 % for one bell of 1 s.
      EXPECT_NEAR(*LogDimensionlessJerk(speed), JerkOfBells(bells), 0.022) << bells;
    }
}

TEST(Smoothness, NothingIsGivenForNoMovementOrTooFewFrames) {
  const std::vector<double> still(100, 0.0), one(1, 0.01), two(2, 0.01), even(100, 0.01);
  EXPECT_FALSE(SpectralArcLength({}).has_value());
  EXPECT_FALSE(SpectralArcLength(still).has_value());
  EXPECT_FALSE(LogDimensionlessJerk({}).has_value());
  EXPECT_FALSE(LogDimensionlessJerk(one).has_value());
  EXPECT_FALSE(LogDimensionlessJerk(two).has_value());
  EXPECT_FALSE(LogDimensionlessJerk(still).has_value());
  EXPECT_FALSE(LogDimensionlessJerk(even).has_value()) << "an even speed has no jerk";
  EXPECT_EQ(MoveCount({}, 0.02), 0);
  EXPECT_EQ(MoveCount(one, 0.0), 0);
  EXPECT_EQ(MoveCount(even, 0.0), 0);
}

// Frames of a movement, with a pause after it.
template <class WayAt>
void AppendMovement(std::vector<AttemptFrame>& frames, int count, const WayAt& way_at) {
  const auto movement = test::FramesOfTip(count, DeviceRole::kInstrument, [&](int k) {
    return glm::dvec3(way_at(kFrameTime * k), 0, 0.02);
  });
  frames.insert(frames.end(), movement.begin(), movement.end());
  frames.push_back(test::QuietFrame());
  frames.back().is_paused = true;
}

// Way of n bells of 2 s that reach 20 mm/s.
void AppendBells(std::vector<AttemptFrame>& frames, int bells) {
  AppendMovement(frames, 200 * bells + 1, [](double t) {
    return 0.01 * (t - std::sin(std::numbers::pi * t) / std::numbers::pi);
  });
}

// Way of a Gaussian speed about 2 s.
double GaussianWay(double t, double deviation) {
  return 0.01 * (1 + std::erf((t - 2) / (deviation * std::numbers::sqrt2)));
}

double SmoothnessOf(const std::vector<AttemptFrame>& frames, const char* id) {
  return test::ValueIn(MeasureAttempt(frames, {}), id, "instrument");
}

TEST(Smoothness, JerkOfAnAttemptIsTheMedianOfItsStretches) {
  std::vector<AttemptFrame> frames;
  AppendBells(frames, 1);
  // Differences and ends change the integral by 1 % for one bell of 2 s, as above.
  EXPECT_NEAR(SmoothnessOf(frames, "ldlj"), JerkOfBells(1), 0.015);
  AppendBells(frames, 3);
  // The middle of two: (-ln 2 π⁴ - ln 2 π⁴ 3⁴) / 2 = -ln(2 π⁴ 3²).
  EXPECT_NEAR(SmoothnessOf(frames, "ldlj"), 0.5 * (JerkOfBells(1) + JerkOfBells(3)), 0.015);
  AppendBells(frames, 2);
  EXPECT_NEAR(SmoothnessOf(frames, "ldlj"), JerkOfBells(2), 0.015);
}

TEST(Smoothness, ArcLengthOfAnAttemptIsTheMedianOfItsStretches) {
  std::vector<AttemptFrame> frames;
  AppendMovement(frames, 401, [](double t) { return GaussianWay(t, 0.2); });
  EXPECT_NEAR(SmoothnessOf(frames, "sparc"), kGaussianArc, 4e-3);
  // One stretch is far less smooth, and the median lies on one of the two Gaussian ones.
  AppendMovement(frames, 401,
                 [](double t) { return GaussianWay(t + 1, 0.2) + GaussianWay(t - 0.5, 0.2); });
  AppendMovement(frames, 401, [](double t) { return GaussianWay(t, 0.3); });
  EXPECT_NEAR(SmoothnessOf(frames, "sparc"), kGaussianArc, 4e-3);
  // Stretches shorter than 1 s, and those in which the tool rests, do not count.
  for (int i = 0; i < 5; ++i) {
    AppendMovement(frames, 99, [](double t) { return 1e-3 * std::sin(30 * t); });
    AppendMovement(frames, 200, [](double) { return 0.003; });
  }
  EXPECT_NEAR(SmoothnessOf(frames, "sparc"), kGaussianArc, 4e-3);
}

}  // namespace
}  // namespace arthro::simulation
