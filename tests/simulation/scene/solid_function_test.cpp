#include "simulation/scene/solids/solid_function.h"

#include <cmath>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "simulation/scene/solids/solid_io.h"
#include "tests/support/allocation_counter.h"

namespace arthro {
namespace {

constexpr double kRounding = 1e-12;  // m, of sums of a few lengths of millimetres

SolidPlace Placed(const glm::dvec3& centre, SolidJoin join = SolidJoin::kUnion, double blend = 0,
                  int level = 0) {
  return {join, blend, level, {glm::dquat(1, 0, 0, 0), centre}};
}

Solid Of(std::vector<SolidPart> parts) { return {std::move(parts)}; }

// One of each primitive, blended and sharp, turned and nested.
Solid Mixed() {
  SolidPlace turned = Placed({1e-3, 0, 2e-3}, SolidJoin::kUnion, 1e-3);
  turned.solid_from_part.rotation = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3)));
  return Of({EllipsoidPart{Placed({0, 0, 0}), {4e-3, 3e-3, 2e-3}},
             CapsulePart{turned, 6e-3, 1.2e-3},
             TorusPart{Placed({0, 2e-3, 0}, SolidJoin::kDifference, 5e-4), 3e-3, 8e-4},
             BoxPart{Placed({-2e-3, 0, 0}, SolidJoin::kUnion, 0, 1), glm::dvec3(2e-3), 3e-4},
             PlanePart{Placed({0, 0, 1e-3}, SolidJoin::kIntersection, 2e-4, 1)}});
}

std::vector<glm::dvec3> Around(double reach, int count) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> side(-reach, reach);
  std::vector<glm::dvec3> points;
  for (int i = 0; i < count; ++i) {
    const double x = side(random), y = side(random), z = side(random);
    points.push_back({x, y, z});
  }
  return points;
}

TEST(SolidFunction, PrimitivesGiveTheirClosedFormDistance) {
  const SolidFunction ball(Of({EllipsoidPart{Placed({1e-3, 2e-3, 3e-3}), glm::dvec3(3e-3)}}));
  const SolidFunction rod(Of({CapsulePart{Placed({0, 0, 0}), 6e-3, 1e-3}}));
  const SolidFunction ring(Of({TorusPart{Placed({0, 0, 0}), 4e-3, 1e-3}}));
  for (const glm::dvec3& x : Around(1e-2, 2000)) {
    EXPECT_NEAR(ball.Value(x), glm::distance(x, {1e-3, 2e-3, 3e-3}) - 3e-3, kRounding);
    const glm::dvec3 on_axis(0, 0, std::clamp(x.z, -3e-3, 3e-3));
    EXPECT_NEAR(rod.Value(x), glm::distance(x, on_axis) - 1e-3, kRounding);
    EXPECT_NEAR(ring.Value(x), std::hypot(std::hypot(x.x, x.y) - 4e-3, x.z) - 1e-3, kRounding);
  }
  const SolidFunction box(Of({BoxPart{Placed({0, 0, 0}), {3e-3, 2e-3, 1e-3}}}));
  EXPECT_NEAR(box.Value({6e-3, 6e-3, 1e-3}), 5e-3, kRounding);
  EXPECT_NEAR(box.Value({0, 0, 4e-4}), -6e-4, kRounding);
}

// Dense reference: the nearest of 2.9 million points of the ellipsoid. Neighbours are at most h =
// π · 5 mm / 1200 apart, so the nearest lies within h / √2 beside the true one.
TEST(SolidFunction, EllipsoidAgreesWithADenseReference) {
  const glm::dvec3 radii(5e-3, 2e-3, 1e-3);
  const SolidFunction function(Of({EllipsoidPart{Placed({0, 0, 0}), radii}}));
  constexpr int kRows = 1200;
  std::vector<glm::dvec3> surface;
  for (int i = 0; i <= kRows; ++i)
    for (int j = 0; j < 2 * kRows; ++j) {
      const double a = std::numbers::pi * i / kRows, b = std::numbers::pi * j / kRows;
      surface.push_back(
          radii * glm::dvec3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)));
    }
  const double apart = std::numbers::pi * radii.x / kRows / std::numbers::sqrt2;
  double worst = 0;
  for (const glm::dvec3& x : Around(6e-3, 40)) {
    double least2 = 1;
    for (const glm::dvec3& p : surface) least2 = std::min(least2, glm::dot(x - p, x - p));
    const double reference = std::sqrt(least2), exact = std::abs(function.Value(x));
    // Off by at most the hypotenuse of the distance and half a gap.
    EXPECT_LE(exact, reference + kRounding);
    EXPECT_LE(reference, std::hypot(exact, apart) + apart * apart / radii.z);
    worst = std::max(worst, reference - exact);
  }
  RecordProperty("worst_off_um", std::to_string(1e6 * worst));
}

