#include "simulation/tissue/field/solid_field.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "simulation/core/process_cost.h"
#include "simulation/core/units.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/build_paths.h"
#include "tests/support/shapes.h"

namespace arthro::simulation {
namespace {

constexpr double kPi = std::numbers::pi;

double ToBall(const glm::dvec3& x, const glm::dvec3& centre, double radius) {
  return glm::length(x - centre) - radius;
}

SolidField Ball(double radius, double spacing) {
  return SolidField::FromFunction({glm::dvec3(-2 * radius), glm::dvec3(2 * radius)}, spacing,
                                  [=](const glm::dvec3& x) { return ToBall(x, {}, radius); });
}

// The grid holds 32-bit values; a linear function is interpolated to their rounding (1e-9 m).
TEST(SolidField, DistanceToABoxIsExactBesideItsFacesAndSigned) {
  const SolidField box =
      SolidField::FromSurface(test::Box(glm::dvec3(-5 * kMm), glm::dvec3(5 * kMm)), 0.35 * kMm);
  EXPECT_NEAR(box.Distance({5.4 * kMm, 1 * kMm, 2 * kMm}), 0.4 * kMm, 2e-9);
  EXPECT_NEAR(box.Distance({3 * kMm, 0.1 * kMm, -0.2 * kMm}), -2 * kMm, 2e-9);
  EXPECT_NEAR(box.Distance({0, -4.9 * kMm, 0}), -0.1 * kMm, 2e-9);
  EXPECT_LT(glm::length(box.Gradient({3 * kMm, 0.1 * kMm, -0.2 * kMm}) - glm::dvec3(1, 0, 0)),
            1e-5);
  // Beyond an edge the distance is curved; interpolation errs by less than h²/(8 d).
  EXPECT_NEAR(box.Distance({5.5 * kMm, 5.5 * kMm, 0}), std::sqrt(0.5) * kMm, 0.025 * kMm);
}

// Thin wedges may give wrong signs: compares every node of a thin crescent-like ring with the
// closed form.
TEST(SolidField, SignsAndDistancesOfATorusAgreeWithTheClosedForm) {
  const double ring = 15 * kMm, tube = 3 * kMm;
  const SolidField field = SolidField::FromSurface(test::Torus(ring, tube, 256, 96), 0.35 * kMm);
  const auto truth = [&](const glm::dvec3& x) {
    return std::hypot(std::hypot(x.x, x.y) - ring, x.z) - tube;
  };
  double worst = 0, worst_near = 0;
  const FieldGrid& grid = field.grid();
  for (int k = 0; k < grid.count[2]; ++k)
    for (int j = 0; j < grid.count[1]; ++j)
      for (int i = 0; i < grid.count[0]; ++i) {
        const double d = truth(grid.Place(i, j, k));
        const double got = static_cast<double>(field.values()[grid.Index(i, j, k)]);
        if (std::abs(d) > 0.01 * kMm) {
          ASSERT_EQ(got < 0, d < 0) << i << " " << j << " " << k;
        }
        const double error = std::abs(got - std::clamp(d, -field.band(), field.band()));
        worst = std::max(worst, error);
        if (std::abs(d) < 0.69 * kMm) worst_near = std::max(worst_near, error);
      }
  std::printf("torus of 49 152 facets: worst distance %.2f um, near the surface %.2f um\n",
              1e6 * worst, 1e6 * worst_near);
  // Facets deviate from the torus by (1 - cos(π/256)) 18 mm + (1 - cos(π/96)) 3 mm = 3 µm.
  EXPECT_LT(worst_near, 3.5e-6);
  // Further off than two spacings the distance is only a depth for pushing out: half a spacing
  // suffices.
  EXPECT_LT(worst, 0.175e-3);
}

TEST(SolidField, OverlappingPartsFormAUnion) {
  const SolidField field =
      SolidField::FromSurface(test::Together(test::Sphere({-2 * kMm, 0, 0}, 4 * kMm, 4),
                                             test::Sphere({2 * kMm, 0, 0}, 4 * kMm, 4)),
                              0.4 * kMm);
  EXPECT_LT(field.Distance({}), 0);
  EXPECT_LT(field.Distance({3 * kMm, 0, 0}), 0);
  EXPECT_GT(field.Distance({7 * kMm, 0, 0}), 0);
}

TEST(SolidField, VolumesAgreeWithClosedForms) {
  const auto report = [](const char* name, double got, double truth) {
    std::printf("%-34s %10.4f mm3, closed form %10.4f, error %+.4f %%\n", name, got / kMm3,
                truth / kMm3, 100 * (got / truth - 1));
    return std::abs(got / truth - 1);
  };
  // Interpolation moves the ball's surface inwards by about h²/(6 R): 3·h²/(6 R²) of the volume.
  const double r = 5 * kMm;
  for (const double h : {0.7 * kMm, 0.35 * kMm, 0.175 * kMm}) {
    const double error = report(h > 0.5 * kMm   ? "ball 5 mm, spacing 0.70 mm"
                                : h > 0.2 * kMm ? "ball 5 mm, spacing 0.35 mm"
                                                : "ball 5 mm, spacing 0.175 mm",
                                Ball(r, h).Volume(), 4.0 / 3.0 * kPi * r * r * r);
    EXPECT_LT(error, h * h / (r * r)) << "second order in the spacing";
  }
  // Flat faces are exact. Edges are rounded by the bilinear zero sets: depending on their position
  // in the cell, -0.02 to 0.25 h² per length are lost. Here 12 edges of 10 mm.
  EXPECT_LT(report("box 10 mm, spacing 0.35 mm",
                   SolidField::FromSurface(test::Box(glm::dvec3(-5 * kMm), glm::dvec3(5 * kMm)),
                                           0.35 * kMm)
                       .Volume(),
                   1000 * kMm3),
            0.25 * 120 * 0.35 * 0.35 / 1000);
  EXPECT_LT(
      report("torus 15/3 mm, spacing 0.35 mm",
             SolidField::FromSurface(test::Torus(15 * kMm, 3 * kMm, 256, 96), 0.35 * kMm).Volume(),
             2 * kPi * kPi * 15 * 9 * kMm3),
      0.005);
}

TEST(SolidField, RemovedAndRemainingVolumeAddUpExactly) {
  SolidField field = Ball(5 * kMm, 0.35 * kMm);
  const double whole = field.Volume();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-6 * kMm, 6 * kMm);
  double removed = 0;
  for (int bite = 0; bite < 100; ++bite) {
    const glm::dvec3 centre(any(random), any(random), any(random));
    const double before = field.Volume();
    const FieldEdit edit =
        field.Subtract({centre - 2.5 * kMm, centre + 2.5 * kMm},
                       [&](const glm::dvec3& x) { return ToBall(x, centre, 1.5 * kMm); });
    EXPECT_GE(edit.removed, 0.0);
    EXPECT_NEAR(edit.removed + field.Volume(), before, 1e-12 * whole);
    removed += edit.removed;
  }
  EXPECT_NEAR(removed + field.Volume(), whole, 1e-12 * whole);
  EXPECT_GT(removed, 0.3 * whole);
  // Fills the same ball again, exactly.
  const FieldEdit back =
      field.Add(field.box(), [](const glm::dvec3& x) { return ToBall(x, {}, 5 * kMm); });
  EXPECT_NEAR(-back.removed, removed, 1e-12 * whole);
}

TEST(SolidField, BiteRemovesItsClosedFormVolumeAndChangesOnlyItsBricks) {
  SolidField field = SolidField::FromFunction({glm::dvec3(-8 * kMm), glm::dvec3(8 * kMm)},
                                              0.25 * kMm, [](const glm::dvec3& x) { return x.z; });
  const glm::dvec3 centre(0.3 * kMm, -0.2 * kMm, 0.0);
  const double r = 2 * kMm;
  const FieldEdit edit = field.Subtract({centre - 3 * kMm, centre + 3 * kMm},
                                        [&](const glm::dvec3& x) { return ToBall(x, centre, r); });
  const double half_ball = 2.0 / 3.0 * kPi * r * r * r;
  std::printf("half a ball of 2 mm at 0.25 mm: %.4f mm3, closed form %.4f\n", edit.removed / kMm3,
              half_ball / kMm3);
  EXPECT_NEAR(edit.removed, half_ball, 0.02 * half_ball);
  int changed = 0;
  for (const auto version : field.brick_versions()) changed += version == field.version();
  EXPECT_GT(changed, 0);
  EXPECT_LE(changed, 27) << "a bite of 4 mm overlaps at most 3 bricks of 2 mm along each axis";
  EXPECT_GT(field.CutDistance({0, 0, -0.5 * kMm}), 0.0);
  EXPECT_LT(field.CutDistance({5 * kMm, 0, -0.5 * kMm}), 0.0);
  EXPECT_GT(field.CutDistance({0, 0, 0.5 * kMm}), 0.0) << "also outside the original solid";
}

TEST(SolidField, ToolOutsideTheSolidChangesNothing) {
  SolidField field = Ball(5 * kMm, 0.35 * kMm);
  const auto version = field.version();
  const glm::dvec3 centre(6.5 * kMm, 0, 0);
  const FieldEdit edit =
      field.Subtract({centre - 1.0 * kMm, centre + 1.0 * kMm},
                     [&](const glm::dvec3& x) { return ToBall(x, centre, 0.0); });
  EXPECT_EQ(edit.removed, 0.0);
  EXPECT_TRUE(edit.changed.empty());
  EXPECT_EQ(field.version(), version);
}

TEST(SolidField, QueriesAllocateNothingAndAcceptAnyNumber) {
  const SolidField field = Ball(5 * kMm, 0.5 * kMm), none;
  const double nan = std::nan(""), far = 1e30;
  const long before = test::Allocations();
  double sum = 0;
  for (const glm::dvec3& x : {glm::dvec3(0), glm::dvec3(nan, 0, 0), glm::dvec3(far, -far, far),
                              glm::dvec3(0.02, 0, 0), glm::dvec3(INFINITY, 0, 0)}) {
    sum += field.Distance(x) + none.Distance(x) + field.CutDistance(x) + field.Gradient(x).x +
           none.Gradient(x).x;
  }
  EXPECT_EQ(test::Allocations(), before);
  EXPECT_GT(field.Distance({far, 0, 0}), 0.0);
  EXPECT_GT(field.Distance({nan, nan, nan}), 0.0) << "NaN is outside the solid";
  (void)sum;
}

// Outside its box a field gives a bound that suffices for sphere tracing.
TEST(SolidField, DistanceOutsideTheBoxIsAContinuousLowerBound) {
  const SolidField field = Ball(5 * kMm, 0.35 * kMm);
  const glm::dvec3 way = glm::normalize(glm::dvec3(1, 0.4, -0.3));
  double last = field.Distance(way * (5 * kMm));
  for (double r = 5 * kMm; r < 20 * kMm; r += 0.01 * kMm) {
    const double d = field.Distance(way * r);
    EXPECT_LE(d, r - 5 * kMm + 0.005 * kMm);
    EXPECT_LT(std::abs(d - last), 0.0125 * kMm);
    last = d;
  }
}

TEST(SolidField, RefusesBadInputWithASentence) {
  const auto code = [](auto&& make) {
    try {
      make();
    } catch (const Error& error) {
      EXPECT_GT(error.sentence().size(), 20u);
      return error.code();
    }
    return Code::kCancelled;
  };
  SurfaceMesh open = test::Box(glm::dvec3(0), glm::dvec3(1));
  open.triangles.pop_back();
  SurfaceMesh broken = test::Box(glm::dvec3(0), glm::dvec3(1));
  broken.vertices[0].x = std::nan("");
  const SurfaceMesh box = test::Box(glm::dvec3(0), glm::dvec3(1));
  EXPECT_EQ(code([] { SolidField::FromSurface({}, 0.1); }), Code::kBadMesh);
  EXPECT_EQ(code([&] { SolidField::FromSurface(open, 0.1); }), Code::kBadMesh);
  EXPECT_EQ(code([&] { SolidField::FromSurface(broken, 0.1); }), Code::kBadMesh);
  EXPECT_EQ(code([&] { SolidField::FromSurface(box, 1e-4); }), Code::kBadArgument);
  EXPECT_EQ(code([&] { SolidField::FromSurface(box, 0.0); }), Code::kBadArgument);
  EXPECT_EQ(code([&] { SolidField::FromSurface(box, std::nan("")); }), Code::kBadArgument);
}

// Timing of the demo's meniscus is printed only (target 0.3 s).
TEST(SolidField, DemoMeniscusIsSampledAndKeepsItsVolume) {
  const SurfaceMesh surface = ReadSurface(ARTHRO_SOURCE_DIR "/resources/demo/meniscus.ply", 1.0);
  double volume = 0;
  for (const auto& [a, b, c] : surface.triangles)
    volume += glm::dot(surface.vertices[static_cast<std::size_t>(a)],
                       glm::cross(surface.vertices[static_cast<std::size_t>(b)],
                                  surface.vertices[static_cast<std::size_t>(c)])) /
              6.0;
  const double start = ThreadCpuMs();
  const SolidField field = SolidField::FromSurface(surface, 0.35 * kMm);
  const double ms = ThreadCpuMs() - start;
  std::printf("demo meniscus: %zu nodes of 0.35 mm in %.0f ms; %.2f mm3, surface %.2f mm3\n",
              field.grid().NodeCount(), ms, field.Volume() / kMm3, volume / kMm3);
  EXPECT_NEAR(field.Volume(), volume, 0.01 * volume);
}

}  // namespace
}  // namespace arthro::simulation
