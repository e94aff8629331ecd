// Touch of a relief whose error is known: noise of known standard deviation and correlation length
// on surfaces in closed form [method.md, Backdrop force].
#include "simulation/haptics/relief/relief_smoothing.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/haptics/contact.h"
#include "simulation/haptics/relief/depth_field.h"
#include "tests/support/haptics/analytic_relief.h"

namespace arthro::simulation {
namespace {

using test::AnalyticRelief;

constexpr int kMapSide = 512;
constexpr double kSphere = 0.05, kLevel = 0.004;  // m

// Surface at 46 mm with pixels of 0.1 mm, the same in all directions near the equator.
AnalyticRelief Level(std::function<double(glm::dvec2)> relief = [](glm::dvec2) { return kLevel; }) {
  AnalyticRelief made = AnalyticRelief::Make(ProjectionType::kEquirectangular, std::move(relief));
  made.width = made.height = kMapSide;
  made.backdrop.radius = kSphere;
  made.backdrop.projection.centre_px = {(kMapSide - 1) / 2.0, (kMapSide - 1) / 2.0};
  made.backdrop.projection.px_per_deg = 460 * kRadianPerDegree;
  return made;
}
constexpr double kPxPerM = 460 / (kSphere - kLevel);  // on the level surface

// Gaussian noise of the standard deviation `sigma` with the correlation exp(−d²/4ℓ²), which is
// white noise behind a Gaussian filter of ℓ pixels; ℓ = 0: white. Periodic.
DepthMap Noise(double sigma, double correlation_px, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  DepthMap noise(kMapSide, kMapSide);
  for (float& h : noise.relief) h = normal(random);
  double gain = 1.0;
  if (correlation_px > 0.0) {
    const int half = static_cast<int>(std::ceil(4 * correlation_px));
    std::vector<float> kernel;
    double sum = 0, squares = 0;
    for (int k = -half; k <= half; ++k) {
      const double weight = std::exp(-0.5 * k * k / (correlation_px * correlation_px));
      kernel.push_back(static_cast<float>(weight));
      sum += weight;
      squares += weight * weight;
    }
    gain = squares;  // in both directions, by the unnormalised kernel
    for (const bool is_across : {true, false}) {
      const DepthMap before = noise;
      for (int y = 0; y < kMapSide; ++y)
        for (int x = 0; x < kMapSide; ++x) {
          float value = 0;
          for (int k = -half; k <= half; ++k)
            value += kernel[static_cast<std::size_t>(k + half)] *
                     before.at(is_across ? (x + k + kMapSide) % kMapSide : x,
                               is_across ? y : (y + k + kMapSide) % kMapSide);
          noise.at(x, y) = value;
        }
    }
  }
  for (float& h : noise.relief) h *= static_cast<float>(sigma / gain);
  return noise;
}

DepthMap Sum(DepthMap a, const DepthMap& b) {
  for (std::size_t i = 0; i < a.relief.size(); ++i) a.relief[i] += b.relief[i];
  return a;
}

struct Left {
  double rms = 0, slope = 0, most = 0;  // m, rms of one axis, m
};

// Noise that is left away from the border, of a touched relief against a level surface.
Left LeftOf(const TouchedRelief& touched, const DepthMap& truth, int margin) {
  Left left;
  double squares = 0, slopes = 0;
  int count = 0;
  const auto off = [&](int x, int y) {
    const std::size_t i = static_cast<std::size_t>(y * kMapSide + x);
    return static_cast<double>(touched.height[i] - truth.relief[i]);
  };
  for (int y = margin; y < kMapSide - margin; ++y)
    for (int x = margin; x < kMapSide - margin; ++x) {
      const double e = off(x, y), du = 0.5 * (off(x + 1, y) - off(x - 1, y)),
                   dv = 0.5 * (off(x, y + 1) - off(x, y - 1));
      squares += e * e;
      slopes += 0.5 * (du * du + dv * dv) * kPxPerM * kPxPerM;
      left.most = std::max(left.most, std::abs(e));
      ++count;
    }
  left.rms = std::sqrt(squares / count);
  left.slope = std::sqrt(slopes / count);
  return left;
}

constexpr double kNoise = 3e-4;  // m
// Standard deviation of the smoothing in pixels, with the two usual passes of ½ px² each.
double SmoothingPx(double sigma) {
  const double s = sigma / (2 * std::numbers::sqrt2 * NoiseLimits{}.slope) * kPxPerM;
  return std::sqrt(s * s + 1.0);
}

TEST(ReliefSmoothing, LeavesOfNoiseWhatTheFormulaSaysAndBoundsItsSlope) {
  const AnalyticRelief level = Level();
  const DepthMap truth = level.Float(), sigma(kMapSide, kMapSide, static_cast<float>(kNoise));
  const double s = SmoothingPx(kNoise);
  for (const double correlation : {0.0, 1.0, s / 5, s, 2 * s}) {
    const TouchedRelief touched = SmoothRelief(Sum(truth, Noise(kNoise, correlation, 11)), 2, sigma,
                                               level.backdrop, NoiseLimits{});
    const Left left = LeftOf(touched, truth, 48);
    const double l2 = correlation * correlation, t2 = s * s;
    const double rms = correlation > 0 ? kNoise * correlation / std::sqrt(l2 + t2)
                                       : kNoise / (2 * std::sqrt(std::numbers::pi) * s);
    const double slope = (correlation > 0 ? kNoise * correlation / (std::numbers::sqrt2 * (l2 + t2))
                                          : kNoise / (std::sqrt(8 * std::numbers::pi) * t2)) *
                         kPxPerM;
    // Independent patches of the map: the rms of the sample is uncertain by 1/√(2 patches); four of
    // these, and 5 % for the pixels, the gaps of the filter, and growths that noise stops.
    const double patches =
        (kMapSide - 96.0) * (kMapSide - 96.0) / (4 * std::numbers::pi * (l2 + t2));
    const double tolerance = 0.05 + 4 / std::sqrt(2 * patches);
    std::printf("noise over %4.1f px: left %.1f µm (%.1f), slope %.4f (%.4f), most %.2f σ\n",
                correlation, 1e6 * left.rms, 1e6 * rms, left.slope, slope, left.most / kNoise);
    EXPECT_NEAR(left.rms / rms, 1.0, tolerance) << correlation;
    EXPECT_NEAR(left.slope / slope, 1.0, tolerance) << correlation;
    EXPECT_LT(left.slope, NoiseLimits{}.slope * (1 + tolerance)) << correlation;
    // Five standard deviations of what is left: 5 ℓ/√(ℓ² + s²) < 1.
    if (correlation <= s / 5) {
      EXPECT_LT(left.most, kNoise) << "no bump is higher than its standard error";
    }
  }
}

// A bump of the width w keeps w²/(w² + s²) of its height.
TEST(ReliefSmoothing, FlattensABumpThatTheErrorExplains) {
  const double s = SmoothingPx(kNoise), width = s / 3;
  const DepthMap sigma(kMapSide, kMapSide, static_cast<float>(kNoise));
  for (const double height : {0.5 * kNoise, kNoise, 2 * kNoise}) {
    const AnalyticRelief bump = Level([=](glm::dvec2 p) {
      const glm::dvec2 d = p - glm::dvec2(256, 256);
      return kLevel + height * std::exp(-0.5 * glm::dot(d, d) / (width * width));
    });
    const TouchedRelief touched =
        SmoothRelief(bump.Float(), 2, sigma, bump.backdrop, NoiseLimits{});
    const double left = static_cast<double>(touched.height[256 * kMapSide + 256]) - kLevel;
    std::printf("bump of %.1f σ: %.3f σ left\n", height / kNoise, left / kNoise);
    EXPECT_LT(left, kNoise);
    EXPECT_NEAR(left / height, 1.0 / 10, 0.02);
  }
}

TEST(ReliefSmoothing, KeepsAStepThatTheErrorDoesNotExplain) {
  constexpr double kHigh = 0.012;  // m
  const AnalyticRelief step = Level([](glm::dvec2 p) { return p.x < 256 ? 0.0 : kHigh; });
  const DepthMap truth = step.Float(), sigma(kMapSide, kMapSide, static_cast<float>(kNoise));
  const TouchedRelief touched =
      SmoothRelief(Sum(truth, Noise(kNoise, 1.0, 3)), 2, sigma, step.backdrop, NoiseLimits{});
  // A growth stops where it changes the relief by 1.5 σ; so do all that came before it together,
  // within the 1 px of the usual smoothing beside the edge.
  for (int y = 100; y < 400; y += 7)
    for (int x = 100; x < 412; ++x) {
      if (std::abs(x - 255.5) < 4) continue;
      const double off = static_cast<double>(
          touched.height[static_cast<std::size_t>(y * kMapSide + x)] - truth.at(x, y));
      EXPECT_LT(std::abs(off), 3 * kNoise) << x << ' ' << y;
    }
}

// Beside a step the smoothing goes on along it and away from it, so the slope of the noise keeps
// its bound there too; a smoothing that stops wherever it would reach across leaves the noise.
TEST(ReliefSmoothing, BoundsTheSlopeOfNoiseBesideAStepToo) {
  constexpr double kHigh = 0.012;  // m
  const AnalyticRelief step = Level([](glm::dvec2 p) { return p.x < 256 ? 0.0 : kHigh; });
  const DepthMap sigma(kMapSide, kMapSide, static_cast<float>(kNoise));
  for (const double correlation : {2.0, 8.0}) {
    const TouchedRelief touched = SmoothRelief(Sum(step.Float(), Noise(kNoise, correlation, 3)), 2,
                                               sigma, step.backdrop, NoiseLimits{});
    const auto at = [&](int x, int y) {
      return static_cast<double>(touched.height[static_cast<std::size_t>(y * kMapSide + x)]);
    };
    for (const auto& [first, last] : {std::pair{240, 250}, std::pair{262, 272}}) {
      double squares = 0;
      int count = 0;
      for (int y = 64; y < kMapSide - 64; ++y)
        for (int x = first; x < last; ++x, ++count) {
          const double du = 0.5 * (at(x + 1, y) - at(x - 1, y)),
                       dv = 0.5 * (at(x, y + 1) - at(x, y - 1));
          squares += 0.5 * (du * du + dv * dv) * kPxPerM * kPxPerM;
        }
      const double slope = std::sqrt(squares / count);
      std::printf("noise over %g px, columns %d to %d: slope %.3f\n", correlation, first, last,
                  slope);
      // Half of the kernel is left beside the step, so twice the variance of the plane's height,
      // and of its slope in one direction; the strip has some 30 independent patches.
      EXPECT_LT(slope, NoiseLimits{}.slope * std::numbers::sqrt2 * (1 + 4 / std::sqrt(2 * 30.0)));
    }
  }
}

TEST(ReliefSmoothing, IsExactOnAPlaneAlsoBesideHolesAndBorders) {
  constexpr double kSlope = 2e-5;  // m per px
  const AnalyticRelief plane =
      Level([](glm::dvec2 p) { return kLevel + kSlope * (p.x - 256) + 0.5 * kSlope * p.y; });
  DepthMap map = plane.Float();
  for (int y = 200; y < 280; ++y)
    for (int x = 240; x < 300; ++x) map.at(x, y) = std::numeric_limits<float>::quiet_NaN();
  DepthMap sigma(kMapSide, kMapSide, 2e-4f);
  for (int y = 0; y < kMapSide; ++y)
    for (int x = 300; x < kMapSide; ++x) sigma.at(x, y) = 2e-3f;
  const TouchedRelief touched = SmoothRelief(map, 2, sigma, plane.backdrop, NoiseLimits{});
  double worst = 0;
  for (int y = 0; y < kMapSide; ++y)
    for (int x = 0; x < kMapSide; ++x) {
      if (std::isnan(map.at(x, y))) continue;
      // The usual passes are not exact within their reach of two pixels beside unknown ones.
      worst = std::max(
          worst, std::abs(static_cast<double>(
                     touched.height[static_cast<std::size_t>(y * kMapSide + x)] - map.at(x, y))));
    }
  std::printf("plane: off by %.2f µm at worst\n", 1e6 * worst);
  // One pixel of the plane's slope.
  EXPECT_LT(worst, 1.2 * kSlope);
}

TEST(ReliefSmoothing, AnErrorOfZeroOrNoneChangesNoBit) {
  const AnalyticRelief waves = AnalyticRelief::Waves(ProjectionType::kGnomonic);
  DepthMap map = waves.Float();
  for (int x = 300; x < 340; ++x) map.at(x, 400) = std::numeric_limits<float>::quiet_NaN();
  const DepthField without(waves.backdrop, map),
      zero(waves.backdrop, map, {}, DepthMap(1024, 1024, 0.0f)),
      unknown(waves.backdrop, map, {},
              DepthMap(1024, 1024, std::numeric_limits<float>::quiet_NaN()));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-10, 1034);
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 x =
        0.046 * DirectionFromPixel(waves.backdrop.projection, {any(random), any(random)});
    const FieldQuery a = without.Query(x);
    for (const DepthField* field : {&zero, &unknown}) {
      const FieldQuery b = field->Query(x);
      ASSERT_EQ(a.clearance, b.clearance);
      ASSERT_EQ(a.normal, b.normal);
      ASSERT_EQ(a.weight, b.weight);
    }
  }
}

