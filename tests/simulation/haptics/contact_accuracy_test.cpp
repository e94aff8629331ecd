// Force compared with closed forms, with the kernel of the paper for comparison. Targets:
// [benchmarks.md, Haptics].
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/units.h"
#include "simulation/haptics/contact.h"
#include "tests/support/haptics/force_cases.h"

namespace arthro::simulation {
namespace {

using test::AnalyticRelief;
using test::BareContact;
using test::ErrorsOf;
using test::ForceErrors;
using test::kTouchStiffness;
using test::kTouchTick;
using test::PaperForces;
using test::ProxyForces;
using test::StrokeUnder;
using test::TouchStroke;

void Print(const std::string& name, const ForceErrors& e) {
  std::printf("%-44s rms %7.3f %%  angle p99 %7.3f max %7.3f deg  excess step %7.4f N\n",
              name.c_str(), 100 * e.rms, DegreesFromRadians(e.angle_p99),
              DegreesFromRadians(e.angle_max), e.excess_step);
}

ForceErrors ProxyErrors(const Backdrop& backdrop, const DepthMap& map, const TouchStroke& stroke) {
  const DepthField field(backdrop, map);
  return ErrorsOf(ProxyForces({field, {}}, stroke), stroke.reference);
}

ForceErrors PaperErrors(const Backdrop& backdrop, const DepthMap& map, const TouchStroke& stroke) {
  return ErrorsOf(PaperForces(backdrop, map, stroke), stroke.reference);
}

const char* Name(ProjectionType type) {
  return type == ProjectionType::kGnomonic ? "gnomonic" : "equirectangular";
}

class ContactAccuracy : public testing::TestWithParam<ProjectionType> {};

// Checks the foot of the reference, from which the tip was built.
TEST_P(ContactAccuracy, ReferenceIsTheNearestPoint) {
  const AnalyticRelief relief = AnalyticRelief::Waves(GetParam());
  const TouchStroke stroke = StrokeUnder(relief);
  for (std::size_t i = 0; i < stroke.tip.size(); i += 50) {
    const glm::dvec2 found = relief.Nearest(stroke.tip[i], stroke.pixel[i] + glm::dvec2(0.5, -0.4));
    EXPECT_LT(glm::length(relief.Surface(found) - relief.Surface(stroke.pixel[i])), 2e-8);
  }
}

TEST_P(ContactAccuracy, FloatDepthGivesTheExactForce) {
  const AnalyticRelief relief = AnalyticRelief::Waves(GetParam());
  const TouchStroke stroke = StrokeUnder(relief);
  const ForceErrors ours = ProxyErrors(relief.backdrop, relief.Float(), stroke);
  Print(std::string("waves, float, proxy, ") + Name(GetParam()), ours);
  Print(std::string("waves, float, paper's kernel, ") + Name(GetParam()),
        PaperErrors(relief.backdrop, relief.Float(), stroke));
  EXPECT_LT(ours.rms, 0.01);
  EXPECT_LT(DegreesFromRadians(ours.angle_p99), 0.1);
  EXPECT_LT(ours.excess_step, 0.01);
}

TEST_P(ContactAccuracy, EightBitDepthIsSmoothedToTheForce) {
  const AnalyticRelief relief = AnalyticRelief::Waves(GetParam());
  const TouchStroke stroke = StrokeUnder(relief);
  const ForceErrors ours = ProxyErrors(relief.backdrop, relief.EightBit(), stroke);
  Print(std::string("waves, 8 bit, proxy, ") + Name(GetParam()), ours);
  Print(std::string("waves, 8 bit, paper's kernel, ") + Name(GetParam()),
        PaperErrors(relief.backdrop, relief.EightBit(), stroke));
  EXPECT_LT(ours.rms, 0.03);
  EXPECT_LT(DegreesFromRadians(ours.angle_p99), 3.0);
  EXPECT_LT(ours.excess_step, 0.01);
}

// A plane across the joint: n·x = c, so h = D − c/(n·d).
TEST_P(ContactAccuracy, TiltedPlaneGivesItsNormal) {
  const glm::dvec3 n = glm::normalize(glm::dvec3(0.3, -0.2, 1.0));
  AnalyticRelief relief = AnalyticRelief::Make(GetParam(), {});
  const Projection projection = relief.backdrop.projection;
  relief.relief = [=](glm::dvec2 p) {
    return 0.05 - 0.03 / glm::dot(n, DirectionFromPixel(projection, p));
  };
  const ForceErrors ours = ProxyErrors(relief.backdrop, relief.Float(), StrokeUnder(relief));
  Print(std::string("plane, float, proxy, ") + Name(GetParam()), ours);
  EXPECT_LT(ours.rms, 0.01);
  EXPECT_LT(DegreesFromRadians(ours.angle_p99), 0.1);
  EXPECT_LT(ours.excess_step, 0.01);
}

TEST_P(ContactAccuracy, FlatDepthGivesANormalForce) {
  const AnalyticRelief relief = AnalyticRelief::Make(GetParam(), [](glm::dvec2) { return 0.004; });
  const DepthField field(relief.backdrop, relief.Float());
  ContactState state;
  for (double depth : {0.0, 1e-4, 1e-3, 3e-3})
    for (glm::dvec2 p : {glm::dvec2(511.5, 511.5), {200.25, 700.5}, {800.0, 100.75}}) {
      state = {};
      const glm::dvec3 out = DirectionFromPixel(relief.backdrop.projection, p);
      const ContactForce contact = TickContact({field, {}}, BareContact(), kTouchStiffness, {},
                                               (0.046 + depth) * out, kTouchTick, state);
      // Float relief: 0.2 nm; the tolerance of the proxy is 10 nm, 5 µN.
      EXPECT_LT(glm::length(contact.force + kTouchStiffness * depth * out), 1e-5);
      EXPECT_EQ(contact.contact, depth > 0 ? 0 : contact.contact);
    }
}

INSTANTIATE_TEST_SUITE_P(Projections, ContactAccuracy,
                         testing::Values(ProjectionType::kGnomonic,
                                         ProjectionType::kEquirectangular),
                         [](const auto& tested) { return std::string(Name(tested.param)); });

}  // namespace
}  // namespace arthro::simulation
