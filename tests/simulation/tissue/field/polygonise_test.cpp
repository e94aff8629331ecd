#include "simulation/tissue/field/polygonise.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/process_cost.h"
#include "simulation/core/units.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "simulation/tissue/field/cell_patches.h"
#include "tests/simulation/tissue/field/closed_manifold.h"
#include "tests/support/build_paths.h"

namespace arthro::simulation {
namespace {

using Shape = std::function<double(const glm::dvec3&)>;

double Sphere(const glm::dvec3& x) { return glm::length(x) - 5 * kMm; }
double Torus(const glm::dvec3& x) {
  return std::hypot(std::hypot(x.x, x.y) - 6 * kMm, x.z) - 2 * kMm;
}
double Box(const glm::dvec3& x) {
  const glm::dvec3 q = glm::abs(x) - glm::dvec3(5, 4, 3) * kMm;
  return glm::length(glm::max(q, glm::dvec3(0))) + std::min(0.0, std::max({q.x, q.y, q.z}));
}

SolidField Sampled(const Shape& shape, double spacing) {
  return SolidField::FromFunction({glm::dvec3(-10 * kMm), glm::dvec3(10 * kMm)}, spacing, shape);
}

SolidField Noise(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1, 1);
  return SolidField::FromFunction({glm::dvec3(0), glm::dvec3(20)}, 1.0,
                                  [&](const glm::dvec3&) { return any(random); });
}

void ExpectSameSurface(const SurfaceMesh& a, const SurfaceMesh& b) {
  EXPECT_TRUE(a.vertices == b.vertices);
  EXPECT_TRUE(a.triangles == b.triangles);
}

// Precondition of joining a face: it is the cell's only ambiguous one, and joining splits the
// patch.
TEST(CellPatches, JoiningTheOnlyAmbiguousFaceSplitsASelfTouchingPatch) {
  int touching = 0;
  for (int c = 0; c < 256; ++c) {
    const int faces = SelfTouchingFaces(c);
    if (faces == 0) continue;
    ++touching;
    int ambiguous = 0;
    for (int face = 0; face < 6; ++face) ambiguous += IsAmbiguous(c, face);
    EXPECT_EQ(ambiguous, 1) << c;
    EXPECT_EQ(FindPatches(c, faces).count, FindPatches(c, 0).count + 1) << c;
  }
  EXPECT_GT(touching, 0);
}

TEST(Polygonise, VertexErrorIsSecondOrderInTheSpacing) {
  struct Case {
    const char* name;
    Shape shape;
    double curvature;  // largest sum of the absolute principal curvatures, 1/m
  };
  for (const Case& c : {Case{"sphere 5 mm", Sphere, 2 / (5 * kMm)},
                        Case{"torus 6/2 mm", Torus, 1 / (2 * kMm) + 1 / (4 * kMm)}})
    for (const double h : {0.5 * kMm, 0.25 * kMm}) {
      const SurfaceMesh surface = Polygonise(Sampled(c.shape, h));
      double worst = 0, sum = 0;
      for (const glm::dvec3& x : surface.vertices) {
        worst = std::max(worst, std::abs(c.shape(x)));
        sum += std::abs(c.shape(x));
      }
      std::printf(
          "%-13s spacing %.2f mm: %6zu vertices, off by %.2f um at most, %.2f in the mean\n",
          c.name, h / kMm, surface.vertices.size(), 1e6 * worst,
          1e6 * sum / static_cast<double>(surface.vertices.size()));
      // Linear interpolation over h has an error of at most h²/8 times the second derivative per
      // axis.
      EXPECT_LT(worst, h * h / 8 * c.curvature * 1.2);
      const test::SurfaceFaults faults = test::FaultsOf(surface);
      EXPECT_EQ(faults.edges + faults.vertices, 0);
    }
  // Away from its edges a box is exact to the 32-bit values; an edge is cut off within its cell.
  const double h = 0.35 * kMm;
  const SurfaceMesh box = Polygonise(Sampled(Box, h));
  double worst_face = 0, worst_edge = 0;
  for (const glm::dvec3& x : box.vertices) {
    const glm::dvec3 q = glm::abs(glm::abs(x) - glm::dvec3(5, 4, 3) * kMm);
    const double second = std::max(std::min(q.x, q.y), std::min(std::max(q.x, q.y), q.z));
    double& worst = second > 2 * h ? worst_face : worst_edge;
    worst = std::max(worst, std::abs(Box(x)));
  }
  std::printf("box: face error %.4f um, edge error %.1f um (spacing 350 um)\n", 1e6 * worst_face,
              1e6 * worst_edge);
  EXPECT_LT(worst_face, 2e-9);
  EXPECT_LT(worst_edge, 0.5 * h);
}

// Noise contains all arrangements of signs; none may break the surface.
TEST(Polygonise, NoiseGivesAClosedManifoldAroundItsSolid) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    const SolidField field = Noise(seed);
    const SurfaceMesh surface = Polygonise(field);
    ASSERT_GT(surface.triangles.size(), 20000u);
    const test::SurfaceFaults faults = test::FaultsOf(surface);
    EXPECT_EQ(faults.edges, 0) << seed;
    EXPECT_EQ(faults.vertices, 0) << seed;
    EXPECT_GT(test::EnclosedVolume(surface), 0.0);
  }
}

TEST(Polygonise, EnclosedVolumeEqualsTheFieldVolume) {
  const SolidField field = Sampled(Torus, 0.25 * kMm);
  EXPECT_NEAR(test::EnclosedVolume(Polygonise(field)), field.Volume(), 0.005 * field.Volume());
}