TEST(SolidFunction, ItsValueNeverExceedsTheDistance) {
  const SolidFunction function(Mixed());
  const SurfaceMesh surface = SurfaceOfSolid(Mixed(), 96);
  double least_share = 1;
  for (const glm::dvec3& x : Around(8e-3, 400)) {
    double least = 1;
    for (const glm::dvec3& p : surface.vertices) least = std::min(least, glm::distance(x, p));
    const double value = std::abs(function.Value(x));
    EXPECT_LE(value, least + kRounding);  // vertices lie on the surface
    if (least > 1e-3) least_share = std::min(least_share, value / least);
  }
  RecordProperty("least_share_of_distance", std::to_string(least_share));
  EXPECT_GT(least_share, 0) << "a share of 0 would stop a ball in free space";
}

TEST(SolidFunction, SlopeIsAtMostOneBetweenAnyTwoPoints) {
  const SolidFunction function(Mixed());
  const std::vector<glm::dvec3> points = Around(8e-3, 4000);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const glm::dvec3 near = points[i] + 0.02 * (points[i - 1] - points[i]);
    EXPECT_LE(std::abs(function.Value(points[i]) - function.Value(near)),
              glm::distance(points[i], near) * (1 + 1e-9) + kRounding);
  }
}

TEST(SolidFunction, GradientIsTheSlopeOfTheValue) {
  const SolidFunction function(Mixed());
  constexpr double kStep = 1e-8;
  int bends = 0;
  for (const glm::dvec3& x : Around(8e-3, 1000)) {
    const SolidSample sample = function.Sample(x);
    EXPECT_EQ(sample.value, function.Value(x));
    glm::dvec3 slope;
    for (int a = 0; a < 3; ++a) {
      glm::dvec3 low = x, high = x;
      low[a] -= kStep, high[a] += kStep;
      slope[a] = (function.Value(high) - function.Value(low)) / (2 * kStep);
    }
    // Rounding of values near 1e-2 m over the step: 1e-10 or so; bends of the function are rare.
    if (glm::distance(slope, sample.gradient) > 1e-4) ++bends;
  }
  EXPECT_LE(bends, 2);
}

TEST(SolidFunction, ABlendBulgesByAQuarterOfItsWidth) {
  const auto value = [](double blend) {
    return SolidFunction(Of({EllipsoidPart{Placed({-1e-3, 0, 0}), glm::dvec3(2e-3)},
                             EllipsoidPart{Placed({1e-3, 0, 0}, SolidJoin::kUnion, blend),
                                           glm::dvec3(2e-3)}}))
        .Value({0, 3e-3, 0});
  };
  EXPECT_NEAR(value(1e-3), value(0) - 0.25e-3, kRounding);
}

TEST(SolidFunction, AGroupJoinsAsItsFirstPartSays) {
  // A ball less the part of a box that lies above a plane.
  const SolidFunction function(
      Of({EllipsoidPart{Placed({0, 0, 0}), glm::dvec3(3e-3)},
          BoxPart{Placed({0, 0, 0}, SolidJoin::kDifference, 0, 1), glm::dvec3(1e-3)},
          PlanePart{Placed({0, 0, 0}, SolidJoin::kIntersection, 0, 2)}}));
  EXPECT_GT(function.Value({0, 0, -5e-4}), 0) << "taken away";
  EXPECT_LT(function.Value({0, 0, 5e-4}), 0) << "above the plane nothing was taken";
}

TEST(SolidFunction, QueriesAllocateNothing) {
  const SolidFunction function(Mixed());
  const std::vector<glm::dvec3> points = Around(8e-3, 1000);
  double sum = 0;
  const long before = test::Allocations();
  for (const glm::dvec3& x : points) sum += function.Value(x) + function.Normal(x).x;
  EXPECT_EQ(test::Allocations(), before);
  EXPECT_TRUE(std::isfinite(sum));
}

