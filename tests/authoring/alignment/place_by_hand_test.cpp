// Placing a tissue by hand.
#include "authoring/alignment/place_by_hand.h"

#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/units.h"
#include "tests/support/shapes.h"

namespace arthro::authoring {
namespace {

SurfaceMesh HandBlock() {
  return test::Box(glm::dvec3(-10, -6, -2) * kMm, glm::dvec3(14, 6, 2) * kMm);
}

double Volume(const SurfaceMesh& surface) {
  double volume = 0;
  for (const auto& [a, b, c] : surface.triangles) {
    const auto at = [&](int i) { return surface.vertices[static_cast<std::size_t>(i)]; };
    volume += glm::dot(at(a), glm::cross(at(b), at(c))) / 6;
  }
  return volume;
}

TEST(PlaceByHand, AStepGoesAlongTheAxisThatIsAskedFor) {
  Pose pose;
  pose.quaternion = glm::angleAxis(std::numbers::pi / 2, glm::dvec3(0, 0, 1));
  EXPECT_LT(
      glm::distance(Shifted(pose, 0, kMm, NudgeAxes::kPortal).position, glm::dvec3(1, 0, 0) * kMm),
      1e-12);
  EXPECT_LT(
      glm::distance(Shifted(pose, 0, kMm, NudgeAxes::kTissue).position, glm::dvec3(0, 1, 0) * kMm),
      1e-12);
}

TEST(PlaceByHand, ATurnLeavesTheMiddleWhereItIs) {
  const glm::dvec3 middle = MiddleOf(HandBlock());
  EXPECT_LT(glm::distance(middle, glm::dvec3(2, 0, 0) * kMm), 1e-12);
  Pose pose{glm::dvec3(1, 2, 30) * kMm, glm::angleAxis(0.4, glm::dvec3(0, 1, 0)), 1.5};
  for (const NudgeAxes axes : {NudgeAxes::kPortal, NudgeAxes::kTissue})
    for (int axis = 0; axis < 3; ++axis) {
      const Pose turned = Turned(pose, axis, 0.3, axes, middle);
      EXPECT_LT(glm::distance(turned * middle, pose * middle), 1e-12);
      const double cosine = std::abs(glm::dot(turned.quaternion, pose.quaternion));
      EXPECT_NEAR(cosine, std::cos(0.15), 1e-12);
    }
}

TEST(PlaceByHand, AMirrorImageFacesOutwardsAndTwiceIsTheSame) {
  const SurfaceMesh block = HandBlock(), mirrored = Mirrored(block, 2 * kMm);
  EXPECT_NEAR(Volume(mirrored), Volume(block), 1e-15);
  const SurfaceMesh again = Mirrored(mirrored, 2 * kMm);
  EXPECT_EQ(again.triangles, block.triangles);
  Tissue tissue;
  tissue.fixed.push_back({glm::dvec3(5, 1, 1) * kMm, kMm});
  tissue.regions.push_back({"horn", {glm::dvec3(-8, 0, 0) * kMm, kMm}});
  tissue.cuts.push_back(
      TearCut{{glm::dvec3(0.0), glm::dvec3(3, 0, 2) * kMm}, glm::normalize(glm::dvec3(1, 0, -1))});
  tissue.cuts.push_back(CapsuleCut{glm::dvec3(1, 0, 0) * kMm, glm::dvec3(2, 0, 0) * kMm});
  const Tissue image = Mirrored(tissue, 2 * kMm);
  EXPECT_LT(glm::distance(image.fixed[0].centre, glm::dvec3(-1, 1, 1) * kMm), 1e-15);
  EXPECT_LT(glm::distance(image.regions[0].ball.centre, glm::dvec3(12, 0, 0) * kMm), 1e-15);
  EXPECT_LT(std::get<TearCut>(image.cuts[0]).into.x, 0);
  EXPECT_NEAR(std::get<CapsuleCut>(image.cuts[1]).a.x, 3 * kMm, 1e-15);
}

TEST(PlaceByHand, ABaseLiesOnTheReliefWithItsNormal) {
  LoadedScene scene;
  scene.panorama = Share(ColourImage(400, 300));
  scene.scene.backdrop.projection.centre_px = {199.5, 149.5};
  scene.scene.backdrop.projection.focal_px = 150;
  const ReliefTarget relief = MakeReliefTarget(scene);
  const SurfaceMesh block = HandBlock();
  const glm::dvec3 direction = glm::normalize(glm::dvec3(0.3, -0.2, 1)), place = 0.05 * direction;
  Pose present;
  present.position = glm::dvec3(0, 0, 20) * kMm;
  const Pose laid = LaidOnRelief(relief, block, present, place);
  // The block's flat side has the normal of the sphere, which points to the portal. Cells of the
  // relief are flat to 0.2 degrees.
  EXPECT_GT(std::abs(glm::dot(laid.quaternion * glm::dvec3(0, 0, 1), direction)), 0.9999);
  // Its middle is half of its height in front of the place.
  EXPECT_LT(glm::distance(laid * MiddleOf(block), place - 2 * kMm * direction), 0.05 * kMm);
  EXPECT_EQ(LaidOnRelief({}, block, present, place), present);
}

}  // namespace
}  // namespace arthro::authoring