// F = K d / (1 + σ/σ0), so that the error σ of the height changes the force by less than K σ0.
TEST(DepthFieldWithError, LowersTheStiffnessByItsStandardError) {
  const AnalyticRelief level = Level();
  const ContactOptions options;
  const DepthFieldOptions of_field;
  for (const double error : {0.0, 2e-4, 1e-3, 3e-3}) {
    const DepthField field(level.backdrop, level.Float(), of_field,
                           DepthMap(kMapSide, kMapSide, static_cast<float>(error)));
    ContactState state;
    constexpr double kDepth = 1e-3;  // m below the surface
    const glm::dvec3 ray = DirectionFromPixel(level.backdrop.projection, {256, 256});
    ContactForce contact;
    for (int i = 0; i < 300; ++i)
      contact = TickContact({field, {}}, options, options.stiffness, {},
                            (kSphere - kLevel + kDepth) * ray, 1e-3, state);
    const double expected = options.stiffness * kDepth / (1 + error / of_field.soft_error);
    // The force of a tip that came from outside in one step has settled to a hundredth.
    EXPECT_NEAR(glm::length(contact.force), expected, 0.01 * expected) << error;
    EXPECT_LT(options.stiffness / (1 + error / of_field.soft_error) * error,
              options.stiffness * of_field.soft_error);
  }
}

