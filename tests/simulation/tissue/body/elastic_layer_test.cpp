// Cartilage as a thin elastic layer.
#include "simulation/tissue/body/elastic_layer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "tests/support/allocation_counter.h"

namespace arthro::simulation {
namespace {

constexpr double kE = 1e6, kThickness = 3e-3;

ElasticLayer LayerOf(double nu) {
  Material material;
  material.young_modulus = kE;
  material.poisson_ratio = nu;
  return ElasticLayer(material, kThickness);
}

// Force relative to that of a flat end on a half space, 2 E a δ / (1 − ν²).
double Kappa(const ElasticLayer& layer, double nu, double ratio) {
  const double a = ratio * kThickness;
  return layer.PressFlat(a, 1e-5).force * (1 - nu * nu) / (2 * kE * a * 1e-5);
}

TEST(ElasticLayer, FlatEndMatchesTheScalingFactorOfHayes) {
  // Hayes, Keer, Herrmann & Mockros 1972, table 1: κ(a/h, ν). They solved the same equation with
  // the numerical means of 1972. Their last column differs by 1 % from the converged solution.
  constexpr double kRatio[] = {0.2, 0.4, 0.6, 0.8, 1.0, 1.5, 2.0};
  constexpr struct {
    double nu, kappa[7];
  } kRows[] = {{0.3, {1.207, 1.472, 1.784, 2.124, 2.480, 3.400, 4.336}},
               {0.4, {1.232, 1.542, 1.917, 2.337, 2.789, 3.996, 5.271}},
               {0.45, {1.252, 1.599, 2.031, 2.532, 3.085, 4.638, 6.380}},
               {0.4999999, {1.281, 1.683, 2.211, 2.855, 3.609, 5.970, 9.069}}};
  double worst = 0;
  for (const auto& row : kRows) {
    const ElasticLayer layer = LayerOf(row.nu);
    for (int i = 0; i < 7; ++i) {
      const double error = Kappa(layer, row.nu, kRatio[i]) / row.kappa[i] - 1;
      worst = std::max(worst, std::abs(error));
      EXPECT_NEAR(error, 0, 0.01) << row.nu << " " << kRatio[i];
    }
  }
  std::printf("[ layer ] largest difference from Hayes' table %.2g %%\n", 100 * worst);
}

TEST(ElasticLayer, WideContactIsAFoundationAndSmallContactAHalfSpace) {
  const double nu = 0.3, ball = 0.02;
  const ElasticLayer layer = LayerOf(nu);
  const double aggregate = kE * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
  EXPECT_NEAR(layer.foundation(), aggregate / kThickness, 1e-9 * layer.foundation());
  // Wide contact: the edge adds a term that falls as h/a: 2.5 % at 10, a quarter of that at 40.
  const double wide = 10 * kThickness;
  EXPECT_NEAR(layer.PressFlat(wide, 1e-5).force /
                  (layer.foundation() * std::numbers::pi * wide * wide * 1e-5),
              1.0, 0.03);
  // Very large ball: F = π (H_A/h) R δ², a² = 2 R δ.
  const double huge = 10.0, depth = 0.02e-3;
  const LayerTouch winkler = layer.PressBall(huge, depth);
  EXPECT_GT(winkler.contact_radius, 6 * kThickness);
  EXPECT_NEAR(winkler.force / (std::numbers::pi * layer.foundation() * huge * depth * depth), 1.0,
              0.03);
  EXPECT_NEAR(winkler.contact_radius / std::sqrt(2 * huge * depth), 1.0, 0.03);
  // Small contact: Hertz, F = 4/3 E/(1−ν²) √R δ^1.5; a/h = 0.01 differs by 1 %.
  const double tiny = 1e-7;
  const LayerTouch hertz = layer.PressBall(ball, tiny);
  EXPECT_LT(hertz.contact_radius, 0.02 * kThickness);
  EXPECT_NEAR(hertz.force / (4.0 / 3 * kE / (1 - nu * nu) * std::sqrt(ball) * std::pow(tiny, 1.5)),
              1.0, 0.015);
}

TEST(ElasticLayer, NearlyIncompressibleLayerIsSofterThanItsFoundation) {
  // Probe's ball of 0.75 mm, 0.3 mm deep in 3 mm of cartilage. Water cannot leave a wide contact,
  // so the foundation's modulus grows as 1 / (1 − 2ν). Under a small contact it moves sideways. The
  // force then grows only with 1 − ν² and the finite thickness: some per cent.
  const auto force = [](double nu) { return LayerOf(nu).PressBall(0.75e-3, 0.3e-3).force; };
  EXPECT_NEAR(LayerOf(0.499).foundation() / LayerOf(0.49).foundation(), 10, 0.5);
  const double growth = force(0.499) / force(0.49);
  EXPECT_GT(growth, 1.0);
  EXPECT_LT(growth, 1.05);
  const double hertz =
      4.0 / 3 * kE / (1 - 0.49 * 0.49) * std::sqrt(0.75e-3) * std::pow(0.3e-3, 1.5);
  EXPECT_GT(force(0.49), hertz);  // bone behind it makes it stiffer than a half space
}

TEST(ElasticLayer, StiffnessIsTheDerivativeAndDepthTheInverseOfTheForce) {
  for (const double nu : {0.0, 0.3, 0.45, 0.499}) {
    const ElasticLayer layer = LayerOf(nu);
    for (const double radius : {0.2e-3, 0.75e-3, 2e-3, 20e-3})
      for (double depth = 1e-8; depth < kThickness; depth *= 1.37) {
        const LayerTouch touch = layer.PressBall(radius, depth);
        const double step = 1e-5 * depth;
        const double slope = (layer.PressBall(radius, depth + step).force -
                              layer.PressBall(radius, depth - step).force) /
                             (2 * step);
        // Central differences over 1e-5 have rounding and truncation errors below 1e-8. A step may
        // span two samples, where the second derivative jumps.
        EXPECT_NEAR(touch.stiffness / slope, 1, 1e-5) << nu << " " << radius << " " << depth;
        EXPECT_NEAR(layer.BallDepth(radius, touch.force) / depth, 1, 1e-9);
        EXPECT_EQ(touch.is_deep, depth > 0.3 * kThickness || depth > 0.8 * radius);
        const LayerTouch flat = layer.PressFlat(radius, depth);
        EXPECT_NEAR(flat.force, flat.stiffness * depth, 1e-12 * flat.force);
        EXPECT_NEAR(layer.FlatDepth(radius, flat.force) / depth, 1, 1e-12);
        // The theorem that gives the slopes at the samples also holds between them, for a ball
        // shallow enough to be a paraboloid.
        if (depth < 0.02 * radius) {
          EXPECT_NEAR(touch.stiffness / layer.PressFlat(touch.contact_radius, depth).stiffness, 1,
                      0.01)
              << nu << " " << radius << " " << depth;
        }
      }
  }
}

TEST(ElasticLayer, PressingAllocatesNothingAndAcceptsAnyNumber) {
  const ElasticLayer layer = LayerOf(0.45);
  const long before = test::Allocations();
  double sum = 0;
  for (int i = 0; i < 100; ++i) {
    sum += layer.PressBall(0.75e-3, i * 1e-5).force + layer.PressFlat(1e-3, i * 1e-5).force;
    sum += layer.BallDepth(0.75e-3, i * 0.01) + layer.FlatDepth(1e-3, i * 0.01);
  }
  EXPECT_EQ(test::Allocations(), before);
  EXPECT_TRUE(std::isfinite(sum));
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  for (const double bad : {0.0, -1.0, kNaN, kInf}) {
    EXPECT_EQ(layer.PressBall(1e-3, bad).force, 0);
    EXPECT_EQ(layer.PressBall(bad, 1e-3).force, 0);
    EXPECT_EQ(layer.PressFlat(bad, 1e-3).force, 0);
    EXPECT_EQ(layer.BallDepth(1e-3, bad), 0);
    EXPECT_EQ(layer.FlatDepth(bad, 1), 0);
  }
}

TEST(ElasticLayer, RefusesInvalidLayers) {
  Material material;
  EXPECT_THROW(ElasticLayer(material, 0), Error);
  EXPECT_THROW(ElasticLayer(material, std::numeric_limits<double>::quiet_NaN()), Error);
  material.poisson_ratio = 0.5;
  EXPECT_THROW(ElasticLayer(material, 1e-3), Error);
  material.poisson_ratio = 0.4;
  material.young_modulus = -1;
  EXPECT_THROW(ElasticLayer(material, 1e-3), Error);
}

// Half plane: F' = π E* a²/4R [Johnson 1985, 4.45]. A line wide relative to the thickness feels the
// foundation, ∫ (δ − x²/2R) = 4/3 δ √(2Rδ) wide.
TEST(ElasticLayer, LyingRodIsHertzLineContactIfThinAndFoundationIfThick) {
  for (double nu : {0.0, 0.3, 0.45}) {
    const ElasticLayer layer = LayerOf(nu);
    const LayerTouch thin = layer.PressLine(1e-4, 1e-5);
    const double a = thin.contact_radius;
    EXPECT_NEAR(thin.force / (std::numbers::pi * kE / (1 - nu * nu) * a * a / (4 * 1e-4)), 1, 1e-3);
    const LayerTouch thick = layer.PressLine(2.0, 1e-4);
    const double wide = layer.foundation() * 4.0 / 3 * 1e-4 * std::sqrt(2 * 2.0 * 1e-4);
    std::printf("[ layer ] nu %.2f: line %.1f thicknesses wide is %.3f of the foundation\n", nu,
                thick.contact_radius / kThickness, thick.force / wide);
    EXPECT_NEAR(thick.force / wide, 1, 0.1);
    for (double depth = 1e-7; depth < 2e-3; depth *= 1.3) {
      const LayerTouch touch = layer.PressLine(0.75e-3, depth);
      const double step = 1e-4 * depth;
      const double slope = (layer.PressLine(0.75e-3, depth + step).force -
                            layer.PressLine(0.75e-3, depth - step).force) /
                           (2 * step);
      EXPECT_NEAR(touch.stiffness / slope, 1, 1e-3) << depth;
    }
    EXPECT_EQ(layer.PressLine(0.75e-3, -1e-3).force, 0);
    EXPECT_EQ(layer.PressLine(std::nan(""), 1e-3).force, 0);
  }
}

static_assert(noexcept(std::declval<const ElasticLayer&>().PressLine(1e-3, 1e-3)));

}  // namespace
}  // namespace arthro::simulation