// HAP-31
TEST(SolidFunction, IsFiniteOnEveryAxisAndAtEveryCentre) {
  for (const Solid& solid : {Of({EllipsoidPart{Placed({0, 0, 0}), {5e-3, 2e-3, 1e-3}}}),
                             Of({EllipsoidPart{Placed({0, 0, 0}), glm::dvec3(2e-3)}}),
                             Of({CapsulePart{Placed({0, 0, 0}), 6e-3, 1e-3}}),
                             Of({TorusPart{Placed({0, 0, 0}), 4e-3, 1e-3}}),
                             Of({BoxPart{Placed({0, 0, 0}), {3e-3, 2e-3, 1e-3}, 5e-4}})}) {
    const SolidFunction function(solid);
    for (int axis = -1; axis < 3; ++axis)
      for (const double along : {0.0, 1e-3, -1e-3, 4e-3, 2.0, 1e6}) {
        glm::dvec3 x(0.0);
        if (axis >= 0) x[axis] = along;
        EXPECT_TRUE(std::isfinite(function.Value(x))) << along;
        EXPECT_NEAR(glm::length(function.Normal(x)), 1, 1e-9) << along;
      }
  }
  // The centre of a flat ellipsoid is its least radius below the surface.
  EXPECT_NEAR(
      SolidFunction(Of({EllipsoidPart{Placed({0, 0, 0}), {5e-3, 2e-3, 1e-3}}})).Value({0, 0, 0}),
      -1e-3, 1e-9 * 1e-3 * 2);
}

void ExpectRefused(const Solid& solid, const std::string& words) {
  EXPECT_NE(FaultOfSolid(solid).find(words), std::string::npos) << FaultOfSolid(solid);
  EXPECT_THROW(SolidFunction{solid}, Error);
}

// HAP-29
TEST(SolidFunction, UnfitSolidsAreRefusedInWords) {
  const double nan = std::nan("");
  ExpectRefused({}, "no part");
  ExpectRefused(Of({EllipsoidPart{Placed({0, 0, 0}), {1e-3, 0, 1e-3}}}), "more than 0");
  ExpectRefused(Of({EllipsoidPart{Placed({nan, 0, 0}), glm::dvec3(1e-3)}}), "not a number");
  ExpectRefused(Of({EllipsoidPart{Placed({0, 0, 0}), {nan, 1, 1}}}), "more than 0");
  ExpectRefused(Of({BoxPart{Placed({0, 0, 0}), glm::dvec3(1e-3), 2e-3}}), "half of its least");
  ExpectRefused(Of({PlanePart{Placed({0, 0, 0})}}), "no end");
  ExpectRefused(
      Of({EllipsoidPart{Placed({0, 0, 0}), glm::dvec3(1e-3)}, PlanePart{Placed({0, 0, 0})}}),
      "no end");
  ExpectRefused(Of({EllipsoidPart{Placed({0, 0, 0}), glm::dvec3(0.5)}}), "in metres");
  ExpectRefused(Of({EllipsoidPart{Placed({0, 0, 0}, SolidJoin::kDifference), glm::dvec3(1e-3)}}),
                "make it a union");
  ExpectRefused(Of({EllipsoidPart{Placed({0, 0, 0}), glm::dvec3(1e-3)},
                    EllipsoidPart{Placed({1, 0, 0}, SolidJoin::kIntersection), glm::dvec3(1e-3)}}),
                "nothing is left");
  std::vector<SolidPart> deep(kMostSolidParts + 1, EllipsoidPart{});
  ExpectRefused(Of(deep), "make two solids");
  ExpectRefused(Of({EllipsoidPart{}, EllipsoidPart{Placed({0, 0, 0}, SolidJoin::kUnion, 0, 2)}}),
                "rises by one");
  EllipsoidPart too_deep;
  too_deep.place.level = kDeepestSolidLevel + 1;
  ExpectRefused(Of({EllipsoidPart{}, too_deep}), "levels go from 0");
}

TEST(SolidFunction, DeepestNestingIsEvaluated) {
  std::vector<SolidPart> parts;
  for (int level = 0; level <= kDeepestSolidLevel; ++level)
    parts.push_back(
        EllipsoidPart{Placed({5e-4 * level, 0, 0}, SolidJoin::kUnion, 0, level), glm::dvec3(1e-3)});
  const SolidFunction function(Of(parts));
  EXPECT_NEAR(function.Value({5e-4 * kDeepestSolidLevel + 2e-3, 0, 0}), 1e-3, kRounding);
}

TEST(SolidFunction, ScalingScalesValuesAndPlaces) {
  const SolidFunction small(Mixed()), large(Scaled(Mixed(), 2.5));
  for (const glm::dvec3& x : Around(8e-3, 200))
    EXPECT_NEAR(large.Value(2.5 * x), 2.5 * small.Value(x), kRounding);
}

}  // namespace
}  // namespace arthro