TEST(DepthFieldWithError, AnUnknownDepthIsNoContactAndNeverARelief) {
  const AnalyticRelief level = Level();
  DepthMap map = level.Float();
  for (int y = 200; y < 300; ++y)
    for (int x = 200; x < 300; ++x) map.at(x, y) = std::numeric_limits<float>::quiet_NaN();
  const DepthField field(level.backdrop, map, {}, DepthMap(kMapSide, kMapSide, 2e-3f));
  for (double x = 180; x < 320; x += 0.5)
    for (const double radius : {0.046, 0.0499, 0.0501, 0.06}) {
      const FieldQuery query =
          field.Query(radius * DirectionFromPixel(level.backdrop.projection, {x, 250.2}));
      EXPECT_TRUE(std::isfinite(query.clearance));
      if (x >= 199 && x <= 300) {
        EXPECT_EQ(query.weight, 0.0) << x;
      } else if (query.weight > 0) {
        EXPECT_NEAR(query.clearance, 0.046 - radius, 1e-6) << "the level beside the hole";
      }
    }
}

// The stiffness changes by less than one part in twenty per pixel where the error jumps.
TEST(DepthFieldWithError, StiffnessChangesGradually) {
  const AnalyticRelief level = Level();
  DepthMap sigma(kMapSide, kMapSide, 2e-4f);
  for (int y = 0; y < kMapSide; ++y)
    for (int x = 256; x < kMapSide; ++x) sigma.at(x, y) = 3e-3f;
  const DepthField field(level.backdrop, level.Float(), {}, sigma);
  double last = -1;
  for (double x = 200; x < 312; x += 0.1) {
    const double weight =
        field.Query(0.046 * DirectionFromPixel(level.backdrop.projection, {x, 250.2})).weight;
    if (last >= 0) {
      EXPECT_LT(std::abs(weight - last), 0.05 * 0.1 * 2) << x;
    }
    last = weight;
  }
}

