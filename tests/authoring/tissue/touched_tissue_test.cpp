// Real tissues under a hand that presses, slides, wedges and jumps: where a step solved the force
// of the tool, the servo's model of it between the steps gives the same force. Meshes that nobody
// here drew show faults that slabs and crescents hide.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include "authoring/tissue/tetrahedra/tetrahedralize.h"
#include "simulation/core/random.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "simulation/tissue/body/tissue_world.h"
#include "tests/simulation/tissue/cut/mesh_boundary.h"
#include "tests/support/build_paths.h"
#include "tests/support/gmsh_outside.h"
#include "tests/support/shared_data.h"
#include "tests/support/ticks.h"

namespace arthro::authoring {
namespace {

using simulation::BodyReport;
using simulation::BodySpec;
using simulation::ToolKind;

using test::kFrame;
constexpr int kSteps = 400;

// Not wedged, contacts have up to twice the friction of their push, and the servo may lose all of
// it [coupling.cpp, kWedged].
constexpr double kFriction = 0.03;
constexpr double kLostShare = 2 * kFriction / (1 - 2 * kFriction);

// Underside held: each node within `reach` of the box's floor along the up axis.
BodySpec HeldBelow(TetMesh mesh, const glm::dvec3& up, double reach) {
  BodySpec spec;
  spec.surface = test::BoundaryOf(mesh);
  double floor = 1e9;
  for (const glm::dvec3& x : mesh.rest_positions) floor = std::min(floor, glm::dot(x, up));
  for (const glm::dvec3& x : mesh.rest_positions)
    if (glm::dot(x, up) < floor + reach) spec.fixed.push_back({x, 1e-5});
  spec.mesh = std::move(mesh);
  spec.material.young_modulus = 5e5;
  return spec;
}

// Visits random places of the skin, each for up to a second: from 1 mm before it to 8 mm into the
// tissue, tilted, sliding aside, with a jump in between.
class PressingHand {
 public:
  PressingHand(std::uint64_t seed, const SurfaceMesh& skin) : random_(seed), skin_(&skin) {}

  simulation::Instrumentation Next() {
    if (left_-- <= 0) Choose();
    const double share = 1.0 - static_cast<double>(left_) / span_;
    const double depth = -0.001 + 0.001 * deepest_ * std::sin(std::numbers::pi * share);
    simulation::Instrumentation hand;
    hand.kind = kind_;
    hand.now.is_present = true;
    hand.now.portal_from_tool = {turn_, at_ + share * slide_ - depth * out_};
    hand.now.opening = 0.5 + 0.5 * std::sin(6 * share);
    return hand;
  }

 private:
  void Choose() {
    const auto& triangle = skin_->triangles[random_.Below(skin_->triangles.size())];
    const glm::dvec3 a = skin_->vertices[static_cast<std::size_t>(triangle[0])],
                     b = skin_->vertices[static_cast<std::size_t>(triangle[1])],
                     c = skin_->vertices[static_cast<std::size_t>(triangle[2])];
    at_ = (a + b + c) / 3.0;
    out_ = glm::normalize(glm::cross(b - a, c - a));
    const glm::dvec3 aside = glm::normalize(b - a);
    slide_ = random_.Uniform(0, 0.004) * aside;
    deepest_ = random_.Uniform(1.5, 9.0);
    const glm::dvec3 z(0, 0, 1);
    const glm::dquat down =
        glm::abs(glm::dot(z, out_)) > 0.999
            ? glm::angleAxis(out_.z > 0 ? std::numbers::pi : 0.0, aside)
            : glm::angleAxis(std::acos(glm::dot(z, -out_)), glm::normalize(glm::cross(z, -out_)));
    turn_ = glm::angleAxis(random_.Uniform(-0.8, 0.8), aside) * down *
            glm::angleAxis(random_.Uniform(-3.0, 3.0), z);
    constexpr ToolKind kKinds[] = {ToolKind::kProbe, ToolKind::kGrasper, ToolKind::kProbe,
                                   ToolKind::kPunch};
    kind_ = kKinds[random_.Below(4)];
    span_ = static_cast<int>(15 + random_.Below(45));
    left_ = span_;
  }

