#include "simulation/tissue/cut/cutters.h"

#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "simulation/core/process_cost.h"
#include "simulation/core/units.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "simulation/tissue/field/pieces.h"
#include "tests/support/build_paths.h"
#include "tests/support/shapes.h"

namespace arthro::simulation {
namespace {

constexpr double kPi = std::numbers::pi;

// Block of 12 × 8 × 4 mm with its top at z = 0.
SolidField Block(double spacing = 0.3 * kMm) {
  return SolidField::FromSurface(test::Box(glm::dvec3(-6, -4, -4) * kMm, glm::dvec3(6, 4, 0) * kMm),
                                 spacing);
}
bool Undeformed(const glm::dvec3& rest, glm::dvec3& place) {
  place = rest;
  return true;
}
std::vector<Cut> SomeCuts() {
  BoxCut punch;
  punch.rest_from_box.translation = glm::dvec3(3, 0, 0) * kMm;
  punch.rest_from_box.rotation = glm::angleAxis(0.4, glm::dvec3(0, 0, 1));
  punch.half = glm::dvec3(1.5, 1, 1) * kMm;
  return {
      CapsuleCut{glm::dvec3(-4, -1, 0) * kMm, glm::dvec3(-4, 1, 0) * kMm, 1.5 * kMm}, punch,
      TearCut{{glm::dvec3(-1, -2, 0) * kMm, glm::dvec3(0, 0, 0) * kMm, glm::dvec3(0, 3, 0) * kMm},
              {0, 0, -1},
              2 * kMm,
              0.6 * kMm,
              1 * kMm}};
}

TEST(Cutters, CutsRemoveTheirClosedFormVolumes) {
  const auto expect = [](const char* name, double got, double truth, double tolerance) {
    std::printf("%-22s removes %7.3f mm3, closed form %7.3f\n", name, got / kMm3, truth / kMm3);
    EXPECT_NEAR(got, truth, tolerance * truth) << name;
  };
  SolidField field = Block();
  const std::vector<Cut> cuts = SomeCuts();
  // Half a capsule; a box half in the block; a slot of two straight pieces with round ends and a
  // round bottom. Edges are rounded by at most 0.25 h² per length: 2 to 6 % of such small cuts.
  expect("half a capsule", Apply(field, cuts[0]).removed,
         (kPi * 1.5 * 1.5 * 2 + 4.0 / 3.0 * kPi * 1.5 * 1.5 * 1.5) / 2 * kMm3, 0.03);
  expect("half a box", Apply(field, cuts[1]).removed, 3 * 2 * 1 * kMm3, 0.06);
  const double length = std::sqrt(5.0) + 3;
  expect("a tear", Apply(field, cuts[2]).removed,
         (length * (2 * 0.6 + kPi * 0.09 / 2) + kPi * 0.09 * 2) * kMm3, 0.06);
}

// A slot narrower than the grid can separate is widened to the minimum.
TEST(Cutters, TearOfZeroWidthSeparatesAtAnyPositionAndAngle) {
  for (const double slant : {0.0, 0.3, 1.0})
    for (const double shift : {0.0, 0.07, 0.15, 0.22}) {
      SolidField field = Block();
      Apply(field, TearCut{{glm::dvec3(shift - 5 * slant, -5, 0) * kMm,
                            glm::dvec3(shift + 5 * slant, 5, 0) * kMm},
                           {0, 0, -1},
                           5 * kMm,
                           0.01 * kMm,
                           1 * kMm});
      EXPECT_EQ(PiecesOf(field).count(), 2) << slant << " " << shift;
    }
}

TEST(Cutters, UndoEqualsTheOriginalWithOneCutLess) {
  const SolidField original = Block();
  const std::vector<Cut> cuts = SomeCuts();
  SolidField two = original;
  Apply(two, cuts[0]);
  Apply(two, cuts[1]);
  const SolidField undone = CutAll(original, std::span(cuts).first(2));
  ASSERT_EQ(undone.values().size(), two.values().size());
  EXPECT_TRUE(std::equal(undone.values().begin(), undone.values().end(), two.values().begin()));
  EXPECT_EQ(undone.Volume(), two.Volume());
  EXPECT_EQ(CutAll(original, {}).Volume(), original.Volume());
}

// A reset computes no node of the field; it only copies.
TEST(Cutters, ResetAfter30BitesCopiesTheOriginal) {
  const SolidField original = SolidField::FromSurface(
      ReadSurface(ARTHRO_SOURCE_DIR "/resources/demo/meniscus.ply", 1.0), 0.35 * kMm);
  const Box3 box = original.box();
  std::vector<Cut> cuts;
  for (int i = 0; i < 30; ++i) {
    const glm::dvec3 at = box.low + (box.high - box.low) * glm::dvec3(0.5, i / 30.0, 0.5);
    cuts.emplace_back(CapsuleCut{at, at + glm::dvec3(5 * kMm, 0, 0), 1 * kMm});
  }
  SolidField field = CutAll(original, cuts);
  EXPECT_LT(field.Volume(), original.Volume());
  const double start = ThreadCpuMs();
  field = original;
  const double reset = ThreadCpuMs() - start;
  const double again = ThreadCpuMs();
  const SolidField undone = CutAll(original, std::span(cuts).first(29));
  std::printf("reset %.2f ms; undo of the last of 30 cuts %.1f ms\n", reset, ThreadCpuMs() - again);
  EXPECT_EQ(field.Volume(), original.Volume());
  EXPECT_EQ(field.version(), original.version());
  EXPECT_FALSE(field.MayBeCut(field.box()));
}

// In bent tissue the tool cuts what is inside it now, which is another shape at rest.
TEST(Cutters, ToolInDeformedTissueRemovesPointsInsideItNow) {
  const auto bend = [](const glm::dvec3& rest, glm::dvec3& place) {
    place = {rest.x, rest.y, rest.z + 20.0 * rest.x * rest.x};  // 0.72 mm up at the ends
    return true;
  };
  SolidField field = Block(0.25 * kMm);
  const glm::dvec3 centre(5 * kMm, 0, 0.5 * kMm);  // on the bent top
  const auto tool = [&](const glm::dvec3& x) { return glm::length(x - centre) - 1.2 * kMm; };
  SubtractDeformed(field, {centre - 3 * kMm, centre + 3 * kMm}, bend, tool);
  int solid = 0, wrong = 0;
  for (int i = 0; i <= 40; ++i)
    for (int k = 0; k <= 20; ++k) {
      const glm::dvec3 rest(2.5 * kMm + i * 0.08 * kMm, 0.1 * kMm, -2.2 * kMm + k * 0.1 * kMm);
      glm::dvec3 place;
      bend(rest, place);
      if (std::abs(tool(place)) < 0.05 * kMm) continue;  // within the grid's resolution
      ++solid;
      wrong += (field.Distance(rest) > 0) != (tool(place) < 0);
    }
  EXPECT_GT(solid, 500);
  EXPECT_EQ(wrong, 0);
}

TEST(Cutters, ShaverMeanRateDoesNotExceedItsLimit) {
  const ShaverOptions options{20 * kMm3};
  SolidField field = Block();
  const double whole = field.Volume();
  Shaver shaver;
  const double dt = 1.0 / 60.0;
  double most = 0;
  int steps = 0;
  for (; steps < 45; ++steps) {  // pressed in slowly, so that tissue is always in reach
    const glm::dvec3 tip(0, 0, 1.3 * kMm - 0.02 * kMm * steps);
    const FieldEdit edit = Shave(
        field, {tip - 3 * kMm, tip + 3 * kMm}, Undeformed,
        [&](const glm::dvec3& x) { return glm::length(x - tip) - 2.25 * kMm; }, options, dt,
        shaver);
    most = std::max(most, edit.removed);
  }
  const double removed = whole - field.Volume(), allowed = options.rate * dt * steps;
  std::printf("shaver: %.2f mm3 in %.2f s, rate allows %.2f; most in one step %.3f (rate %.3f)\n",
              removed / kMm3, steps * dt, allowed / kMm3, most / kMm3, options.rate * dt / kMm3);
  EXPECT_LE(removed, allowed * 1.02) << "including the overshoot of the last step";
  EXPECT_GT(removed, 0.9 * allowed);
  // A step follows the rim of the tool, whose area is estimated from grid crossings.
  EXPECT_LT(most, 4 * options.rate * dt);
}

// Half the time step removes the same volume.
TEST(Cutters, ShavedVolumeDoesNotDependOnTheTimeStep) {
  const ShaverOptions options{20 * kMm3};
  const glm::dvec3 tip(0, 0, 0.5 * kMm);
  const auto after = [&](int steps) {
    SolidField field = Block();
    Shaver shaver;
    for (int i = 0; i < steps; ++i)
      Shave(
          field, {tip - 3 * kMm, tip + 3 * kMm}, Undeformed,
          [&](const glm::dvec3& x) { return glm::length(x - tip) - 2.25 * kMm; }, options,
          0.5 / steps, shaver);
    return Block().Volume() - field.Volume();
  };
  const double coarse = after(30), fine = after(60);
  std::printf("half a second: %.3f mm3 in 30 steps, %.3f in 60, rate allows 10\n", coarse / kMm3,
              fine / kMm3);
  EXPECT_NEAR(coarse, fine, 0.05 * fine);
  EXPECT_LE(fine, 10.2 * kMm3);
}

TEST(Cutters, IdleShaverRemovesNothingAndAccumulatesNoAllowance) {
  SolidField field = Block();
  Shaver shaver;
  const ShaverOptions options{20 * kMm3};
  const glm::dvec3 tip(0, 0, 5 * kMm);
  for (int i = 0; i < 600; ++i)
    EXPECT_EQ(Shave(
                  field, {tip - 3 * kMm, tip + 3 * kMm}, Undeformed,
                  [&](const glm::dvec3& x) { return glm::length(x - tip) - 2.25 * kMm; }, options,
                  1.0 / 60, shaver)
                  .removed,
              0.0);
  EXPECT_LE(shaver.allowance, options.rate * 0.05);
}

TEST(Cutters, RemovedVolumeIsReportedPerRegionAndSumsUp) {
  const SolidField original = Block();
  const std::vector<Cut> cuts = SomeCuts();
  const SolidField now = CutAll(original, cuts);
  const std::vector<Region> regions{{"left", {glm::dvec3(-4, 0, 0) * kMm, 2.9 * kMm}},
                                    {"right", {glm::dvec3(3.2, 0, 0) * kMm, 2.2 * kMm}}};
  const auto volumes = RemovedByRegion(original, now, regions);
  ASSERT_EQ(volumes.size(), 3u);
  double sum = 0;
  for (const RegionVolume& v : volumes) {
    std::printf("%-10s %.3f mm3\n", v.name.c_str(), v.removed / kMm3);
    EXPECT_GT(v.removed, 0.0);
    sum += v.removed;
  }
  EXPECT_EQ(volumes[2].name, "elsewhere");
  EXPECT_NEAR(sum, original.Volume() - now.Volume(), 1e-12 * original.Volume());
  SolidField alone = original;
  EXPECT_NEAR(volumes[0].removed, Apply(alone, cuts[0]).removed, 1e-12 * original.Volume());
  EXPECT_THROW(RemovedByRegion(original, Block(0.4 * kMm), regions), Error);
}

TEST(Cutters, CutsWithoutExtentAreRefused) {
  SolidField field = Block();
  const auto refused = [&](const Cut& cut) {
    EXPECT_THROW(Apply(field, cut), Error);
    EXPECT_EQ(field.version(), 0u);
  };
  refused(CapsuleCut{{}, {}, 0.0});
  refused(CapsuleCut{glm::dvec3(std::nan("")), {}, 1e-3});
  refused(TearCut{{{0, 0, 0}}, {0, 0, -1}});
  refused(TearCut{{{0, 0, 0}, {1e-3, 0, 0}}, {0, 0, 0}});
  refused(BoxCut{{}, {1e-3, 0, 1e-3}});
}

}  // namespace
}  // namespace arthro::simulation
