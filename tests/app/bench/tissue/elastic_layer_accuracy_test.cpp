// How far the closed form of a thin layer is from the same layer in quadratic elements, pressed by
// a ball through contacts: a quarter of a disc, five thicknesses wide, bonded below.
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/tissue/body/elastic_layer.h"
#include "simulation/tissue/solver/implicit_solver.h"
#include "tests/support/tissue/tissue_meshes.h"

namespace arthro::test {
namespace {

using simulation::ContactPoint;

constexpr double kThickness = 3e-3, kRim = 5 * kThickness;
constexpr double kModulus = 1e6;  // Pa

struct PressedLayer {
  TetMesh mesh;
  simulation::FixedAxes fixed;
  std::vector<ContactPoint> contacts;  // on the top near the ball; foot and normal come later
};

// Cells as fine as the expected contact needs. A hole of 3 % of it stands for the axis.
PressedLayer LayerFor(double contact_radius, double depth) {
  const double hole = 0.03 * contact_radius, fine = 1.4 * contact_radius;
  std::vector<double> radius = EvenTicks(hole, fine, 10);
  for (const double r : GradedTicks(fine, kRim, 6, 2.0))
    if (r > fine) radius.push_back(r);
  const double skin = std::min(0.3 * contact_radius, 0.12 * kThickness);
  const double third = kThickness - 6 * skin;
  PressedLayer layer;
  layer.mesh =
      GridMesh(2,
               {radius,
                EvenTicks(0, std::numbers::pi / 2, 2),
                {0, third / 2, third, kThickness - 2.6 * skin, kThickness - skin, kThickness}},
               [](const glm::dvec3& p) {
                 return glm::dvec3(p.x * std::cos(p.y), p.x * std::sin(p.y), p.z);
               });

  constexpr double kNear = 1e-9;
  for (const glm::dvec3& x : layer.mesh.rest_positions) {
    const double r = std::hypot(x.x, x.y);
    std::uint8_t axes = 0;
    if (x.x < kNear) axes |= 1;  // planes of symmetry
    if (x.y < kNear) axes |= 2;
    if (r < hole + kNear) axes |= 3;
    if (x.z < kNear || r > kRim - kNear) axes = 7;
    layer.fixed.push_back(axes);
  }

  // Six points a triangle of the top [Strang & Fix 1973], each with its share of a bed that
  // gives way by about 1e-3 of the depth.
  constexpr int kFaces[4][6] = {
      {0, 1, 2, 4, 5, 6}, {0, 1, 3, 4, 8, 7}, {0, 2, 3, 6, 9, 7}, {1, 2, 3, 5, 9, 8}};
  constexpr double kInner = 0.445948490915965, kOuter = 0.091576213509771;
  constexpr double kInnerWeight = 0.223381589678011, kOuterWeight = 0.109951743655322;
  const auto& x = layer.mesh.rest_positions;
  for (std::size_t e = 0; e < layer.mesh.elements.size(); e += 10)
    for (const auto& face : kFaces) {
      ContactPoint contact;
      contact.count = 6;
      bool is_top = true;
      for (std::size_t k = 0; k < 6; ++k) {
        contact.node[k] = layer.mesh.elements[e + static_cast<std::size_t>(face[k])];
        is_top = is_top && x[static_cast<std::size_t>(contact.node[k])].z > kThickness - kNear;
      }
      const auto at = [&](std::size_t k) { return x[static_cast<std::size_t>(contact.node[k])]; };
      if (!is_top || std::hypot(at(0).x, at(0).y) > 2.2 * contact_radius) continue;
      const double area = 0.5 * glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
      for (std::size_t g = 0; g < 6; ++g) {
        const double side = g < 3 ? kInner : kOuter;
        std::array<double, 3> b{side, side, side};
        b[g % 3] = 1 - 2 * side;
        for (std::size_t k = 0; k < 3; ++k) {
          contact.weight[k] = b[k] * (2 * b[k] - 1);
          contact.weight[3 + k] = 4 * b[k] * b[(k + 1) % 3];
        }
        contact.stiffness = (g < 3 ? kInnerWeight : kOuterWeight) * area * 1000 * kModulus / depth;
        layer.contacts.push_back(contact);
      }
    }
  return layer;
}

// Force of a ball of this radius pressed to `depth`, N.
double ForceInElements(const simulation::Material& material, double radius, double depth,
                       double contact_radius) {
  PressedLayer layer = LayerFor(contact_radius, depth);
  simulation::SolverOptions options;
  options.max_newton = 100;
  options.max_iterations = 3000;
  simulation::ImplicitSolver solver(std::make_shared<simulation::FemModel>(layer.mesh, material),
                                    layer.fixed, options);
  simulation::BodyState state{layer.mesh.rest_positions, {}};
  state.v.assign(state.x.size(), glm::dvec3(0.0));
  const std::vector<glm::dvec3> load(state.x.size(), glm::dvec3(0.0));
  std::vector<simulation::ContactResult> results(layer.contacts.size());
  double force = 0;
  constexpr int kSteps = 5;
  for (int step = 1; step <= kSteps; ++step) {
    const glm::dvec3 centre(0, 0, kThickness + radius - depth * step / kSteps);
    // Each contact is the ball's tangent plane where its point now is: a few rounds settle it.
    for (int round = 0; round < (step == kSteps ? 4 : 1); ++round) {
      for (ContactPoint& contact : layer.contacts) {
        glm::dvec3 place(0.0);
        for (std::size_t k = 0; k < 6; ++k)
          place += contact.weight[k] * state.x[static_cast<std::size_t>(contact.node[k])];
        contact.normal = glm::normalize(place - centre);
        contact.foot = centre + radius * contact.normal;
      }
      const auto report = solver.SolveStatic(state, load, layer.contacts, {}, 1e-6, results);
      EXPECT_TRUE(report.converged) << report.residual;
      force = 0;
      for (const auto& result : results) force -= 4 * result.force.z;  // a quarter is modelled
    }
  }
  return force;
}

TEST(ElasticLayerAccuracy, ABallFeelsTheSameLayerAsInQuadraticElements) {
  // Elements this fine are themselves 1 to 2 % too stiff under a shallow press (half as many: 5 %),
  // hence 5 % there; what grows with the depth is what linear theory leaves out.
  simulation::Material material;
  material.young_modulus = kModulus;
  constexpr struct {
    double nu, ball, share, allowed;
  } kPresses[] = {{0.3, 0.75e-3, 0.1, 0.05}, {0.45, 0.75e-3, 0.2, 0.10}, {0.45, 3e-3, 0.2, 0.10}};
  for (const auto& press : kPresses) {
    material.poisson_ratio = press.nu;
    const simulation::ElasticLayer layer(material, kThickness);
    const double depth = press.share * kThickness;
    const simulation::LayerTouch touch = layer.PressBall(press.ball, depth);
    EXPECT_FALSE(touch.is_deep);
    const double elements = ForceInElements(material, press.ball, depth, touch.contact_radius);
    const double error = touch.force / elements - 1;
    std::printf(
        "[ layer ] nu %.2f, ball %.2f mm, depth %.0f %%: %.4f N, in elements %.4f N, %+.1f %%\n",
        press.nu, press.ball * 1e3, 100 * press.share, touch.force, elements, 100 * error);
    EXPECT_NEAR(error, 0, press.allowed);
  }
}

}  // namespace
}  // namespace arthro::test
