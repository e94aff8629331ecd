#include "authoring/tissue/surface/surface_check.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "authoring/tissue/surface/surface_repair.h"
#include "simulation/core/error.h"
#include "tests/support/shapes.h"

namespace arthro::authoring {
namespace {

using test::Box;
using test::InsideOut;
using test::Sphere;
using test::Together;

const SurfaceSource kMillimetres{"a.stl", "mm", 1e-3, {}};

std::string SentenceOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.sentence();
  }
  return "";
}

std::string Refusal(const SurfaceMesh& surface) {
  return SentenceOf([&] { RequireMeshable(CheckSurface(surface), kMillimetres); });
}

#define EXPECT_SAYS(sentence, part) \
  EXPECT_NE((sentence).find(part), std::string::npos) << "it said: " << (sentence)

const SurfaceMesh kSoundBox = Box({0, 0, 0}, {0.01, 0.02, 0.03});

TEST(SurfaceCheck, SoundSurfacesPassWithTheirMeasures) {
  const SurfaceCheck check = CheckSurface(kSoundBox);
  EXPECT_EQ(Refusal(kSoundBox), "");
  EXPECT_EQ(check.components, 1);
  EXPECT_DOUBLE_EQ(check.volume, 6e-6);
  EXPECT_DOUBLE_EQ(check.area, 2 * (2e-4 + 3e-4 + 6e-4));
  EXPECT_EQ(check.high, glm::dvec3(0.01, 0.02, 0.03));
  EXPECT_EQ(Refusal(test::Torus(0.02, 0.005, 30, 12)), "") << "a ring is closed as well";
  EXPECT_EQ(Refusal(Together(kSoundBox, Box({0.02, 0, 0}, {0.03, 0.01, 0.01}))), "") << "two parts";
}

TEST(SurfaceCheck, OpenSurfaceIsRefusedWithPlaceAndRemedy) {
  SurfaceMesh open = kSoundBox;
  open.triangles.erase(open.triangles.begin() + 2);  // in the face z = 30 mm
  const std::string refusal = Refusal(open);
  EXPECT_SAYS(refusal, "open: 3 triangle sides");
  EXPECT_SAYS(refusal, " 30 mm");
  EXPECT_SAYS(refusal, "close it where it was made");
}

TEST(SurfaceCheck, EdgeOfThreeTrianglesIsRefused) {
  SurfaceMesh fin = kSoundBox;
  fin.vertices.push_back({-0.01, -0.01, 0.015});
  fin.triangles.push_back({0, 4, 8});
  EXPECT_SAYS(Refusal(fin), "more than two triangles meet at one edge, near 0, 0, 15 mm");
}

TEST(SurfaceCheck, PartsThatShareASinglePointAreRefused) {
  SurfaceMesh two = Together(kSoundBox, Box({0.01, 0.02, 0.03}, {0.02, 0.03, 0.04}));
  for (auto& triangle : two.triangles)
    for (int& corner : triangle)
      if (corner == 8) corner = 7;  // the second box's lowest corner is the first one's highest
  EXPECT_SAYS(Refusal(two), "touch at one single point, near 10, 20, 30 mm");
}

TEST(SurfaceCheck, SelfIntersectionIsRefusedWithCountAndTriangles) {
  const std::string refusal =
      Refusal(Together(kSoundBox, Box({0.005, 0.005, 0.005}, {0.03, 0.01, 0.01})));
  EXPECT_SAYS(refusal, "runs through itself at ");
  EXPECT_SAYS(refusal, "near 10, ");
  EXPECT_SAYS(refusal, "(triangles ");
}

TEST(SurfaceCheck, ReportsTheTriangleNumbersOfTheFile) {
  SurfaceSource source = kMillimetres;
  for (int i = 0; i < 13; ++i) source.triangle_in_file.push_back(1000 + i);
  SurfaceMesh fin = kSoundBox;
  fin.triangles.push_back({0, 4, 3});
  EXPECT_SAYS(SentenceOf([&] { RequireMeshable(CheckSurface(fin), source); }), "triangles 10");
}

TEST(SurfaceCheck, CavityAndDebrisAreFound) {
  const SurfaceMesh big = Sphere({0, 0, 0}, 0.02, 3);
  EXPECT_SAYS(Refusal(Together(big, InsideOut(Sphere({0.005, 0, 0}, 0.003, 2)))), "inside another");
  const SurfaceMesh debris = Together(big, Sphere({0.03, 0, 0}, 0.001, 2));
  EXPECT_EQ(CheckSurface(debris).tiny_components.count, 1);
  EXPECT_EQ(Refusal(debris), "");
  const SurfaceMesh beside = Together(big, Sphere({0.0141, 0.0141, 0.0141}, 0.003, 2));
  EXPECT_EQ(CheckSurface(beside).cavities.count, 0) << "in its box but outside it";
}

TEST(SurfaceCheck, OneSidedSurfaceIsRefused) {
  // Klein's bottle in the figure-of-eight form; its self-intersection must not hide that it has no
  // inside.
  constexpr int n = 24, m = 12;
  SurfaceMesh bottle;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const double u = 2 * std::numbers::pi * i / n, v = 2 * std::numbers::pi * (j + 0.25) / m;
      const double r =
          0.02 + 0.008 * (std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v));
      bottle.vertices.push_back(
          {r * std::cos(u), r * std::sin(u),
           0.008 * (std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v))});
    }
  // After one turn, v has become -v.
  const auto at = [&](int i, int j) {
    return i < n ? i * m + j % m : ((2 * m - 1 - j % m) % m + m) % m;
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      bottle.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      bottle.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  EXPECT_SAYS(Refusal(RepairSurface(bottle, {}).surface), "has no inside");
}

TEST(SurfaceCheck, WrongUnitIsRefusedWithAPlausibleOne) {
  const auto refusal = [&](double size, const SurfaceSource& source) {
    return SentenceOf([&] {
      RequireTissueSize(CheckSurface(Box({0, 0, 0}, glm::dvec3(size) * source.metres_per_unit)),
                        source);
    });
  };
  EXPECT_EQ(refusal(30, kMillimetres), "");
  EXPECT_EQ(refusal(1, kMillimetres), "") << "a cube of 1 mm is small but can be";
  EXPECT_SAYS(refusal(30, {"a.stl", "m", 1.0, {}}), "try --unit mm (52 mm)");
  EXPECT_SAYS(refusal(30, {"a.stl", "um", 1e-6, {}}), "try --unit mm (52 mm)");
  EXPECT_SAYS(refusal(0.03, kMillimetres), "try --unit m (52 mm)");
  EXPECT_SAYS(refusal(1e9, kMillimetres), "scale it");
}

}  // namespace
}  // namespace arthro::authoring