TEST(Polygonise, UpdateRedoesChangedBricksOnlyAndEqualsAFullRun) {
  SolidField field = Sampled(Box, 0.25 * kMm);
  FieldSkin skin(field);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-5 * kMm, 5 * kMm);
  for (int bite = 0; bite < 15; ++bite) {
    const glm::dvec3 centre(any(random), any(random), bite % 2 == 0 ? 3 * kMm : any(random));
    const SurfaceMesh before = skin.surface();
    const auto version = field.version();
    field.Subtract({centre - 1.2 * kMm, centre + 1.2 * kMm},
                   [&](const glm::dvec3& x) { return glm::length(x - centre) - 0.7 * kMm; });
    int changed = 0;
    for (const auto v : field.brick_versions()) changed += v > version;
    const SkinUpdate update = skin.Update(field);
    if (bite == 0)
      std::printf("a bite of 1.4 mm: %d bricks redone, %d relinked, of %d\n", update.bricks_redone,
                  update.bricks_relinked, update.bricks_with_skin);
    EXPECT_EQ(update.bricks_redone, changed);
    EXPECT_LE(changed, 8) << "1.4 mm + margins meets at most 2 bricks of 2 mm along each axis";
    ExpectSameSurface(skin.surface(), Polygonise(field));
    // Vertices with a previous index are at the same position.
    ASSERT_EQ(skin.previous().size(), skin.surface().vertices.size());
    std::size_t kept = 0;
    for (std::size_t v = 0; v < skin.previous().size(); ++v)
      if (const int old = skin.previous()[v]; old >= 0) {
        ASSERT_EQ(before.vertices[static_cast<std::size_t>(old)], skin.surface().vertices[v]);
        ++kept;
      }
    EXPECT_GT(static_cast<double>(kept), 0.9 * static_cast<double>(before.vertices.size()));
  }
  EXPECT_EQ(skin.Update(field).bricks_redone, 0);
}

// Neighbours of a changed brick may have joined a face with it: changes noise in one brick.
TEST(Polygonise, UpdateFollowsChangesAcrossBricksInNoise) {
  SolidField field = Noise(11);
  FieldSkin skin(field);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int change = 0; change < 30; ++change) {
    const glm::dvec3 centre(10 + 9 * any(random), 10 + 9 * any(random), 10 + 9 * any(random));
    const Box3 box{centre - 1.5, centre + 1.5};
    if (change % 2 == 0)
      field.Subtract(box, [&](const glm::dvec3&) { return any(random); });
    else
      field.Add(box, [&](const glm::dvec3&) { return any(random); });
    skin.Update(field);
    ExpectSameSurface(skin.surface(), Polygonise(field));
  }
}

// Values that no version speaks of: the bricks that changed are found by comparing.
TEST(Polygonise, UpdateFromOtherValuesRedoesChangedBricksOnly) {
  const SolidField field =
      SolidField::FromFunction({glm::dvec3(-6e-3), glm::dvec3(6e-3)}, 2e-4,
                               [](const glm::dvec3& x) { return glm::length(x) - 5e-3; });
  std::vector<float> values(field.values().begin(), field.values().end());
  FieldSkin kept;
  const SkinUpdate first = kept.Update(field, values);
  EXPECT_EQ(kept.Update(field, values).bricks_redone, 0);
  for (float& value : values)
    if (std::abs(value) < 3e-4f &&
        &value - values.data() > static_cast<std::ptrdiff_t>(values.size()) * 4 / 5)
      value -= 1e-4f;
  const SkinUpdate second = kept.Update(field, values);
  FieldSkin anew;
  anew.Update(field, values);
  EXPECT_EQ(kept.surface().vertices, anew.surface().vertices);
  EXPECT_EQ(kept.surface().triangles, anew.surface().triangles);
  std::printf("%d of %d bricks redone\n", second.bricks_redone, first.bricks_with_skin);
  EXPECT_GT(second.bricks_redone, 0);
  EXPECT_LT(second.bricks_redone, first.bricks_with_skin / 2);
}

TEST(Polygonise, EmptyFieldGivesNoTriangles) {
  EXPECT_TRUE(Polygonise(SolidField()).triangles.empty());
  EXPECT_TRUE(Polygonise(Sampled([](const glm::dvec3&) { return 1.0; }, kMm)).triangles.empty());
}

// Timing is printed only.
TEST(Polygonise, DemoMeniscusIsAClosedManifold) {
  SolidField field = SolidField::FromSurface(
      ReadSurface(ARTHRO_SOURCE_DIR "/resources/demo/meniscus.ply", 1.0), 0.35 * kMm);
  const auto ms = [](double start) { return ThreadCpuMs() - start; };
  double start = ThreadCpuMs();
  FieldSkin skin(field);
  const double whole = ms(start);
  const glm::dvec3 centre = skin.surface().vertices[skin.surface().vertices.size() / 2];
  start = ThreadCpuMs();
  field.Subtract({centre - 2.5 * kMm, centre + 2.5 * kMm},
                 [&](const glm::dvec3& x) { return glm::length(x - centre) - 1.7 * kMm; });
  const double edit = ms(start);
  start = ThreadCpuMs();
  const SkinUpdate update = skin.Update(field);
  std::printf(
      "demo meniscus at 0.35 mm: %zu triangles in %.1f ms; a bite of 3.4 mm: field %.2f ms, skin "
      "%.2f ms, %d of %d bricks\n",
      skin.surface().triangles.size(), whole, edit, ms(start), update.bricks_redone,
      update.bricks_with_skin);
  const test::SurfaceFaults faults = test::FaultsOf(skin.surface());
  EXPECT_EQ(faults.edges + faults.vertices, 0);
}

}  // namespace
}  // namespace arthro::simulation
