#include "authoring/tissue/surface/self_intersection.h"

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace arthro::authoring {
namespace {

using test::Box;
using test::Sphere;
using test::Together;

// Two triangles that share the vertices with equal numbers.
bool Meet(const std::vector<glm::dvec3>& vertices, std::array<int, 3> s, std::array<int, 3> t) {
  return FindSelfIntersections({vertices, {s, t}}).size() == 1;
}

TEST(SelfIntersection, SoundSurfacesHaveNone) {
  EXPECT_TRUE(FindSelfIntersections(Box({0, 0, 0}, {1, 2, 3})).empty());
  EXPECT_TRUE(FindSelfIntersections(Sphere({5, 5, 5}, 1, 4)).empty());
  EXPECT_TRUE(FindSelfIntersections(test::Torus(2, 0.5, 40, 20)).empty());
}

TEST(SelfIntersection, DistinguishesPiercingTouchingAndSeparateTriangles) {
  const std::vector<glm::dvec3> x = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const auto with = [&](glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    auto all = x;
    all.insert(all.end(), {a, b, c});
    return Meet(all, {0, 1, 2}, {3, 4, 5});
  };
  EXPECT_TRUE(with({1, 1, -1}, {1, 1, 1}, {9, 9, 0.5})) << "a side goes through the inside";
  EXPECT_TRUE(with({1, 1, 0}, {1, 1, 1}, {2, 1, 1})) << "a corner touches the inside";
  EXPECT_TRUE(with({2, 0, 0}, {2, -1, 1}, {2, -1, -1})) << "a corner touches a side";
  EXPECT_TRUE(with({1, 1, 0}, {9, 1, 0}, {1, 9, 0})) << "they overlap in one plane";
  EXPECT_TRUE(with({1, 1, 0}, {2, 1, 0}, {1, 2, 0})) << "one lies in the other";
  EXPECT_TRUE(with({0, 0, 0}, {4, 0, 0}, {0, -4, 0})) << "sides on one another, not shared";
  EXPECT_FALSE(with({1, 1, 1e-15}, {2, 1, 1}, {1, 2, 1})) << "nearly touches";
  EXPECT_FALSE(with({3, 3, 0}, {9, 3, 0}, {3, 9, 0})) << "beside it in one plane";
  EXPECT_FALSE(with({3, 3, -1}, {3, 3, 1}, {9, 9, 0})) << "goes past it";
}

TEST(SelfIntersection, NeighboursMeetOnlyWhenTheyFoldOrCross) {
  // Sharing a side: folded flat, opened, in one plane.
  EXPECT_TRUE(Meet({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {0, 1, 2}, {1, 0, 3}));
  EXPECT_FALSE(Meet({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1e-15}}, {0, 1, 2}, {1, 0, 3}));
  EXPECT_FALSE(Meet({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, -1, 0}}, {0, 1, 2}, {1, 0, 3}));
  // Sharing a corner: crossing, apart, overlapping in one plane.
  const glm::dvec3 o{0, 0, 0}, a{2, 0, 0}, b{0, 2, 0};
  EXPECT_TRUE(Meet({o, a, b, {1, 1, -1}, {1, 1, 1}}, {0, 1, 2}, {0, 3, 4}));
  EXPECT_FALSE(Meet({o, a, b, {-1, -1, -1}, {-1, -1, 1}}, {0, 1, 2}, {0, 3, 4}));
  EXPECT_TRUE(Meet({o, a, b, {1, 1, 0}, {3, 3, 0}}, {0, 1, 2}, {0, 3, 4}) ==
              false)  // no area: left out
      << "triangles without area are not judged";
  EXPECT_TRUE(Meet({o, a, b, {1, 0.5, 0}, {0.5, 1, 0}}, {0, 1, 2}, {0, 3, 4}));
}

TEST(SelfIntersection, OverlappingBoxesMeetWhereTheirFacesCross) {
  const SurfaceMesh boxes =
      Together(Box({0, 0, 0}, {1, 1, 1}), Box({0.5, 0.25, 0.25}, {1.5, 0.75, 0.75}));
  const auto pairs = FindSelfIntersections(boxes);
  ASSERT_FALSE(pairs.empty());
  for (const IntersectingPair& pair : pairs) {
    EXPECT_LT(pair.first, 12);
    EXPECT_GE(pair.second, 12);
    // The second box's long sides leave the first box through its face x = 1.
    EXPECT_NEAR(PlaceOf(boxes, pair).x, 1.0, 1e-12);
  }
}

TEST(SelfIntersection, IsInvariantUnderTranslation) {
  // Sums of powers of two, so that the translation is exact; touching triangles touch to the last
  // bit.
  const SurfaceMesh boxes =
      Together(Box({0, 0, 0}, {1, 1, 1}), Box({1, 0.25, 0.25}, {2, 0.5, 0.5}));
  const auto at_origin = FindSelfIntersections(boxes);
  EXPECT_FALSE(at_origin.empty());
  SurfaceMesh moved = boxes;
  for (glm::dvec3& x : moved.vertices) x += glm::dvec3(1024, -2048, 512);
  EXPECT_EQ(FindSelfIntersections(moved).size(), at_origin.size());
}

TEST(SelfIntersection, AgreesWithATestOfAllPairs) {
  const SurfaceMesh spheres = Together(Sphere({0, 0, 0}, 1, 2), Sphere({0.7, 0.3, 0.2}, 1, 2));
  const auto found = FindSelfIntersections(spheres);
  std::size_t count = 0;
  for (std::size_t s = 0; s < spheres.triangles.size(); ++s)
    for (std::size_t t = s + 1; t < spheres.triangles.size(); ++t)
      count += Meet(spheres.vertices, spheres.triangles[s], spheres.triangles[t]);
  EXPECT_EQ(found.size(), count);
  EXPECT_GT(count, 20u);
}

}  // namespace
}  // namespace arthro::authoring