  Random random_;
  const SurfaceMesh* skin_;
  glm::dvec3 at_{0.0}, out_{0, 0, 1}, slide_{0.0};
  glm::dquat turn_{1, 0, 0, 0};
  double deepest_ = 0;
  ToolKind kind_ = ToolKind::kProbe;
  int span_ = 1, left_ = 0;
};

void ExpectTheStepsForce(const std::string& name, const BodySpec& spec) {
  simulation::TissueWorld world({spec}, {}, nullptr, false);
  PressingHand hand(1, spec.surface);
  simulation::WorldPicture picture;
  std::vector<double> share;
  int slips = 0, lost = 0;
  double largest = 0, worst = 0;
  for (int step = 0; step < kSteps; ++step) {
    world.Step(hand.Next(), kFrame);
    world.Show(picture);
    const BodyReport& report = picture.bodies[0].report;
    lost += report.was_reset;
    slips += report.slipped;
    if (report.tool_force <= 0) continue;
    share.push_back(report.servo_error / report.tool_force);
    largest = std::max(largest, report.tool_force);
    worst = std::max(worst, report.servo_error);
  }
  ASSERT_GT(share.size(), kSteps / 4u);
  std::sort(share.begin(), share.end());
  std::printf(
      "%s, %d elements: %zu touched steps, %d slipped, %d lost; force to %.1f N; servo off by %.4f "
      "%% in the median, %.3f %% at p99, %.3f %% and %.3f N at most\n",
      name.c_str(), spec.mesh.ElementCount(), share.size() + static_cast<std::size_t>(slips), slips,
      lost, largest, 100 * share[share.size() / 2], 100 * share[share.size() * 99 / 100],
      100 * share.back(), worst);
  EXPECT_LT(share.back(), kLostShare);
  EXPECT_EQ(lost, 0);
}

// Options for some hundreds of quadratic tetrahedra, as a tissue has that is deformed at display
// rate.
TetrahedralizeOptions Coarse(int max_triangles) {
  TetrahedralizeOptions options;
  options.order = 2;
  options.max_triangles = max_triangles;
  options.radius_edge = 3;
  options.min_dihedral = 0;
  return options;
}

TEST(TouchedTissue, TheServoFeelsWhatTheStepSolvedOnARealMeniscus) {
  ARTHRO_REQUIRE_SHARED(file, "data/meniscus_lateral_tet/lateralMeniscusComputationModelSTP.msh");
  SurfaceMesh surface = test::OutsideOfGmsh(file);
  for (glm::dvec3& x : surface.vertices) x *= 0.02;  // about 1.9 of a unit without a name
  const TetMesh mesh = Tetrahedralize(surface, {}, Coarse(80), nullptr, {}, ARTHRO_PROGRAM);
  ExpectTheStepsForce("lateral meniscus", HeldBelow(mesh, {0, 0, 1}, 0.001));
}

TEST(TouchedTissue, TheServoFeelsWhatTheStepSolvedOnRealCartilage) {
  ARTHRO_REQUIRE_SHARED(file, "data/knee_cartilage_jam/lenhart2015-R-tibia-cartilage.stl");
  TetrahedralizeOptions options = Coarse(200);
  options.thickness = 0.002;
  const SurfaceSource source{file, "m", 1.0, {}};
  const TetMesh mesh =
      Tetrahedralize(ReadSurface(file, 1.0), source, options, nullptr, {}, ARTHRO_PROGRAM);
  ExpectTheStepsForce("tibial cartilage", HeldBelow(mesh, {0, 1, 0}, 0.002));
}

}  // namespace
}  // namespace arthro::authoring
