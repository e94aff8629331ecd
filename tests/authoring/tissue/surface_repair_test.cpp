#include "authoring/tissue/surface/surface_repair.h"

#include <gtest/gtest.h>

#include "authoring/tissue/surface/surface_check.h"
#include "authoring/tissue/surface/surface_topology.h"
#include "tests/support/shapes.h"

namespace arthro::authoring {
namespace {

using test::Box;
using test::InsideOut;
using test::Sphere;
using test::Together;

const SurfaceMesh kSphere = Sphere({0, 0, 0}, 0.02, 3);

double VolumeOf(const SurfaceMesh& surface) {
  return SignedVolume(surface.vertices, surface.triangles);
}

TEST(SurfaceRepair, SoundSurfaceIsUnchanged) {
  const RepairedSurface mended = RepairSurface(kSphere, {});
  EXPECT_EQ(mended.repairs.Total(), 0);
  EXPECT_EQ(mended.surface.vertices, kSphere.vertices);
  EXPECT_EQ(mended.surface.triangles, kSphere.triangles);
}

TEST(SurfaceRepair, InsideOutSurfaceIsTurned) {
  const RepairedSurface mended = RepairSurface(InsideOut(kSphere), {});
  EXPECT_EQ(mended.repairs.flipped_components, 1);
  EXPECT_DOUBLE_EQ(VolumeOf(mended.surface), VolumeOf(kSphere));
}

TEST(SurfaceRepair, OnlyThePartThatFacesInwardsIsTurned) {
  const SurfaceMesh two = Together(kSphere, InsideOut(Sphere({0.05, 0, 0}, 0.01, 2)));
  const RepairedSurface mended = RepairSurface(two, {});
  EXPECT_EQ(mended.repairs.flipped_components, 1);
  EXPECT_EQ(CheckSurface(mended.surface).inward.count, 0);
}

TEST(SurfaceRepair, SingleTrianglesThatFaceTheOtherWayAreTurned) {
  SurfaceMesh mixed = kSphere;
  for (std::size_t t = 0; t < mixed.triangles.size(); t += 5)
    std::swap(mixed.triangles[t][0], mixed.triangles[t][1]);
  const RepairedSurface mended = RepairSurface(mixed, {});
  EXPECT_EQ(mended.repairs.reoriented_triangles,
            static_cast<int>((mixed.triangles.size() + 4) / 5));
  EXPECT_EQ(CheckSurface(mended.surface).flipped.count, 0);
  EXPECT_DOUBLE_EQ(VolumeOf(mended.surface), VolumeOf(kSphere));
}

TEST(SurfaceRepair, OnlyVerticesWithinAMillionthOfTheDiagonalAreWelded) {
  SurfaceMesh soup;  // every triangle has corners of its own, moved by 1e-8 of the diagonal
  for (const auto& triangle : kSphere.triangles) {
    const int first = static_cast<int>(soup.vertices.size());
    for (int i = 0; i < 3; ++i)
      soup.vertices.push_back(kSphere.vertices[triangle[i]] + glm::dvec3(3e-10 * i, 0, 0));
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  const RepairedSurface mended = RepairSurface(soup, {});
  EXPECT_EQ(mended.surface.vertices.size(), kSphere.vertices.size());
  EXPECT_TRUE(CheckSurface(mended.surface).IsClosedManifold());
  for (glm::dvec3& x : soup.vertices) x.x += 1e-6 * static_cast<double>(&x - &soup.vertices[0]);
  EXPECT_EQ(RepairSurface(soup, {}).repairs.welded_vertices, 0) << "a real gap stays one";
}

TEST(SurfaceRepair, DropsDuplicateAndCollapsedTrianglesAndUnreferencedVertices) {
  SurfaceMesh surface = kSphere;
  surface.triangles.push_back(surface.triangles[3]);
  surface.triangles.push_back({surface.triangles[4][1], surface.triangles[4][0],
                               surface.triangles[4][2]});  // the other way round
  surface.triangles.push_back({7, 7, 9});
  surface.vertices.push_back({1, 1, 1});
  surface.vertices.pop_back();
  surface.vertices.push_back({0.001, 0, 0});
  const RepairedSurface mended = RepairSurface(surface, {});
  EXPECT_EQ(mended.repairs.duplicate_triangles, 2);
  EXPECT_EQ(mended.repairs.collapsed_triangles, 1);
  EXPECT_EQ(mended.repairs.unreferenced_vertices, 1);
  EXPECT_EQ(mended.surface.triangles, kSphere.triangles);
  EXPECT_EQ(mended.source_triangle.back(), static_cast<int>(kSphere.triangles.size()) - 1);
}

TEST(SurfaceRepair, TriangleWithoutAreaIsFlippedIntoItsNeighbour) {
  // The box's face x = 0 with a corner halfway on the diagonal of one side only.
  SurfaceMesh box = Box({0, 0, 0}, {0.01, 0.01, 0.01});
  box.vertices.push_back({0, 0.005, 0.005});
  // {0, 4, 6} stays; {0, 6, 2} becomes two, and a line closes the gap between them.
  box.triangles[9] = {0, 8, 2};
  box.triangles.push_back({8, 6, 2});
  box.triangles.push_back({0, 6, 8});
  ASSERT_EQ(CheckSurface(box).degenerate.count, 1);
  const RepairedSurface mended = RepairSurface(box, {});
  EXPECT_EQ(mended.repairs.flattened_triangles, 1);
  const SurfaceCheck check = CheckSurface(mended.surface);
  EXPECT_TRUE(check.IsClosedManifold());
  EXPECT_EQ(check.flipped.count, 0);
  EXPECT_DOUBLE_EQ(check.volume, 1e-6);
}

TEST(SurfaceRepair, HolesAreClosedUpToTheGivenSize) {
  SurfaceMesh open = kSphere;
  // The last two of four parts of one triangle are neighbours: a hole of four sides.
  open.triangles.erase(open.triangles.begin() + 102, open.triangles.begin() + 104);
  ASSERT_EQ(CheckSurface(open).open_edges.count, 4);
  EXPECT_EQ(RepairSurface(open, {}).repairs.filled_holes, 0);
  EXPECT_EQ(RepairSurface(open, {3, 0}).repairs.filled_holes, 0);
  const RepairedSurface mended = RepairSurface(open, {4, 0});
  EXPECT_EQ(mended.repairs.filled_holes, 1);
  EXPECT_TRUE(CheckSurface(mended.surface).IsClosedManifold());
  EXPECT_NEAR(VolumeOf(mended.surface), VolumeOf(kSphere), 1e-3 * VolumeOf(kSphere))
      << "a hole of two triangles is a thousandth of the sphere at most";
}

TEST(SurfaceRepair, DebrisIsDroppedOnRequestOnly) {
  const SurfaceMesh debris = Together(kSphere, Sphere({0.03, 0, 0}, 0.001, 1));
  EXPECT_EQ(RepairSurface(debris, {}).repairs.Total(), 0);
  const RepairedSurface mended = RepairSurface(debris, {0, 1e-3});
  EXPECT_EQ(mended.repairs.dropped_components, 1);
  EXPECT_EQ(mended.surface.vertices, kSphere.vertices);
}

}  // namespace
}  // namespace arthro::authoring