// A map without steps, wide enough that a change has an end.
struct QuietMap {
  static constexpr int kWide = 1400, kHigh = 900;
  QuietMap() : depth(kWide, kHigh), sigma(kWide, kHigh) {
    backdrop.radius = kSphere;
    backdrop.projection.type = ProjectionType::kGnomonic;
    backdrop.projection.centre_px = {700, 450};
    backdrop.projection.focal_px = 1000;
    std::mt19937 random(4);
    std::normal_distribution<float> noise(0, 1e-4f);
    for (int y = 0; y < kHigh; ++y)
      for (int x = 0; x < kWide; ++x) {
        depth.at(x, y) =
            0.01f + 2e-3f * std::sin(0.01f * static_cast<float>(x + y)) + noise(random);
        sigma.at(x, y) = 1e-4f * (1.2f + 0.5f * std::sin(0.02f * static_cast<float>(x)));
        if (x > 650 && x < 670) depth.at(x, y) = sigma.at(x, y) = std::nanf("");
      }
  }
  // Height of 0.3 mm over a disc, with a standard error of its own.
  PixelBounds Raise(int x, int y, int radius) {
    for (int v = y - radius; v <= y + radius; ++v)
      for (int u = x - radius; u <= x + radius; ++u)
        if (std::hypot(u - x, v - y) <= radius) {
          depth.at(u, v) += 3e-4f;
          sigma.at(u, v) *= 1.5f;
        }
    return {x - radius, y - radius, x + radius + 1, y + radius + 1};
  }
  DepthMap depth, sigma;
  Backdrop backdrop;
};

