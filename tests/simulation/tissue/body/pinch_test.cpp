// Two tools on one tissue at once: FEM-10.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/simulation/tissue/body/slab_body.h"

namespace arthro::simulation {
namespace {

constexpr glm::dvec3 kLow{-0.008, -0.008, -0.004}, kHigh{0.008, 0.008, 0.0};  // m
constexpr double kThick = 0.004, kEnd = 0.002;                                // m

// Plate of 16 × 16 × 4 mm with 192 T10, fixed around its rim, so that it cannot be squeezed out.
BodySpec Plate() {
  BodySpec spec;
  spec.name = "plate";
  spec.mesh = test::SlabMesh(2, {4, 4, 2}, kLow, kHigh);
  spec.surface = test::BoundaryOf(test::SlabMesh(1, {16, 16, 4}, kLow, kHigh));
  spec.material.young_modulus = 5e5;
  for (double along = kLow.x; along <= kHigh.x + 1e-9; along += 1e-3)
    for (double z = kLow.z; z <= kHigh.z + 1e-9; z += 1e-3)
      for (const glm::dvec3& at : {glm::dvec3(kLow.x, along, z), glm::dvec3(kHigh.x, along, z),
                                   glm::dvec3(along, kLow.y, z), glm::dvec3(along, kHigh.y, z)})
        spec.fixed.push_back({at, 0.8e-3});
  spec.portal_from_body = {glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3))),
                           {0.01, 0.02, 0.03}};
  return spec;
}

// Two round ends of 4 mm, above and below the middle, `gap` apart.
std::array<WorldTool, 2> Jaws(const BodySpec& spec, double gap, bool are_there = true) {
  std::array<WorldTool, 2> jaws;
  for (std::size_t i = 0; i < 2; ++i) {
    jaws[i].shape.kind = ToolKind::kGrasper;
    jaws[i].shape.capsules = {{glm::dvec3(0.0), glm::dvec3(0.0), kEnd}};
    jaws[i].now.is_present = are_there;
    const double side = i == 0 ? 1.0 : -1.0;
    jaws[i].now.portal_from_tool =
        spec.portal_from_body *
        Rigid3{{1, 0, 0, 0}, {0, 0, -0.5 * kThick + side * (kEnd + 0.5 * gap)}};
  }
  return jaws;
}

// Thickness of the skin on the line between the jaws.
double ThicknessBetween(const DeformableBody& body) {
  std::array<double, 2> nearest{1, 1}, z{0, 0};
  for (std::size_t v = 0; v < body.positions().size(); ++v) {
    const double rest = body.skin()->surface.vertices[v].z;
    if (rest != kLow.z && rest != kHigh.z) continue;
    const std::size_t side = rest == kHigh.z ? 0 : 1;
    const glm::dvec3& x = body.positions()[v];
    const double off = std::hypot(x.x, x.y);
    if (off < nearest[side]) nearest[side] = off, z[side] = x.z;
  }
  return z[0] - z[1];
}

TEST(Pinch, Fem10PinchToAFifthForFiveSecondsLeavesNoDamage) {
  const BodySpec spec = Plate();
  BodyOptions options;
  options.contact.stiffness = 2e5;  // rigid jaws: the gap is the tissue's, not the hand's
  DeformableBody body(spec, options);
  const auto step = [&](double gap, bool are_there = true) {
    const std::array<WorldTool, 2> jaws = Jaws(spec, gap, are_there);
    std::array<ToolCoupling, 2> coupling{};
    const BodyReport report = body.Step(jaws, nullptr, test::kFrame, coupling);
    EXPECT_TRUE(report.step.is_finite);
    EXPECT_FALSE(report.was_reset);
    for (const ToolCoupling& of_jaw : coupling) EXPECT_TRUE(IsFinite(of_jaw));
    if (body.WantsSideWork()) {
      body.BeginSideWork();
      body.RunSideWork();
      body.TakeSideWork();
    }
    return report;
  };
  int inverted = 0, iterations = 0;
  const int closing = 30, holding = 300;  // half a second, five seconds
  const double closed = 0.13 * kThick;    // below a fifth: the tissue pushes the jaws apart
  std::vector<double> thick;              // while held
  std::vector<double> jitter;  // motion of a point per step, from one second after closing
  std::vector<glm::dvec3> last;
  for (int i = 1; i <= closing + holding; ++i) {
    const double share = std::min(1.0, static_cast<double>(i) / closing);
    const BodyReport report = step(kThick + share * (closed - kThick));
    inverted = std::max(inverted, report.step.inverted);
    iterations = std::max(iterations, report.step.iterations);
    if (i > closing) thick.push_back(ThicknessBetween(body));
    if (i > closing + 60) {
      double moved = 0;
      for (std::size_t n = 0; n < last.size(); ++n)
        moved = std::max(moved, glm::distance(last[n], body.positions()[n]));
      jitter.push_back(moved);
    }
    last.assign(body.positions().begin(), body.positions().end());
    if (i % 60 == 0)
      std::printf("%.1f s: thickness %.2f of %.0f mm, inverted %d, iterations %d, residual %.1e\n",
                  i * test::kFrame, 1e3 * ThicknessBetween(body), 1e3 * kThick,
                  report.step.inverted, report.step.iterations, report.step.residual);
  }
  std::sort(thick.begin(), thick.end());
  std::printf("thickness while held: %.2f, median %.2f, %.2f mm\n", 1e3 * thick.front(),
              1e3 * thick[thick.size() / 2], 1e3 * thick.back());
  std::sort(jitter.begin(), jitter.end());
  std::printf("a step moves no point by more than %.2e of the thickness, half of them %.2e\n",
              jitter.back() / kThick, jitter[jitter.size() / 2] / kThick);
  EXPECT_LT(jitter.back(), 0.01 * kThick);
  EXPECT_LT(thick.back(), 0.2 * kThick);
  double off = 0;
  int left = 0;
  for (int i = 0; i < 60; ++i) left = step(closed, false).step.inverted;
  for (std::size_t i = 0; i < body.state().x.size(); ++i)
    off = std::max(off, glm::distance(body.state().x[i], spec.mesh.rest_positions[i]));
  const double diagonal = glm::distance(kLow, kHigh);
  std::printf("inverted at most %d, left %d; most iterations %d; 1 s after: %.2e of the diagonal\n",
              inverted, left, iterations, off / diagonal);
  EXPECT_EQ(left, 0);
  EXPECT_LT(off, 1e-3 * diagonal);
}

}  // namespace
}  // namespace arthro::simulation
