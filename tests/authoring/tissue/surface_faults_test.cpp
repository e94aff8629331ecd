#include "authoring/tissue/surface_faults.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "authoring/tissue/surface/surface_check.h"
#include "simulation/core/error.h"
#include "tests/support/shapes.h"

namespace arthro::authoring {
namespace {

const SurfaceFault* Find(const SurfaceFaults& found, FaultKind kind) {
  for (const SurfaceFault& fault : found.faults)
    if (fault.kind == kind) return &fault;
  return nullptr;
}

SurfaceMesh Ball() { return test::Sphere({0, 0, 0}, 0.01, 3); }

// The upper half: a sheet with one rim.
SurfaceMesh Dome() {
  SurfaceMesh dome = Ball();
  std::erase_if(dome.triangles, [&](const auto& t) {
    return std::any_of(t.begin(), t.end(), [&](int i) { return dome.vertices[i].z < -1e-9; });
  });
  return dome;
}

TEST(SurfaceFaults, AClosedSurfaceHasNone) {
  EXPECT_TRUE(FindSurfaceFaults(Ball()).faults.empty());
}

TEST(SurfaceFaults, AMissingTriangleIsAHoleThatIsMended) {
  SurfaceMesh ball = Ball();
  ball.triangles.pop_back();
  const SurfaceFaults found = FindSurfaceFaults(ball);
  ASSERT_EQ(found.faults.size(), 1u);
  ASSERT_TRUE(Find(found, FaultKind::kHole));
  EXPECT_EQ(Find(found, FaultKind::kHole)->edges.size(), 3u);
  EXPECT_TRUE(found.CanBeMended());
  std::string what;
  const SurfaceMesh mended = MendSurface(ball, &what);
  EXPECT_EQ(what, "1 filled hole");
  EXPECT_TRUE(CheckSurface(mended).IsClosedManifold());
  EXPECT_TRUE(FindSurfaceFaults(mended).faults.empty());
}

TEST(SurfaceFaults, AnOpenSheetIsNoHoleAndBecomesALayer) {
  const SurfaceMesh dome = Dome();
  const SurfaceFaults found = FindSurfaceFaults(dome);
  EXPECT_FALSE(Find(found, FaultKind::kHole));
  ASSERT_TRUE(Find(found, FaultKind::kSheet));
  EXPECT_EQ(Find(found, FaultKind::kSheet)->count, 1);
  EXPECT_FALSE(found.CanBeMended());
  EXPECT_EQ(MendSurface(dome, nullptr).triangles.size(), dome.triangles.size());
  const SurfaceMesh layer = MakeLayer(dome, 1e-3);
  EXPECT_TRUE(CheckSurface(layer).IsClosedManifold());
  EXPECT_GT(CheckSurface(layer).volume, 0);
}

// A back farther behind than the radius of the sheet's curvature has passed through its centre.
TEST(SurfaceFaults, ALayerThatIsTooThickIsRefusedInWords) {
  try {
    MakeLayer(Dome(), 0.02);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.sentence().find("a layer of 20 mm would run through itself"), std::string::npos)
        << error.sentence();
  }
  EXPECT_THROW(MakeLayer(Ball(), 1e-3), Error) << "a closed surface is no sheet";
}

TEST(SurfaceFaults, CopiesAndTurnedTrianglesAreUntidyAndMended) {
  SurfaceMesh ball = Ball();
  ball.triangles.push_back(ball.triangles[3]);
  std::swap(ball.triangles[7][1], ball.triangles[7][2]);
  const SurfaceFaults found = FindSurfaceFaults(ball);
  ASSERT_EQ(found.faults.size(), 1u);
  EXPECT_EQ(found.faults[0].kind, FaultKind::kUntidy);
  EXPECT_EQ(found.faults[0].triangles.size(), 2u);
  EXPECT_TRUE(FindSurfaceFaults(MendSurface(ball, nullptr)).faults.empty());
}

TEST(SurfaceFaults, CrossingsAndSliversAreShownAndNotMended) {
  SurfaceMesh two = Ball();
  const SurfaceMesh other = test::Sphere({0.012, 0.001, 0.0005}, 0.01, 3);
  const int offset = static_cast<int>(two.vertices.size());
  two.vertices.insert(two.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [a, b, c] : other.triangles)
    two.triangles.push_back({a + offset, b + offset, c + offset});
  const SurfaceFaults found = FindSurfaceFaults(two);
  ASSERT_TRUE(Find(found, FaultKind::kCrossing));
  EXPECT_GT(Find(found, FaultKind::kCrossing)->triangles.size(), 8u);
  EXPECT_FALSE(found.CanBeMended());

  SurfaceMesh thin = test::Box({0, 0, 0}, {0.01, 0.01, 1e-4});
  ASSERT_TRUE(Find(FindSurfaceFaults(thin), FaultKind::kSliver));
  EXPECT_EQ(Find(FindSurfaceFaults(thin), FaultKind::kSliver)->count, 8)
      << "two on each of the four narrow sides";
}

}  // namespace
}  // namespace arthro::authoring
