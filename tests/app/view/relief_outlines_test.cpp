// Outlines of a depth map against the shapes that it was sampled from.
#include "app/view/backdrop/relief_outlines.h"

#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/haptics/relief/relief_smoothing.h"
#include "simulation/scene/image.h"
#include "tests/support/view/reference_tracer.h"

namespace arthro::app {
namespace {

using namespace test;

constexpr int kMapSide = 160;
constexpr float kNear = 0.02f, kFar = 0.005f;

// Returns how far a place lies inside the near part, texels.
using Inside = std::function<double(double, double)>;

DepthMap Sampled(const Inside& inside, float far = kFar) {
  DepthMap map(kMapSide, kMapSide);
  for (int y = 0; y < kMapSide; ++y)
    for (int x = 0; x < kMapSide; ++x) map.at(x, y) = inside(x, y) > 0 ? kNear : far;
  return map;
}

double Bilinear(const DepthMap& map, double x, double y) {
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const double f = x - i, g = y - j;
  return (1 - g) * ((1 - f) * map.at(i, j) + f * map.at(i + 1, j)) +
         g * ((1 - f) * map.at(i, j + 1) + f * map.at(i + 1, j + 1));
}

// Distances of a level line of the step, usually that of half its height, from the true outline
// along its normal, texels; their spread is the staircase.
double StairOf(const DepthMap& map, const Inside& inside, double level = 0.5, float far = kFar) {
  double sum = 0, squares = 0;
  int count = 0;
  for (double y = 20; y < kMapSide - 20; y += 0.21)
    for (double x = 20; x < kMapSide - 20; x += 0.37) {
      const double here = inside(x, y);
      if (std::abs(here) > 0.02) continue;
      constexpr double kBeside = 1e-4;
      const double u = (inside(x + kBeside, y) - here) / kBeside,
                   v = (inside(x, y + kBeside) - here) / kBeside;
      double t = -3;
      while (t < 3 && Bilinear(map, x + u * t, y + v * t) < far + level * (kNear - far)) t += 0.005;
      sum += t, squares += t * t, ++count;
    }
  EXPECT_GT(count, 5);
  return std::sqrt(std::max(squares / count - sum * sum / count / count, 0.0));
}

Inside Line(double slope) {
  return [=](double x, double y) {
    return (slope * (x - 80.3) + (y - 80.2)) / std::hypot(1.0, slope);
  };
}
Inside Disc(double radius) {
  return [=](double x, double y) { return radius - std::hypot(x - 80.3, y - 79.6); };
}

// A uniform error of half a texel to either side has a standard deviation of 0.29.
TEST(ReliefOutlines, OfLinesBecomeStraightAndOfDiscsNoWorse) {
  const auto stairs = [&](const char* name, const Inside& inside) {
    const DepthMap map = Sampled(inside);
    DepthMap smooth = map;
    SmoothOutlines(smooth, false);
    const std::pair<double, double> both = {StairOf(map, inside), StairOf(smooth, inside)};
    std::printf("%s: %.3f texels before, %.3f after\n", name, both.first, both.second);
    return both;
  };
  for (const double slope : {1 / 23.0, 1 / 7.0, 0.4, -0.4, 2.5, 11.0}) {
    const auto [before, after] = stairs(("line of " + std::to_string(slope)).c_str(), Line(slope));
    EXPECT_LT(after, 0.1);
    EXPECT_LT(after, 0.5 * before);
  }
  for (const double radius : {5.3, 15.3, 60.3}) {
    const auto [before, after] =
        stairs(("disc of " + std::to_string(radius)).c_str(), Disc(radius));
    EXPECT_LT(after, before);
  }
}

// The silhouette of a near part is the line where its fall begins: 0.08 mm below it, which is 5 %
// of the highest step whose crest has the bound of its middle. Higher ones have to stay within the
// bounds of `bench view`.
TEST(ReliefOutlines, CrestsOfLowStepsAreAsStraightAsTheirMiddle) {
  constexpr float kLow = kNear - 1.6e-3f;
  for (const double slope : {1 / 23.0, 1 / 7.0, 0.4, -0.4, 2.5, 11.0}) {
    const Inside inside = Line(slope);
    const DepthMap map = Sampled(inside, kLow);
    DepthMap smooth = map;
    SmoothOutlines(smooth, false);
    const double before = StairOf(map, inside, 0.95, kLow),
                 after = StairOf(smooth, inside, 0.95, kLow);
    std::printf("crest of a line of %.3f: %.3f texels before, %.3f after\n", slope, before, after);
    EXPECT_LT(after, 0.1);
    EXPECT_LT(after, 0.5 * before);
  }
}

TEST(ReliefOutlines, ChangeOnlyAdjacentTexelsAndStayBetweenNearAndFar) {
  const DepthMap map = Sampled(Disc(40));
  DepthMap smooth = map;
  SmoothOutlines(smooth, false);
  int changed = 0;
  for (int y = 0; y < kMapSide; ++y)
    for (int x = 0; x < kMapSide; ++x) {
      EXPECT_GE(smooth.at(x, y), kFar);
      EXPECT_LE(smooth.at(x, y), kNear);
      if (smooth.at(x, y) == map.at(x, y)) continue;
      ++changed;
      EXPECT_LT(std::abs(Disc(40)(x, y)), 1.5) << x << " " << y;
    }
  EXPECT_GT(changed, 150);
}

TEST(ReliefOutlines, IgnoreSteepAndUnevenRelief) {
  DepthMap map(kMapSide, kMapSide);
  for (int y = 0; y < kMapSide; ++y)
    for (int x = 0; x < kMapSide; ++x)
      map.at(x, y) = static_cast<float>(4e-4 * x + 2e-4 * y + 3e-5 * std::sin(0.7 * x * y));
  DepthMap smooth = map;
  SmoothOutlines(smooth, false);
  EXPECT_EQ(smooth.relief, map.relief);
}

TEST(ReliefOutlines, LeaveOneTexelAndUnknownReliefUnchanged) {
  for (const float value : {0.01f, std::numeric_limits<float>::quiet_NaN()}) {
    DepthMap one(1, 1, value);
    SmoothOutlines(one, false);
    SmoothOutlines(one, true);
    EXPECT_EQ(std::isnan(one.at(0, 0)), std::isnan(value));
  }
  DepthMap spike(8, 8, 0.01f);
  spike.at(4, 4) = std::numeric_limits<float>::infinity();
  DepthMap same = spike;
  SmoothOutlines(same, false);
  EXPECT_EQ(same.relief, spike.relief);
  const Inside inside = Line(0.3);
  DepthMap map = Sampled(inside);
  for (int y = 0; y < kMapSide; ++y)
    for (int x = 60; x < 90; ++x)
      if (inside(x, y) < 0) map.at(x, y) = std::numeric_limits<float>::quiet_NaN();
  DepthMap smooth = map;
  SmoothOutlines(smooth, false);
  for (int y = 0; y < kMapSide; ++y)
    for (int x = 62; x < 88; ++x) {
      EXPECT_EQ(std::isnan(smooth.at(x, y)), std::isnan(map.at(x, y)));
      if (!std::isnan(map.at(x, y))) {
        EXPECT_EQ(smooth.at(x, y), map.at(x, y)) << "against the unknown there is no outline";
      }
    }
}

// A full turn has no seam: rotating and smoothing commute.
TEST(ReliefOutlines, AFullTurnHasNoSeam) {
  const auto turned = [](const DepthMap& map, int by) {
    DepthMap out = map;
    for (int y = 0; y < kMapSide; ++y)
      for (int x = 0; x < kMapSide; ++x) out.at((x + by) % kMapSide, y) = map.at(x, y);
    return out;
  };
  const DepthMap map =
      Sampled([](double x, double y) { return 80 + 9 * std::sin(0.0393 * x) - y; });
  DepthMap smooth = map, other = turned(map, 61);
  SmoothOutlines(smooth, true);
  SmoothOutlines(other, true);
  EXPECT_EQ(other.relief, turned(smooth, 61).relief);
  DepthMap seam = turned(map, 61);
  SmoothOutlines(seam, false);
  EXPECT_NE(seam.relief, other.relief) << "without it there is one";
  const DepthMap level = Sampled([](double, double y) { return 80.5 - y; });
  DepthMap round = level;
  SmoothOutlines(round, true);
  EXPECT_EQ(round.relief, level.relief) << "a tread without an end has no stair";
}

// Cost of straight outlines: a ramp along a line is up to two texels wide, one along a staircase
// only one. For a cliff of 6 mm along a wave, seen from above, counts rays that end more than 0.1
// mm from the cliff itself, sampled sixteen times as finely.
TEST(ReliefOutlines, AddAtMostHalfAsManyRaysOnTheSlope) {
  constexpr int kWidth = 256, kHeight = 192, kFiner = 16, kRays = 96;
  const auto cliff = [](double u, double v) {  // panorama pixels of the coarse map
    return v + 0.2 * u > 118 + 14 * std::sin(u / 25) ? 0.012f : 0.006f;
  };
  const auto sampled = [&](int finer) {
    DepthMap map(finer * kWidth, finer * kHeight);
    for (int y = 0; y < map.height; ++y)
      for (int x = 0; x < map.width; ++x)
        map.at(x, y) = cliff((x + 0.5) / finer - 0.5, (y + 0.5) / finer - 0.5);
    return map;
  };
  const auto backdrop_of = [](int finer) {
    Backdrop backdrop;
    backdrop.radius = 0.05;
    backdrop.projection.focal_px = 107.5 * finer;
    backdrop.projection.centre_px = {(finer * kWidth - 1) / 2.0, (finer * kHeight - 1) / 2.0};
    return backdrop;
  };
  const DepthMap map = sampled(1), fine = sampled(kFiner);
  DepthMap smooth = map;
  SmoothOutlines(smooth, false);
  int by_map = 0, by_smooth = 0, rays = 0;
  for (const double angle : {0.0, 0.5, 1.2}) {
    const auto view = simulation::ViewFromPose({0.25, 0.1, 3.0, 0.02}, angle);
    for (int y = 0; y < kRays; ++y)
      for (int x = 0; x < kRays; ++x) {
        const auto ray = ReferenceRay(view, 1.5, kRays, {x, y});
        if (!ray) continue;
        const auto truth = ReferenceReliefHit(backdrop_of(kFiner), fine, view.tip, *ray);
        const auto to = [&](const DepthMap& depth) {
          return glm::distance(*ReferenceReliefHit(backdrop_of(1), depth, view.tip, *ray), *truth);
        };
        ++rays;
        by_map += to(map) > 1e-4 ? 1 : 0;
        by_smooth += to(smooth) > 1e-4 ? 1 : 0;
      }
  }
  std::printf("%.2f %% of %d rays elsewhere by the map, %.2f %% by its smooth outlines\n",
              100.0 * by_map / rays, rays, 100.0 * by_smooth / rays);
  EXPECT_GT(by_map, rays / 100);
  EXPECT_LT(by_smooth, 1.5 * by_map);
}

// A step of 12 mm in a plane, with white noise of the standard deviation `error`.
DepthMap NoisyStep(float error) {
  std::mt19937 random(4);
  std::normal_distribution<float> noise(0.0f, error);
  const Inside inside = Line(0.3);
  DepthMap map(kMapSide, kMapSide);
  for (int y = 0; y < kMapSide; ++y)
    for (int x = 0; x < kMapSide; ++x)
      map.at(x, y) = (inside(x, y) > 0 ? 0.0185f : 0.0065f) + noise(random);
  return map;
}

int ChangedBeyond(const DepthMap& a, const DepthMap& b, const Inside& inside, double texels) {
  int changed = 0;
  for (int y = 0; y < kMapSide; ++y)
    for (int x = 0; x < kMapSide; ++x)
      changed += std::abs(inside(x, y)) > texels && a.at(x, y) != b.at(x, y) ? 1 : 0;
  return changed;
}

TEST(ReliefOutlines, OfNoiseAreNoneAndATrueStepKeepsItsOwn) {
  constexpr float kError = 5e-4f;
  const Inside inside = Line(0.3);
  const DepthMap map = NoisyStep(kError), sigma(kMapSide, kMapSide, kError);
  DepthMap unaware = map, aware = map;
  SmoothOutlines(unaware, false);
  SmoothOutlines(aware, false, sigma);
  const int of_noise = ChangedBeyond(unaware, map, inside, 2);
  std::printf("texels that noise of 0.5 mm makes outlines of: %d, with its error known %d\n",
              of_noise, ChangedBeyond(aware, map, inside, 2));
  EXPECT_GT(of_noise, 0) << "without the error noise is taken for steps";
  EXPECT_EQ(ChangedBeyond(aware, map, inside, 2), 0);
  EXPECT_LT(StairOf(aware, inside), 0.5 * StairOf(map, inside));
}

TEST(ReliefOutlines, AnErrorThatIsNotKnownChangesNothing) {
  const DepthMap map = NoisyStep(1e-4f);
  DepthMap one = map, other = map;
  SmoothOutlines(one, false);
  SmoothOutlines(other, false,
                 DepthMap(kMapSide, kMapSide, std::numeric_limits<float>::quiet_NaN()));
  EXPECT_EQ(one.relief, other.relief);
}

// Sides of a relief: steps between neighbouring texels that are higher than the standard error.
int SidesOf(const DepthMap& map, const Inside& inside, double texels, double error) {
  int sides = 0;
  for (int y = 0; y < kMapSide; ++y)
    for (int x = 0; x + 1 < kMapSide; ++x)
      sides += std::abs(inside(x, y)) > texels && std::abs(map.at(x + 1, y) - map.at(x, y)) > error
                   ? 1
                   : 0;
  return sides;
}

TEST(QuietRelief, HasNoSidesInNoiseAndKeepsThoseOfAStep) {
  constexpr float kError = 5e-4f;
  constexpr double kTexel = 1e-4;  // m, on the sphere
  Backdrop backdrop;
  backdrop.radius = 0.05;
  backdrop.projection.type = ProjectionType::kGnomonic;
  backdrop.projection.focal_px = backdrop.radius / kTexel;
  backdrop.projection.centre_px = {(kMapSide - 1) / 2.0, (kMapSide - 1) / 2.0};
  const Inside inside = Line(0.3);
  const DepthMap map = NoisyStep(kError), sigma(kMapSide, kMapSide, kError);
  const DepthMap drawn = simulation::WithoutNoise(map, sigma, backdrop);
  // Beside the step the smoothing is as narrow as its distance allows.
  constexpr double kBeside = 8;  // texels
  const int before = SidesOf(map, inside, kBeside, kError),
            after = SidesOf(drawn, inside, kBeside, kError);
  std::printf("sides in noise: %d of %d pairs, drawn %d\n", before, kMapSide * kMapSide, after);
  EXPECT_GT(before, kMapSide * kMapSide / 3);
  EXPECT_EQ(after, 0);
  int kept = 0, crossed = 0;
  for (int x = 10; x + 10 < kMapSide; ++x)
    for (int y = 10; y + 10 < kMapSide; ++y)
      if (inside(x, y) <= 0 && inside(x, y + 1) > 0) {
        ++crossed;
        // The median may move the stair of a step by one texel, so it rises within three.
        const float side = drawn.at(x, y + 2) - drawn.at(x, y - 1);
        // Five standard deviations of the noise of two texels.
        kept += side > 0.012f - 5 * 1.4143f * kError ? 1 : 0;
      }
  std::printf("side of the step of 12 mm: kept at %d of %d places\n", kept, crossed);
  EXPECT_EQ(kept, crossed);
}

}  // namespace
}  // namespace arthro::app
