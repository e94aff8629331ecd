// Poses from the surface of a tissue, and its distances from the relief.
#include "authoring/alignment/surface_alignment.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "authoring/alignment/distance_colours.h"
#include "simulation/core/units.h"
#include "tests/support/alignment/alignment_trials.h"
#include "tests/support/shapes.h"

namespace arthro::authoring {
namespace {

// The meniscus of the first phantom, and the relief that shows it.
const test::AlignmentCase& Meniscus() {
  static const std::vector<test::AlignmentCase> kCases = test::MakeAlignmentCases(1);
  return kCases.front();
}
const ReliefTarget& Relief() {
  static const ReliefTarget kRelief = [] {
    LoadedScene scene = Meniscus().scene;
    scene.panorama = Share(ColourImage(scene.depth->width, scene.depth->height));
    return MakeReliefTarget(scene);
  }();
  return kRelief;
}

Pose Moved(const Pose& pose, const glm::dvec3& by, double angle) {
  Pose moved = pose;
  moved.position += by;
  moved.quaternion = glm::angleAxis(angle, glm::normalize(glm::dvec3(1, 2, 3))) * pose.quaternion;
  return moved;
}

TEST(ReliefFit, IsSmallWhereTheTissueLiesInThePictureOfIt) {
  const auto& tissue = Meniscus().tissue;
  const ReliefFit fit = FitOf(Relief(), tissue.surface, tissue.portal_from_tissue);
  ASSERT_TRUE(fit.is_known);
  // Cells of the relief are 0.8 degrees, 0.35 mm at 25 mm.
  EXPECT_LT(fit.median, 0.35 * kMm);
  const ReliefFit away = FitOf(Relief(), tissue.surface,
                               Moved(tissue.portal_from_tissue, glm::dvec3(0, 0, -3) * kMm, 0));
  EXPECT_GT(away.median, 1 * kMm);
  EXPECT_LT(away.within, fit.within);
}

// A block in front of a bare sphere of 50 mm, and half through it.
TEST(ReliefFit, TellsHowDeepATissueLiesBehindTheRelief) {
  LoadedScene scene;
  scene.panorama = Share(ColourImage(400, 300));
  scene.scene.backdrop.projection.centre_px = {199.5, 149.5};
  scene.scene.backdrop.projection.focal_px = 150;
  const ReliefTarget relief = MakeReliefTarget(scene);
  const SurfaceMesh block = test::Box(glm::dvec3(-10, -6, -2) * kMm, glm::dvec3(10, 6, 2) * kMm);
  Pose pose;
  pose.position = glm::dvec3(0, 0, 40) * kMm;
  EXPECT_EQ(FitOf(relief, block, pose).behind, 0);
  pose.position.z = 0.054;
  const ReliefFit buried = FitOf(relief, block, pose);
  EXPECT_EQ(buried.behind, 1);
  // The distance of a corner of the front from the portal, less the radius. Cells of the relief are
  // flat, and lie up to r/8 times their squared angle inside of the sphere: 0.3 um.
  EXPECT_NEAR(buried.deepest, glm::length(glm::dvec3(10, 6, 52)) * kMm - 0.05, 5e-6);
}

TEST(SurfaceAlignment, BringsAMeniscusBackOntoItsPicture) {
  const auto& tissue = Meniscus().tissue;
  const Pose start = Moved(tissue.portal_from_tissue, glm::dvec3(0.8, -1.0, 0.9) * kMm, 0.05);
  const SurfaceAlignment found = AlignSurface(Relief(), tissue.surface, start);
  ASSERT_TRUE(found.is_aligned) << found.sentence;
  std::printf("%s %d steps\n", found.sentence.c_str(), found.steps);
  const double off =
      glm::distance(found.portal_from_tissue.position, tissue.portal_from_tissue.position);
  std::printf("%.2f mm from %.2f mm\n", off / kMm,
              glm::distance(start.position, tissue.portal_from_tissue.position) / kMm);
  EXPECT_LT(off, 0.5 * glm::distance(start.position, tissue.portal_from_tissue.position));
  EXPECT_LT(found.after.median, found.before.median);
  // Half of a cell of the relief.
  EXPECT_LT(found.after.median, 0.35 * kMm);
}

// The relief of a clip that never saw the meniscus shows the plateau under it. A front that was
// laid onto that would carry the meniscus through the bone by its thickness.
TEST(SurfaceAlignment, LaysTheBackOfATissueOntoTheBoneWhereTheReliefDoesNotShowIt) {
  const std::vector<test::AlignmentCase> cases = test::MakeAlignmentCases(1, false);
  LoadedScene scene = cases.front().scene;
  scene.panorama = Share(ColourImage(scene.depth->width, scene.depth->height));
  const ReliefTarget bone = MakeReliefTarget(scene);
  const auto& tissue = cases.front().tissue;
  const Pose start = Moved(tissue.portal_from_tissue, glm::dvec3(0.4, -0.5, 0.4) * kMm, 0.03);
  const SurfaceAlignment found = AlignSurface(bone, tissue.surface, start);
  ASSERT_TRUE(found.is_aligned) << found.sentence;
  EXPECT_EQ(found.side, AlignSide::kBack) << found.sentence;
  EXPECT_EQ(AlignSurface(Relief(), tissue.surface, start).side, AlignSide::kFront)
      << "the relief that shows it";
  const auto error = [&](const Pose& pose) {
    return glm::distance(pose.position, tissue.portal_from_tissue.position);
  };
  SurfaceAlignOptions front;
  front.side = AlignSide::kFront;
  const SurfaceAlignment pulled = AlignSurface(bone, tissue.surface, start, {}, front);
  std::printf("%.2f mm by its back, %.2f mm by its front\n", error(found.portal_from_tissue) / kMm,
              error(pulled.portal_from_tissue) / kMm);
  EXPECT_LT(error(found.portal_from_tissue), error(pulled.portal_from_tissue));
}

TEST(SurfaceAlignment, APatchAloneTakesPart) {
  const auto& tissue = Meniscus().tissue;
  const Ball patch{tissue.surface.vertices.front(), 8 * kMm};
  const Pose start = Moved(tissue.portal_from_tissue, glm::dvec3(0, -0.5, 0.5) * kMm, 0);
  const SurfaceAlignment part = AlignSurface(Relief(), tissue.surface, start, patch);
  const SurfaceAlignment whole = AlignSurface(Relief(), tissue.surface, start);
  EXPECT_LT(part.points, whole.points);
  EXPECT_FALSE(AlignSurface(Relief(), tissue.surface, start, Ball{{1, 1, 1}, 1 * kMm}).is_aligned);
}

TEST(SurfaceAlignment, RefusesWhatIsFarAway) {
  const auto& tissue = Meniscus().tissue;
  const glm::dvec3 in = glm::normalize(tissue.portal_from_tissue.position);
  const Pose far = Moved(tissue.portal_from_tissue, 60 * kMm * in, 0);
  const SurfaceAlignment found = AlignSurface(Relief(), tissue.surface, far);
  EXPECT_FALSE(found.is_aligned);
  EXPECT_EQ(found.portal_from_tissue, far);
  EXPECT_NE(found.sentence.find("more than 10 mm away"), std::string::npos) << found.sentence;
  EXPECT_FALSE(AlignSurface({}, tissue.surface, far).is_aligned);
}

// A square of two triangles whose corners lie 0 and 2 mm off the relief.
TEST(DistanceContours, LieWhereTheDistanceIsOneOfTheLevels) {
  SurfaceMesh square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const auto contours = ContoursOf(square, {0, 2e-3, 2e-3, 0}, {0.5e-3, 5e-3});
  ASSERT_EQ(contours.size(), 2u);
  EXPECT_TRUE(contours[1].empty());
  ASSERT_EQ(contours[0].size(), 2u) << "one segment in each triangle";
  for (const ContourSegment& segment : contours[0]) {
    EXPECT_NEAR(segment.from.x, 0.25, 1e-12);
    EXPECT_NEAR(segment.to.x, 0.25, 1e-12);
    EXPECT_GT(segment.normal.z, 0);
  }
  // Together they cross the square from y = 0 to 1.
  EXPECT_NEAR(glm::distance(contours[0][0].from, contours[0][0].to) +
                  glm::distance(contours[0][1].from, contours[0][1].to),
              1.0, 1e-12);
  const double unknown = std::nan("");
  EXPECT_EQ(ContoursOf(square, {0, 2e-3, 2e-3, unknown}, {0.5e-3}).front().size(), 1u);
}

// A block through a bare sphere of 50 mm: the contour of 0 lies on the sphere.
TEST(DistanceContours, OfNoDistanceLiesOnTheRelief) {
  LoadedScene scene;
  scene.panorama = Share(ColourImage(400, 300));
  scene.scene.backdrop.projection.centre_px = {199.5, 149.5};
  scene.scene.backdrop.projection.focal_px = 150;
  const SurfaceMesh ball = test::Sphere({0, 0, 0}, 10 * kMm, 4);
  Pose pose;
  pose.position = glm::dvec3(0, 0, 50) * kMm;
  const auto contours = DistanceContours(MakeReliefTarget(scene), ball, pose);
  ASSERT_EQ(contours.size(), kContourLevels.size());
  for (std::size_t k = 0; k < contours.size(); ++k) {
    ASSERT_FALSE(contours[k].empty()) << kContourLevels[k];
    // Distances are interpolated along edges of 0.7 mm of a ball of 10 mm.
    for (const ContourSegment& segment : contours[k])
      EXPECT_NEAR(50 * kMm - glm::length(pose * segment.from), kContourLevels[k], 0.02 * kMm);
  }
}

}  // namespace
}  // namespace arthro::authoring
