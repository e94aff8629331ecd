#include "simulation/scene/solids/solid_io.h"

#include <cmath>
#include <filesystem>
#include <map>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/folders/temporary_folder.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "simulation/scene/solids/solid_function.h"
#include "tests/support/build_paths.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRing = R"({
  "schema": "arthroscene.solid/1",
  "parts": [
    { "type": "torus", "ring_radius": 0.004, "tube_radius": 0.001 },
    { "type": "box", "join": "difference", "blend": 0.0005, "centre": [0.004, 0, 0],
      "half": [0.002, 0.002, 0.002], "rounding": 0.0002 }
  ]
})";

std::string RefusalOf(const std::string& text) {
  try {
    ParseSolid(text);
  } catch (const Error& error) {
    return error.sentence();
  }
  return "accepted";
}

bool IsClosed(const SurfaceMesh& surface) {
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : surface.triangles)
    for (int k = 0; k < 3; ++k) {
      const int a = t[static_cast<std::size_t>(k)], b = t[static_cast<std::size_t>((k + 1) % 3)];
      if (a == b) return false;
      edges[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  for (const auto& [edge, balance] : edges)
    if (balance != 0) return false;
  return true;
}

double VolumeOf(const SurfaceMesh& surface) {
  double volume = 0;
  for (const auto& [a, b, c] : surface.triangles)
    volume += glm::dot(surface.vertices[static_cast<std::size_t>(a)],
                       glm::cross(surface.vertices[static_cast<std::size_t>(b)],
                                  surface.vertices[static_cast<std::size_t>(c)])) /
              6;
  return volume;
}

TEST(SolidFile, ComesBackAsItWasWritten) {
  const Solid solid = ParseSolid(kRing);
  ASSERT_EQ(solid.parts.size(), 2u);
  EXPECT_STREQ(TypeOf(solid.parts[1]), "box");
  EXPECT_EQ(PlaceOf(solid.parts[1]).join, SolidJoin::kDifference);
  EXPECT_EQ(ParseSolid(JsonFromSolid(solid)), solid);
  const TemporaryFolder folder;
  WriteSolid(folder.path() / "ring.solid", solid);
  EXPECT_EQ(ReadSolid(folder.path() / "ring.solid"), solid);
}

TEST(SolidFile, FaultsAreNamedByTheirKey) {
  EXPECT_NE(RefusalOf("[]").find("JSON object"), std::string::npos);
  EXPECT_NE(RefusalOf(R"({"schema": "arthroscene.solid/2", "parts": []})").find("solid/2"),
            std::string::npos);
  EXPECT_NE(RefusalOf(R"({"schema": "arthroscene.solid/1", "parts": []})").find("no part"),
            std::string::npos);
  const auto with = [](const std::string& part) {
    return R"({"schema": "arthroscene.solid/1", "parts": [)" + part + "]}";
  };
  EXPECT_NE(RefusalOf(with(R"({"type": "cone"})")).find("cone"), std::string::npos);
  EXPECT_NE(RefusalOf(with(R"({"type": "ellipsoid", "radii": [0.001, 0, 0.001]})")).find("radii"),
            std::string::npos);
  EXPECT_NE(RefusalOf(with(R"({"type": "ellipsoid", "radius": 0.001})")).find("radi"),
            std::string::npos);
  EXPECT_NE(RefusalOf(with(R"({"type": "plane"})")).find("no end"), std::string::npos);
}

TEST(SolidFile, TheSchemaInResourcesIsThatOfTheFields) {
  EXPECT_EQ(ReadWholeFile(fs::path(ARTHRO_SOURCE_DIR) / "resources/schemas/solid-1.schema.json"),
            SolidSchemaText())
      << "a field of the solid has changed; write the schema anew: arthroscene check "
         "--solid-schema > resources/schemas/solid-1.schema.json";
}

TEST(SolidSurface, IsClosedOutwardAndOnTheZeroOfTheFunction) {
  const Solid ball{{EllipsoidPart{{}, glm::dvec3(3e-3)}}};
  const SurfaceMesh surface = SurfaceOfSolid(ball);
  EXPECT_TRUE(IsClosed(surface));
  // A triangle with sides h and a circle of radius R: chords lie h² / 8 R inside at their middle,
  // so the volume is short by less than 3 h² / 8 R² with h the diagonal of a cell.
  const double cell = 6e-3 / kSolidCells, exact = 4.0 / 3.0 * std::acos(-1.0) * 27e-9;
  const double bound = exact * 3 * 3 * cell * cell / (8 * 9e-6);
  EXPECT_LT(VolumeOf(surface), exact);
  EXPECT_GT(VolumeOf(surface), exact - bound);
  const SolidFunction function(ball);
  // VTK's contour gives vertices as 32-bit floats, but each is moved in 64 bits afterwards.
  for (const glm::dvec3& x : surface.vertices) EXPECT_NEAR(function.Value(x), 0, 1e-12);
}

TEST(SolidSurface, OfSharpAndBlendedJointsIsClosed) {
  EXPECT_TRUE(IsClosed(SurfaceOfSolid(ParseSolid(kRing))));
  const Solid cut{{BoxPart{{}, {3e-3, 2e-3, 1e-3}},
                   CapsulePart{{SolidJoin::kDifference}, 0.01, 5e-4},
                   PlanePart{{SolidJoin::kIntersection}}}};
  EXPECT_TRUE(IsClosed(SurfaceOfSolid(cut)));
}

// HAP-30
TEST(SolidSurface, CoincidentPartsThatTakeOneAnotherAwayAreRefused) {
  const Solid none{{EllipsoidPart{}, EllipsoidPart{{SolidJoin::kDifference}}}};
  EXPECT_THROW(SurfaceOfSolid(none), Error);
  const Solid twice{{EllipsoidPart{}, EllipsoidPart{}}};
  EXPECT_EQ(SurfaceOfSolid(twice).triangles.size(),
            SurfaceOfSolid({{EllipsoidPart{}}}).triangles.size());
}

TEST(SolidSurface, IsReadWhereASurfaceIsRead) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "ring.solid";
  WriteSolid(file, ParseSolid(kRing));
  EXPECT_EQ(ReadSurface(file, 1.0).triangles, SurfaceOfSolid(ParseSolid(kRing)).triangles);
}

// HAP-30
TEST(SolidSurface, ASolidFarFromItsOriginKeepsItsShape) {
  Solid far{{EllipsoidPart{{SolidJoin::kUnion, 0, 0, {glm::dquat(1, 0, 0, 0), {1.9, -1.9, 1.9}}},
                           glm::dvec3(3e-3)}}};
  const SurfaceMesh surface = SurfaceOfSolid(far);
  EXPECT_TRUE(IsClosed(surface));
  for (const glm::dvec3& x : surface.vertices)
    EXPECT_NEAR(glm::distance(x, {1.9, -1.9, 1.9}), 3e-3, 1e-12);
}

}  // namespace
}  // namespace arthro
