#include "app/view/drawing/strands.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/app/view/view_scene.h"

namespace arthro::app {
namespace {

using simulation::TissueLook;
using simulation::TissueStructure;

TissueLook Frayed() {
  TissueLook look;
  look.structure = TissueStructure::kFibres;
  look.fraying = 1;
  return look;
}

TissueLook Villous() {
  TissueLook look;
  look.villi = 1;
  return look;
}

// Volume of a surface, positive where its triangles face outwards.
double SixVolumes(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += glm::dot(mesh.vertices[static_cast<std::size_t>(t[0])],
                    glm::cross(mesh.vertices[static_cast<std::size_t>(t[1])],
                               mesh.vertices[static_cast<std::size_t>(t[2])]));
  return sum;
}

TEST(Strands, OnlyFacesOfCutsAreFrayed) {
  const SurfaceMesh ball = test::Ellipsoid({0.004, 0.004, 0.004});
  const TissueGrain grain(ball, TissueStructure::kFibres);
  EXPECT_TRUE(FrayedFibres(ball, {}, grain, Frayed()).empty());
  std::vector<std::uint8_t> fresh(ball.vertices.size(), 0);
  EXPECT_TRUE(FrayedFibres(ball, fresh, grain, Frayed()).empty());
  for (std::size_t v = 0; v < fresh.size(); ++v) fresh[v] = ball.vertices[v].z > 0 ? 1 : 0;
  const std::vector<Strand> strands = FrayedFibres(ball, fresh, grain, Frayed());
  EXPECT_GT(strands.size(), 50u);
  for (const Strand& strand : strands)
    for (const int corner : strand.corners) EXPECT_EQ(fresh[static_cast<std::size_t>(corner)], 1);
  EXPECT_TRUE(FrayedFibres(ball, fresh, grain, TissueLook{}).empty());
}

// A large surface has fewer strands everywhere, and no bare part.
TEST(Strands, AreSpreadEvenlyWhereTheyAreTooMany) {
  const SurfaceMesh ball = test::Ellipsoid({0.02, 0.02, 0.02});
  const std::vector<Strand> villi = Villi(ball, Villous());
  // Each triangle rounds its number by chance, with a deviation of half a strand at most.
  const double five_deviations = 5 * 0.5 * std::sqrt(static_cast<double>(ball.triangles.size()));
  EXPECT_NEAR(static_cast<double>(villi.size()), static_cast<double>(kMostStrands),
              five_deviations);
  // Both halves of the ball have the same triangles.
  std::array<double, 2> half{};
  for (const Strand& strand : villi) {
    double height = 0;
    for (const int corner : strand.corners)
      height += ball.vertices[static_cast<std::size_t>(corner)].z;
    ++half[height > 0 ? 1 : 0];
  }
  EXPECT_NEAR(half[0], half[1], five_deviations);
}

// A second bite elsewhere must not change what the first one frayed.
TEST(Strands, StayWhereTheSurfaceStays) {
  const SurfaceMesh ball = test::Ellipsoid({0.004, 0.004, 0.004});
  SurfaceMesh part;
  part.vertices = ball.vertices;
  for (const auto& t : ball.triangles)
    if (ball.vertices[static_cast<std::size_t>(t[0])].x > 0) part.triangles.push_back(t);
  const auto places = [](const SurfaceMesh& mesh) {
    std::vector<std::pair<std::array<int, 3>, double>> found;
    for (const Strand& strand : Villi(mesh, Villous()))
      if (mesh.vertices[static_cast<std::size_t>(strand.corners[0])].x > 0)
        found.emplace_back(strand.corners, strand.length);
    return found;
  };
  EXPECT_FALSE(places(part).empty());
  EXPECT_EQ(places(part), places(ball));
}

TEST(Strands, AreClosedTubesThatFaceOutwards) {
  const SurfaceMesh ball = test::Ellipsoid({0.004, 0.004, 0.004});
  for (const Strand& strand : Villi(ball, Villous())) {
    const StrandMesh mesh = MeshOf(std::span(&strand, 1), ball.vertices, 0.4);
    glm::dvec3 sum(0.0);
    double area = 0;
    for (const auto& t : mesh.surface.triangles) {
      const auto at = [&](int i) {
        return mesh.surface.vertices[static_cast<std::size_t>(t[static_cast<std::size_t>(i)])];
      };
      const glm::dvec3 twice = glm::cross(at(1) - at(0), at(2) - at(0));
      sum += twice, area += glm::length(twice);
    }
    EXPECT_LT(glm::length(sum), 1e-12 * area + 1e-18);
    EXPECT_GT(SixVolumes(mesh.surface), 0.0);
    for (const glm::dvec3& normal : mesh.normals) EXPECT_NEAR(glm::length(normal), 1.0, 1e-9);
  }
}

TEST(Strands, SwayWithTimeAndAreTheSameAtTheSameTime) {
  const SurfaceMesh ball = test::Ellipsoid({0.004, 0.004, 0.004});
  const std::vector<Strand> villi = Villi(ball, Villous());
  ASSERT_GT(villi.size(), 50u);
  ASSERT_LE(villi.size(), kMostStrands);
  const auto at = [&](double time) { return MeshOf(villi, ball.vertices, time).surface.vertices; };
  EXPECT_EQ(at(1.0), at(1.0));
  const auto before = at(1.0), after = at(1.5);
  double most = 0, root = 0;
  const std::size_t per_strand = before.size() / villi.size();
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double way = glm::distance(before[i], after[i]);
    (i % per_strand < 3 ? root : most) = std::max(i % per_strand < 3 ? root : most, way);
  }
  EXPECT_EQ(root, 0.0) << "m, roots do not move";
  EXPECT_GT(most, 5e-5) << "m, tips do";
}

}  // namespace
}  // namespace arthro::app

namespace arthro::test {
namespace {

class StrandsView : public ViewTest {};

// Villi sway with the time of the picture alone, and a plain picture has none.
TEST_F(StrandsView, VilliAreDrawnAndStandStillWithTime) {
  LoadedScene loaded = MakeViewScene();
  view_->SetBackdrop(*loaded.panorama, *loaded.depth, loaded.scene.backdrop);
  app::Picture picture = app::PictureFromPose({-0.1, 0, 0, 0.012}, 0.3, 1.5);
  picture.relief = app::kUsualRelief;
  const auto drawn = [&](double time) {
    picture.disturbances.time = time;
    view_->Render(picture, 200);
    return view_->ReadPixels().rgb;
  };
  view_->SetTissues(loaded.scene.tissues, loaded.surfaces);
  const auto bare = drawn(0);
  simulation::TissueLook look;
  look.villi = 1;
  view_->SetTissues(loaded.scene.tissues, loaded.surfaces, std::span(&look, 1));
  const auto villous = drawn(0);
  EXPECT_NE(villous, bare);
  EXPECT_NE(drawn(0.7), villous);
  EXPECT_EQ(drawn(0), villous);
  picture.plain = true;
  const auto plain = drawn(0);
  view_->SetTissues(loaded.scene.tissues, loaded.surfaces);
  EXPECT_EQ(drawn(0), plain);
}

}  // namespace
}  // namespace arthro::test
