// Whole instrument on thin layers, compared with an independent boundary-element solution of the
// contact problem.
#include "simulation/tissue/body/tool_on_layers.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include <Eigen/Dense>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/units.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/shapes.h"

namespace arthro::simulation {
namespace {

constexpr double kPi = std::numbers::pi, kSpring = 500.0;
constexpr double kThick = 2.5 * kMm, kNu = 0.45, kE = 1.5e6;

ElasticLayer Cartilage() {
  Material material;
  material.young_modulus = kE;
  material.poisson_ratio = kNu;
  return {material, kThick};
}

// Surface displacement at r under pressure 1 on a disc of radius b on a bonded layer. Hankel:
// (1−ν)/μ b ∫ M(ξh) J₁(ξb) J₀(ξr)/ξ dξ, M of Jaffar 1989. 1 − M falls like exp(−2 ξh). For the
// rest, the half space, elliptic integrals give the mean over the disc and the far field accurately
// enough.
double DiscOnLayer(double b, double r) {
  const double kappa = 3 - 4 * kNu, mu = kE / 2 / (1 + kNu);
  const auto less = [&](double k) {
    const double e = std::exp(-2 * k);
    return (kappa * (1 - e * e) - 4 * k * e) /
               (kappa * (1 + e * e) + (kappa * kappa + 1 + 4 * k * k) * e) -
           1;
  };
  constexpr int kPoints = 600;
  const double end = 12.0 / kThick, step = end / kPoints;
  double sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double xi = (i + 0.5) * step;
    sum += step * less(xi * kThick) * ::j1(xi * b) * ::j0(xi * r) / xi;
  }
  const double k = r < b ? r / b : b / r;
  const double half_space =
      r < b
          ? 2 / kPi * std::comp_ellint_2(k)
          : 2 / kPi * (r / b) *
                (std::comp_ellint_2(k) - (1 - k * k) * std::comp_ellint_1(std::min(k, 1 - 1e-12)));
  return (1 - kNu) / mu * b * (half_space + sum);
}

// Force of a capsule whose near end is lowest, `depth` below the surface, and that rises by `tilt`.
// Uses square pressure elements; elements in tension are removed one after the other.
double ForceByElements(double radius, double length, double depth, double tilt, double cell) {
  std::vector<std::array<double, 3>> at;  // x, y, depth of the capsule there
  const double end = tilt > 0 ? std::min(length, depth / std::sin(tilt)) : length;
  for (double x = -1.1 * radius + cell / 2; x < end + 1.1 * radius; x += cell)
    for (double y = cell / 2; y < radius; y += cell) {  // one half, because it is even in y
      double deepest = 0;
      for (int i = 0; i <= 400; ++i) {
        const double s = length * i / 400, off = x - s * std::cos(tilt);
        const double left = radius * radius - off * off - y * y;
        if (left > 0)
          deepest = std::max(deepest, depth - radius - s * std::sin(tilt) + std::sqrt(left));
      }
      if (deepest > 0) at.push_back({x, y, deepest});
    }
  const double disc = cell / std::sqrt(kPi);
  constexpr int kTable = 300;
  const double reach = std::hypot(end + 2.2 * radius, 2 * radius);
  std::vector<double> table;
  for (int i = 0; i <= kTable; ++i) table.push_back(DiscOnLayer(disc, reach * i / kTable));
  const auto between = [&](double r) {
    if (r < 3 * cell) return DiscOnLayer(disc, r);
    const double place = std::min(r / reach * kTable, kTable - 1e-9);
    const auto i = static_cast<std::size_t>(place);
    const double t = place - static_cast<double>(i);
    return (1 - t) * table[i] + t * table[i + 1];
  };
  std::vector<std::size_t> touching(at.size());
  for (std::size_t i = 0; i < at.size(); ++i) touching[i] = i;
  for (;;) {
    const auto n = static_cast<Eigen::Index>(touching.size());
    Eigen::MatrixXd a(n, n);
    Eigen::VectorXd u(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto& p = at[touching[static_cast<std::size_t>(i)]];
      u[i] = p[2];
      for (Eigen::Index j = 0; j < n; ++j) {
        const auto& q = at[touching[static_cast<std::size_t>(j)]];
        a(i, j) = between(std::hypot(p[0] - q[0], p[1] - q[1])) +
                  between(std::hypot(p[0] - q[0], p[1] + q[1]));
      }
    }
    const Eigen::VectorXd p = a.partialPivLu().solve(u);
    std::vector<std::size_t> pushing;
    for (Eigen::Index i = 0; i < n; ++i)
      if (p[i] >= 0) pushing.push_back(touching[static_cast<std::size_t>(i)]);
    if (pushing.size() == touching.size()) return 2 * p.sum() * cell * cell;
    touching = std::move(pushing);
  }
}

// Slab with its top at z = 0, much larger than the contact. Its tool comes from +z.
LayerUnder Slab() {
  return {
      test::Box({-30 * kMm, -30 * kMm, -12 * kMm}, {30 * kMm, 30 * kMm, 0}), {}, Cartilage(), 3};
}

// Force of the closed forms for one capsule on the slab.
double ForceByLaw(const LayerUnder& slab, double radius, double length, double depth, double tilt) {
  const glm::dvec3 along(std::cos(tilt), 0, std::sin(tilt));
  const std::array<Capsule, 1> tool{Capsule{{0, 0, 0}, length * along, radius}};
  return ComputeLayerForce({&slab, 1}, tool, {0, 0, radius - depth}).force.z;
}

TEST(ToolOnLayers, RodForceAgreesWithBoundaryElementsAtAllTilts) {
  const LayerUnder slab = Slab();
  double worst = 0;
  for (const auto& [radius, length, depth, degrees] :
       std::vector<std::array<double, 4>>{{0.5, 5.5, 0.05, 0},
                                          {0.5, 5.5, 0.2, 0},
                                          {0.5, 5.5, 0.2, 1},
                                          {0.5, 5.5, 0.2, 3},
                                          {0.5, 5.5, 0.2, 10},
                                          {0.5, 5.5, 0.2, 30},
                                          {0.5, 5.5, 0.2, 89.9},
                                          {0.75, 1.9, 0.1, 0},
                                          {0.75, 1.9, 0.3, 0},
                                          {0.75, 1.9, 0.3, 15}}) {
    const double tilt = degrees * kPi / 180;
    const double exact =
        ForceByElements(radius * kMm, length * kMm, depth * kMm, tilt, 0.12 * radius * kMm);
    const double law = ForceByLaw(slab, radius * kMm, length * kMm, depth * kMm, tilt);
    worst = std::max(worst, std::abs(law / exact - 1));
    std::printf(
        "[ layer ] rod %.2f x %.1f mm, %.2f mm deep, rising by %4.1f: %.4f N, law %.4f N, "
        "%+.1f %%\n",
        radius, length, depth, degrees, exact, law, 100 * (law / exact - 1));
  }
  EXPECT_LT(worst, 0.1) << "error of linear theory at a fifth of the thickness";
}

// Basket punch over a condyle, half open: many capsules, side by side and one behind the other.
std::vector<Capsule> PunchAt(const glm::dquat& turn, double opening) {
  ToolInput input;
  input.is_present = true;
  input.opening = opening;
  input.portal_from_tool.rotation = turn;
  std::array<Capsule, kMaxCapsules> capsules;
  const int count = PosedCapsules(ShapeOf(ToolKind::kPunch), input, capsules);
  return {capsules.begin(), capsules.begin() + count};
}
LayerUnder Condyle() { return {test::Sphere({0, 0, -18 * kMm}, 18 * kMm, 5), {}, Cartilage(), 0}; }
// Punch along +x with its jaws over the top of the condyle, nose down by `tilt`, rolled by `roll`.
glm::dquat Lying(double tilt, double roll) {
  return glm::angleAxis(kPi / 2 + tilt, glm::dvec3(0, 1, 0)) *
         glm::angleAxis(roll, glm::dvec3(0, 0, 1));
}

TEST(ToolOnLayers, ForceIsContinuousAcrossParts) {
  const LayerUnder condyle = Condyle();
  double tilting = 0, rolling = 0, sliding = 0, least = 1e9, most = 0;
  const auto sweep = [&](double& largest, auto&& pose, int steps) {
    glm::dvec3 before(0, 0, 20 * kMm), last(0.0);
    for (int i = 0; i < steps; ++i) {
      const auto [turn, hand] = pose(i);
      const LayerHold hold =
          HoldOnLayers({&condyle, 1}, PunchAt(turn, 0.4), hand, before, kSpring, 0.02);
      before = hold.tip;
      const double force = glm::length(hold.force);
      if (i > 0) {
        largest = std::max(largest, glm::distance(hold.force, last));
        least = std::min(least, force);
        most = std::max(most, force);
      }
      last = hold.force;
    }
  };
  // Steps of 0.01° from nose down to heel down, about the middle of the jaws, and all around in
  // roll; steps of 1 µm across.
  const auto hand_of = [](const glm::dquat& turn, const glm::dvec3& jaws) {
    return jaws - turn * glm::dvec3(0, 0, -4 * kMm);
  };
  constexpr double kStep = kPi / 18000;
  sweep(
      tilting,
      [&](int i) {
        const glm::dquat turn = Lying(0.5 - kStep * i, 0.3);
        return std::pair{turn, hand_of(turn, {0, 0, 0})};
      },
      6000);
  sweep(
      rolling,
      [&](int i) {
        const glm::dquat turn = Lying(0.1, kStep * i);
        return std::pair{turn, hand_of(turn, {0, 0, 0})};
      },
      36000);
  sweep(
      sliding,
      [&](int i) {
        const glm::dquat turn = Lying(0.1, 0.3);
        return std::pair{turn, hand_of(turn, {-6 * kMm + 1e-6 * i, 1e-3, 0})};
      },
      12000);
  std::printf(
      "[ layer ] largest step of force: %.4f N in 0.01 degrees of tilt, %.4f N of roll, "
      "%.4f N in 1 um; forces of %.2f to %.2f N\n",
      tilting, rolling, sliding, least, most);
  EXPECT_LT(tilting, 0.01);
  EXPECT_LT(rolling, 0.01);
  EXPECT_LT(sliding, 0.01);
  EXPECT_GT(most, 0.5);
}

TEST(ToolOnLayers, SpringAndLayersBalanceWithinTheReportedDepth) {
  const LayerUnder condyle = Condyle();
  for (const double deep : {0.2, 1.0, 3.0, 6.0, 10.0})
    for (const double tilt : {-0.4, 0.0, 0.3, 1.2}) {
      const std::vector<Capsule> tool = PunchAt(Lying(tilt, 0.2), 0.0);
      const glm::dvec3 start(2 * kMm, 0, 12 * kMm), hand(2 * kMm, 0, -deep * kMm);
      LayerHold hold;
      hold.tip = start;
      for (int tick = 0; tick < 60; ++tick)
        hold = HoldOnLayers({&condyle, 1}, tool, hand, hold.tip, kSpring, 0.0);
      ASSERT_EQ(hold.tissue, 0) << deep << " " << tilt;
      const LayerForce force = ComputeLayerForce({&condyle, 1}, tool, hold.tip);
      // Pushed harder than a device can (3.3 N at 6.6 mm), it may rest where two cells of the
      // distance field meet. Their normals differ, so there is no exact balance.
      const double off = deep < 6.6 ? 1e-5 : 5e-3 * glm::length(hold.force);
      EXPECT_LT(glm::distance(hold.force, force.force), off) << deep << " " << tilt;
      EXPECT_NEAR(glm::length(hold.force - kSpring * (hold.tip - hand)), 0.0, 1e-12);
      EXPECT_LT(hold.depth, kThick) << "not beyond the bone";
      for (const Capsule& c : tool)
        for (int i = 0; i <= 50; ++i) {
          const glm::dvec3 x = hold.tip + c.a + i / 50.0 * (c.b - c.a);
          if (glm::distance(x, hold.tip) > 0.03) continue;
          EXPECT_LT(c.radius - condyle.solid.Distance(x), hold.depth + 0.05 * kMm);
        }
    }
}

TEST(ToolOnLayers, ToolThatAppearsBehindAThinSheetIsHeldInFront) {
  const LayerUnder sheet{
      test::Box({-9 * kMm, -9 * kMm, -2 * kMm}, {9 * kMm, 9 * kMm, 0}), {}, Cartilage(), 0};
  std::array<Capsule, kMaxCapsules> capsules;
  ToolInput input;
  input.is_present = true;
  input.portal_from_tool.rotation = glm::angleAxis(kPi, glm::dvec3(1, 0, 0));  // its +z points down
  const int count = PosedCapsules(ShapeOf(ToolKind::kProbe), input, capsules);
  const std::span<const Capsule> probe(capsules.data(), static_cast<std::size_t>(count));
  glm::dvec3 tip(0, 0, 60 * kMm);
  for (int tick = 0; tick < 20; ++tick)
    tip = HoldOnLayers({&sheet, 1}, probe, {0, 0, -20 * kMm}, tip, kSpring, 0.02).tip;
  EXPECT_GT(tip.z, -2 * kMm);
  EXPECT_LT(tip.z, 0);
  // Released, it is free at once.
  const LayerHold free = HoldOnLayers({&sheet, 1}, probe, {0, 0, 1 * kMm}, tip, kSpring, 0.02);
  EXPECT_EQ(free.tissue, -1);
  EXPECT_EQ(free.force, glm::dvec3(0.0));
  EXPECT_EQ(free.tip, glm::dvec3(0, 0, 1 * kMm));
}

TEST(ToolOnLayers, HoldAllocatesNothingInBoundedTime) {
  const LayerUnder condyle = Condyle();
  const std::vector<Capsule> tool = PunchAt(Lying(0.0, 0.1), 0.0);
  glm::dvec3 tip(2 * kMm, 0, 5 * kMm);
  std::vector<double> micros;
  micros.reserve(2000);
  const long before = test::Allocations();
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 hand(2 * kMm, 0, -2 * kMm * std::sin(0.01 * i));
    const auto start = std::chrono::steady_clock::now();
    tip = HoldOnLayers({&condyle, 1}, tool, hand, tip, kSpring, 0.02).tip;
    micros.push_back(
        std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start)
            .count());
  }
  EXPECT_EQ(test::Allocations(), before);
  std::ranges::sort(micros);
  std::printf("[ layer ] a punch on a condyle: median %.1f us, p99 %.1f us, most %.1f us\n",
              micros[1000], micros[1980], micros.back());
  const LayerHold nowhere =
      HoldOnLayers({&condyle, 1}, tool, glm::dvec3(std::nan("")), tip, kSpring, 0.02);
  EXPECT_EQ(nowhere.tissue, -1);
}

}  // namespace
}  // namespace arthro::simulation
