#include "simulation/haptics/relief/depth_field.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/support/haptics/analytic_relief.h"
#include "tests/support/haptics/paper_kernel.h"

namespace arthro::simulation {
namespace {

using test::AnalyticRelief;
using test::PaperQuery;

class DepthFieldIn : public testing::TestWithParam<ProjectionType> {};

// Near the surface the clearance is the distance to the exact one, and on it the normals agree.
TEST_P(DepthFieldIn, ClearanceAndNormalAreThoseOfTheExactSurface) {
  const AnalyticRelief relief = AnalyticRelief::Waves(GetParam());
  const DepthField field(relief.backdrop, relief.Float());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(100, 900), height(-2e-5, 2e-5);
  double worst_height = 0;
  std::vector<double> angles;
  for (int i = 0; i < 3000; ++i) {
    const glm::dvec2 p(any(random), any(random));
    const double h = height(random);
    const glm::dvec3 normal = relief.Normal(p);
    const FieldQuery query = field.Query(relief.Surface(p) + h * normal);
    EXPECT_NEAR(query.weight, 1.0, 1e-6);
    worst_height = std::max(worst_height, std::abs(query.clearance - h));
    const glm::dvec3 at_foot = field.Query(relief.Surface(p)).normal;
    angles.push_back(glm::length(at_foot - normal));
  }
  std::sort(angles.begin(), angles.end());
  const double p99 = DegreesFromRadians(angles[angles.size() * 99 / 100]);
  std::printf("clearance off by %.2f µm at worst, normal by %.3f deg (p99), %.3f deg (max)\n",
              1e6 * worst_height, p99, DegreesFromRadians(angles.back()));
  // Two passes blur by σ² = 1 px² and interpolation by 1/4: ½ · 1.25 · |∇²h|, where ∇²h of the
  // waves is below 1.15e-6 m/px².
  EXPECT_LT(worst_height, 0.72e-6);
  EXPECT_LT(p99, 0.1);
}

// A motion of 1 µm turns the normal by no more than the curvature: there are no jumps at pixels.
TEST_P(DepthFieldIn, NormalIsContinuousAcrossPixels) {
  const AnalyticRelief relief = AnalyticRelief::Waves(GetParam());
  const DepthMap map = relief.EightBit();
  const DepthField field(relief.backdrop, map);
  double ours = 0, paper = 0;
  glm::dvec3 last(0.0), last_paper(0.0);
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 x =
        0.0465 * DirectionFromPixel(relief.backdrop.projection, {300 + 0.02 * i, 400 + 0.003 * i});
    const glm::dvec3 normal = field.Query(x).normal;
    const glm::dvec3 kernel = PaperQuery(relief.backdrop, map, x).normal;
    if (i > 0) {
      ours = std::max(ours, glm::length(normal - last));
      paper = std::max(paper, glm::length(kernel - last_paper));
    }
    last = normal;
    last_paper = kernel;
  }
  std::printf("8 bit, 1 µm apart: normal turns by %.4f deg, the paper's kernel by %.2f deg\n",
              DegreesFromRadians(ours), DegreesFromRadians(paper));
  EXPECT_LT(DegreesFromRadians(ours), 0.1);
  EXPECT_GT(paper, ours);
}

TEST_P(DepthFieldIn, GivesNoContactOutsideTheImagedRegion) {
  const AnalyticRelief relief = AnalyticRelief::Make(GetParam(), [](glm::dvec2) { return 0.004; });
  const DepthField field(relief.backdrop, relief.Float());
  const Projection& projection = relief.backdrop.projection;
  for (glm::dvec2 outside : {glm::dvec2(-1, 500), {1024, 500}, {500, -0.01}, {500, 1023.01}})
    EXPECT_EQ(field.Query(0.06 * DirectionFromPixel(projection, outside)).weight, 0.0);
  EXPECT_EQ(field.Query({0, 0, -0.06}).weight, 0.0) << "behind";
  EXPECT_EQ(field.Query({0, 0, 0}).weight, 0.0);
  for (double bad :
       {std::numeric_limits<double>::quiet_NaN(), 1e300, std::numeric_limits<double>::infinity()})
    EXPECT_TRUE(std::isfinite(field.Query({bad, 0, 0.05}).weight));
  // The weight rises continuously from the border over the width of the fade.
  double last = 0;
  for (double x = 0; x < 20; x += 0.05) {
    const double weight = field.Query(0.045 * DirectionFromPixel(projection, {x, 500})).weight;
    EXPECT_GE(weight, last);
    EXPECT_LT(weight - last, 0.02);
    last = weight;
  }
  EXPECT_NEAR(last, 1.0, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Projections, DepthFieldIn,
                         testing::Values(ProjectionType::kGnomonic,
                                         ProjectionType::kEquirectangular),
                         [](const auto& tested) {
                           return tested.param == ProjectionType::kGnomonic ? "gnomonic"
                                                                            : "equirectangular";
                         });

TEST(DepthField, HolesNeitherPullNorSpread) {
  const AnalyticRelief relief =
      AnalyticRelief::Make(ProjectionType::kGnomonic, [](glm::dvec2) { return 0.004; });
  DepthMap map = relief.Float();
  for (int y = 400; y < 420; ++y)
    for (int x = 400; x < 420; ++x) map.at(x, y) = std::numeric_limits<float>::quiet_NaN();
  const DepthField field(relief.backdrop, map);
  const auto at = [&](double x, double y) {
    return field.Query(0.046 * DirectionFromPixel(relief.backdrop.projection, {x, y}));
  };
  EXPECT_EQ(at(410, 410).weight, 0.0);
  EXPECT_EQ(at(399.5, 410).weight, 0.0);
  EXPECT_NEAR(at(380, 410).weight, 1.0, 1e-6);
  for (double x = 380; x < 400; x += 0.25) {
    const FieldQuery query = at(x, 410.3);
    EXPECT_TRUE(std::isfinite(query.clearance));
    if (query.weight > 0) {
      EXPECT_NEAR(query.clearance, 0.0, 1e-8) << x;
    }
  }
}

TEST(DepthField, TheBareSphereIsInContactWithinThePicture) {
  const AnalyticRelief relief = AnalyticRelief::Make(ProjectionType::kEquirectangular, {});
  const DepthField field(relief.backdrop, 1024, 1024);
  const glm::dvec3 out = glm::normalize(glm::dvec3(0.1, 0.2, 1.0));
  const FieldQuery query = field.Query(0.051 * out);
  EXPECT_NEAR(query.clearance, -0.001, 1e-15);
  EXPECT_LT(glm::length(query.normal + out), 1e-15);
  EXPECT_EQ(query.weight, 1.0);
  EXPECT_EQ(field.Query({0, 0.05, 0}).weight, 0.0) << "above the picture";
  EXPECT_EQ(field.free_radius(), 0.05);
}

TEST(DepthField, WithoutAPictureThereIsNoField) {
  EXPECT_TRUE(DepthField().empty());
  EXPECT_TRUE(DepthField(Backdrop{}, 0, 0).empty());
  EXPECT_TRUE(DepthField(Backdrop{}, DepthMap()).empty());
  EXPECT_EQ(DepthField().Query({0, 0, 0.05}).weight, 0.0);
}

TEST(DepthField, DistinguishesAQuantisedFromASmoothMap) {
  const AnalyticRelief relief = AnalyticRelief::Waves(ProjectionType::kGnomonic);
  EXPECT_NEAR(QuantumOf(relief.EightBit()), 0.007 / 255, 1e-8);
  EXPECT_LT(QuantumOf(relief.Float()), 1e-7);
  EXPECT_EQ(QuantumOf(DepthMap(64, 64, 0.004f)), 0.0) << "a plane has no steps";
}

}  // namespace
}  // namespace arthro::simulation