TEST(WithoutNoiseAround, HasTheBytesOfTheWholeMapWhereAChangeReaches) {
  QuietMap map;
  const DepthMap before = WithoutNoise(map.depth, map.sigma, map.backdrop);
  const PixelBounds changed = map.Raise(610, 400, 15);  // near the unknown stripe
  const DepthMap after = WithoutNoise(map.depth, map.sigma, map.backdrop);
  const QuietPart part = WithoutNoiseAround(map.depth, map.sigma, map.backdrop, changed);
  DepthMap pieced = before;
  for (int y = 0; y < part.relief.height; ++y)
    for (int x = 0; x < part.relief.width; ++x)
      pieced.at(part.box.left + x, part.box.top + y) = part.relief.at(x, y);
  const PixelBounds off = DifferenceOf(pieced, after), altered = DifferenceOf(before, after);
  std::printf("changed %d x %d px, altered %d x %d, made anew %d x %d, read %d of %d px\n",
              changed.width(), changed.height(), altered.width(), altered.height(),
              part.box.width(), part.box.height(), part.read, QuietMap::kWide * QuietMap::kHigh);
  EXPECT_FALSE(altered.is_empty());
  EXPECT_TRUE(off.is_empty()) << off.left << " " << off.top << " " << off.right << " "
                              << off.bottom;
  EXPECT_LT(part.read, QuietMap::kWide * QuietMap::kHigh / 3);
}

TEST(WithoutNoiseAround, IsTheWholeMapWhereAnErrorIsMissing) {
  QuietMap map;
  map.sigma.at(5, 5) = std::nanf("");  // counts as the largest error of the map
  const PixelBounds changed = map.Raise(300, 400, 15);
  EXPECT_EQ(WithoutNoiseAround(map.depth, map.sigma, map.backdrop, changed).box,
            (PixelBounds{0, 0, QuietMap::kWide, QuietMap::kHigh}));
}

}  // namespace
}  // namespace arthro::simulation
