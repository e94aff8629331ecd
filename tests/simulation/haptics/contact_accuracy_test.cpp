// The force against closed forms, with the paper's kernel beside it. Targets: notes on haptics,
// section 9. Friction and viscosity are off: they are not part of the reference.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/haptics/contact.h"
#include "simulation/haptics/paper_kernel.h"
#include "tests/support/analytic_relief.h"

namespace arthro::simulation {
namespace {

using test::AnalyticRelief;

constexpr double kStiffness = 500.0;  // N/m
constexpr double kTick = 0.001;

struct Errors {
  double rms = 0, angle_p99 = 0, angle_max = 0, excess_step = 0;  // share, deg, deg, N
};

Errors Compare(const std::vector<glm::dvec3>& force, const std::vector<glm::dvec3>& reference) {
  Errors errors;
  double error2 = 0, reference2 = 0;
  std::vector<double> angles;
  for (std::size_t i = 0; i < force.size(); ++i) {
    error2 += glm::dot(force[i] - reference[i], force[i] - reference[i]);
    reference2 += glm::dot(reference[i], reference[i]);
    angles.push_back(DegreesFromRadians(std::atan2(glm::length(glm::cross(force[i], reference[i])),
                                                   glm::dot(force[i], reference[i]))));
    if (i > 0)
      errors.excess_step =
          std::max(errors.excess_step, glm::length(force[i] - force[i - 1]) -
                                           glm::length(reference[i] - reference[i - 1]));
  }
  std::sort(angles.begin(), angles.end());
  errors.rms = std::sqrt(error2 / reference2);
  errors.angle_p99 = angles[angles.size() * 99 / 100];
  errors.angle_max = angles.back();
  return errors;
}

void Print(const std::string& name, const Errors& e) {
  std::printf("%-44s rms %7.3f %%  angle p99 %7.3f max %7.3f deg  excess step %7.4f N\n",
              name.c_str(), 100 * e.rms, e.angle_p99, e.angle_max, e.excess_step);
}

struct Stroke {
  std::vector<glm::dvec3> tip, reference;
  std::vector<glm::dvec2> pixel;
};

// 4 s of a wandering stroke at 10 to 25 mm/s, 1 mm ± 0.3 mm under the exact surface.
Stroke StrokeUnder(const AnalyticRelief& relief) {
  Stroke stroke;
  for (int i = 0; i < 4000; ++i) {
    const double t = i * kTick;
    const glm::dvec2 p(511.5 + 250 * std::sin(1.1 * t) + 20 * std::sin(7 * t),
                       511.5 + 240 * std::sin(1.7 * t + 0.4));
    const double depth = 1e-3 + 0.3e-3 * std::sin(5 * t);
    const glm::dvec3 normal = relief.Normal(p);
    stroke.pixel.push_back(p);
    stroke.tip.push_back(relief.Surface(p) - depth * normal);
    stroke.reference.push_back(kStiffness * depth * normal);
  }
  return stroke;
}

ContactOptions Bare() {
  ContactOptions options;
  options.stiffness = kStiffness;
  options.damping = options.static_friction = options.sliding_friction = 0.0;
  return options;
}

Errors ProxyErrors(const Backdrop& backdrop, const DepthMap& map, const Stroke& stroke) {
  const DepthField field(backdrop, map);
  ContactState state;
  std::vector<glm::dvec3> force;
  for (const glm::dvec3& tip : stroke.tip)
    force.push_back(TickContact({field, {}}, Bare(), kStiffness, {}, tip, kTick, state).force);
  // The first tick starts at the portal; the stroke begins when the proxy has settled.
  const auto skip = [](const std::vector<glm::dvec3>& all) {
    return std::vector<glm::dvec3>(all.begin() + 100, all.end());
  };
  return Compare(skip(force), skip(stroke.reference));
}

Errors PaperErrors(const Backdrop& backdrop, const DepthMap& map, const Stroke& stroke) {
  std::vector<glm::dvec3> force;
  for (const glm::dvec3& tip : stroke.tip) {
    const FieldQuery query = PaperQuery(backdrop, map, tip);
    force.push_back(kStiffness * std::max(0.0, -query.clearance) * query.weight * query.normal);
  }
  return Compare(force, stroke.reference);
}

const char* Name(ProjectionType type) {
  return type == ProjectionType::kGnomonic ? "gnomonic" : "equirectangular";
}

class ContactAccuracy : public testing::TestWithParam<ProjectionType> {};

// The foot of the reference is right: the tip was built from it.
TEST_P(ContactAccuracy, ReferenceIsTheNearestPoint) {
  const AnalyticRelief relief = AnalyticRelief::Waves(GetParam());
  const Stroke stroke = StrokeUnder(relief);
  for (std::size_t i = 0; i < stroke.tip.size(); i += 50) {
    const glm::dvec2 found = relief.Nearest(stroke.tip[i], stroke.pixel[i] + glm::dvec2(0.5, -0.4));
    EXPECT_LT(glm::length(relief.Surface(found) - relief.Surface(stroke.pixel[i])), 2e-8);
  }
}

TEST_P(ContactAccuracy, FloatDepthGivesTheExactForce) {
  const AnalyticRelief relief = AnalyticRelief::Waves(GetParam());
  const Stroke stroke = StrokeUnder(relief);
  const Errors ours = ProxyErrors(relief.backdrop, relief.Float(), stroke);
  Print(std::string("waves, float, proxy, ") + Name(GetParam()), ours);
  Print(std::string("waves, float, paper's kernel, ") + Name(GetParam()),
        PaperErrors(relief.backdrop, relief.Float(), stroke));
  EXPECT_LT(ours.rms, 0.01);
  EXPECT_LT(ours.angle_p99, 0.1);
  EXPECT_LT(ours.excess_step, 0.01);
}

TEST_P(ContactAccuracy, EightBitDepthIsSmoothedToTheForce) {
  const AnalyticRelief relief = AnalyticRelief::Waves(GetParam());
  const Stroke stroke = StrokeUnder(relief);
  const Errors ours = ProxyErrors(relief.backdrop, relief.EightBit(), stroke);
  Print(std::string("waves, 8 bit, proxy, ") + Name(GetParam()), ours);
  Print(std::string("waves, 8 bit, paper's kernel, ") + Name(GetParam()),
        PaperErrors(relief.backdrop, relief.EightBit(), stroke));
  EXPECT_LT(ours.rms, 0.03);
  EXPECT_LT(ours.angle_p99, 3.0);
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
  const Errors ours = ProxyErrors(relief.backdrop, relief.Float(), StrokeUnder(relief));
  Print(std::string("plane, float, proxy, ") + Name(GetParam()), ours);
  EXPECT_LT(ours.rms, 0.01);
  EXPECT_LT(ours.angle_p99, 0.1);
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
      const ContactForce contact =
          TickContact({field, {}}, Bare(), kStiffness, {}, (0.046 + depth) * out, kTick, state);
      // Float relief: 0.2 nm; the proxy's own tolerance is 10 nm, 5 µN.
      EXPECT_LT(glm::length(contact.force + kStiffness * depth * out), 1e-5);
      EXPECT_EQ(contact.contact, depth > 0 ? 0 : contact.contact);
    }
}

INSTANTIATE_TEST_SUITE_P(Projections, ContactAccuracy,
                         testing::Values(ProjectionType::kGnomonic,
                                         ProjectionType::kEquirectangular),
                         [](const auto& tested) { return std::string(Name(tested.param)); });

}  // namespace
}  // namespace arthro::simulation
