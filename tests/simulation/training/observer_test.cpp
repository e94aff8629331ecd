// Sight of targets, against the tracer of the view tests and against closed forms.
#include "simulation/training/observe/observer.h"

#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/units.h"
#include "simulation/scope/disturbances.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/shapes.h"
#include "tests/support/view/reference_tracer.h"

namespace arthro::simulation {
namespace {

constexpr double kRadius = 0.05, kBall = 4e-3;  // m
constexpr glm::dvec3 kMiddle{0.004, -0.002, 0.03};

// A relief of 10 mm with hills of up to 12 mm more, in front of which lies a ball.
LoadedScene HillsWithBall() {
  LoadedScene loaded;
  constexpr int kSize = 384;
  loaded.scene.backdrop.radius = kRadius;
  loaded.scene.backdrop.projection.centre_px = {0.5 * kSize - 0.5, 0.5 * kSize - 0.5};
  loaded.scene.backdrop.projection.focal_px = 150;
  loaded.scene.portals.incision_spacing = 0.03;
  loaded.panorama = Share(ColourImage(kSize, kSize));
  DepthMap depth(kSize, kSize);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      double h = 0.01;
      for (const glm::dvec3 hill :
           {glm::dvec3(120, 150, 12e-3), {240, 190, 9e-3}, {180, 280, 6e-3}})
        h += hill.z * std::exp(-(std::pow(x - hill.x, 2) + std::pow(y - hill.y, 2)) / 900.0);
      depth.at(x, y) = static_cast<float>(h);
    }
  loaded.depth = Share(depth);
  Tissue tissue;
  tissue.name = "ball";
  tissue.pose.position = kMiddle;
  loaded.scene.tissues.push_back(tissue);
  loaded.surfaces.push_back(Share(test::Sphere({0, 0, 0}, kBall, 4)));
  return loaded;
}

// A scope held at `pose`, with an instrument that has not entered.
AttemptFrame FrameAt(const RodPose& pose, double view_angle = RadiansFromDegrees(30)) {
  AttemptFrame frame;
  ToolFrame& scope = frame.tool[0];
  scope.tip = scope.drawn_tip = glm::vec3(TipInOwnPortal(pose));
  scope.axis = glm::vec3(BasisOf(pose).axis);
  scope.roll = static_cast<float>(pose.roll);
  scope.depth = static_cast<float>(pose.depth);
  scope.is_valid = true;
  frame.view_angle = static_cast<float>(view_angle);
  frame.head_roll = scope.roll;
  frame.incision_spacing = 0.03F;
  return frame;
}

void HoldInstrument(const glm::dvec3& tip, AttemptFrame& frame) {
  ToolFrame& tool = frame.tool[1];
  const glm::dvec3 way = tip - glm::dvec3(frame.incision_spacing, 0, 0);
  tool.tip = tool.drawn_tip = glm::vec3(tip);
  tool.axis = glm::vec3(glm::normalize(way));
  tool.depth = static_cast<float>(glm::length(way));
  tool.is_valid = true;
}

class ObserverOfHills : public testing::Test {
 protected:
  DepthField Relief() const { return {loaded.scene.backdrop, *loaded.depth}; }
  Observer Of(std::vector<TargetPlace> targets) const {
    return {loaded, std::move(targets), relief, eye};
  }

  const LoadedScene loaded = HillsWithBall();
  const DepthField relief = Relief();
  ScopeEye eye{loaded};
};

TEST_F(ObserverOfHills, AgreesWithTheTracerOfTheView) {
  std::mt19937 random(3);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
  };
  // Half of the targets lie in all directions, and half on the relief behind the ball.
  LoadedScene without = loaded;
  without.scene.tissues.clear();
  without.surfaces.clear();
  std::vector<TargetPlace> targets;
  while (targets.size() < static_cast<std::size_t>(kMostTargets)) {
    const auto target = targets.size() % 2 == 0
                            ? TargetOnBearing(loaded, uniform(-0.7, 0.7), uniform(-0.7, 0.7), 2e-3)
                            : TargetOnBearing(without, uniform(-0.15, 0.2), uniform(0, 0.3), 2e-3);
    if (target) targets.push_back(*target);
  }
  const Observer observer = Of(targets);
  // The model in the portal frame, for the tracer.
  SurfaceMesh ball = *loaded.surfaces[0];
  for (glm::dvec3& x : ball.vertices) x += kMiddle;
  const test::ReferenceMesh meshes[] = {{&ball}};
  int clear = 0, hidden = 0, outside = 0, different = 0, narrow = 0;
  for (int i = 0; i < 300; ++i) {
    const RodPose pose{uniform(-0.6, 0.6), uniform(-0.6, 0.6), uniform(-3, 3),
                       uniform(4e-3, 0.022)};
    AttemptFrame frame = FrameAt(pose);
    observer.Observe(frame);
    const ScopeView view = test::ReferenceView(
        {pose.latitude, pose.longitude, pose.roll, pose.depth, RadiansFromDegrees(30), {}});
    for (std::size_t j = 0; j < targets.size(); ++j) {
      const PointSight& sight = frame.sight.target[j];
      const glm::dvec3 way = glm::dvec3(sight.place) - view.tip;
      const double distance = glm::length(way);
      const double angle = std::acos(glm::dot(view.view, way / distance));
      const double q = std::sin(0.5 * angle) / std::sin(0.25 * loaded.scene.scope.field_of_view);
      // Frames hold 32 bits: 3e-9 m of a tip at 25 mm, seen from 4 mm at the nearest.
      EXPECT_NEAR(sight.centre, q, 2e-6);
      EXPECT_NEAR(sight.distance, distance, 1e-8);
      if (std::abs(q - 1) < 1e-5) continue;
      if (q > 1) {
        ++outside;
        EXPECT_FALSE(sight.is_clear);
        continue;
      }
      const glm::dvec3 ray = way / distance;
      const test::TracedRay hit = test::TraceRays(loaded.scene.backdrop, *loaded.panorama, view.tip,
                                                  {&ray, 1}, meshes, &*loaded.depth)[0];
      const double before = distance - hit.distance;  // m, from the first hit to the target
      const bool is_clear = hit.what == test::TracedRay::kNothing || before < kSurfaceMargin;
      // The contact field is smoothed by one pixel, 0.3 mm, which moves a grazing hit further.
      const bool is_narrow = before > 0.2e-3 && before < 2e-3;
      (is_clear ? clear : hidden) += 1;
      narrow += is_narrow;
      if (is_clear != sight.is_clear && !is_narrow) ++different;
    }
  }
  EXPECT_EQ(different, 0) << "of " << clear << " clear and " << hidden << " hidden";
  EXPECT_GT(clear, 300);
  EXPECT_GT(hidden, 100);
  EXPECT_GT(outside, 300);
  EXPECT_LT(narrow, (clear + hidden) / 10) << "lines that graze an edge are few";
}

TEST_F(ObserverOfHills, TargetBehindTheInstrumentIsHidden) {
  const auto target = TargetOnBearing(loaded, 0.2, -0.3, 2e-3);
  ASSERT_TRUE(target);
  const RodPose pose{-0.3, -0.3, 0, 8e-3};
  const Observer observer = Of({*target});
  AttemptFrame frame = FrameAt(pose);
  observer.Observe(frame);
  ASSERT_TRUE(frame.sight.target[0].is_clear);
  const glm::dvec3 lens = TipInOwnPortal(pose);
  HoldInstrument(lens + 0.5 * (target->point - lens), frame);
  observer.Observe(frame);
  EXPECT_FALSE(frame.sight.target[0].is_clear);
  EXPECT_TRUE(frame.sight.is_tip_visible) << "its own shaft does not hide the tip";
}

TEST_F(ObserverOfHills, TipBehindTheBallIsNotVisible) {
  const Observer observer = Of({});
  const RodPose pose{-0.35, 0.1, 0, 6e-3};
  AttemptFrame frame = FrameAt(pose);
  HoldInstrument(kMiddle + glm::dvec3(0, 0, -kBall - 2e-3), frame);
  observer.Observe(frame);
  EXPECT_TRUE(frame.sight.is_tip_visible);
  HoldInstrument(kMiddle + glm::dvec3(0, 0, kBall + 2e-3), frame);
  observer.Observe(frame);
  EXPECT_FALSE(frame.sight.is_tip_visible);
}

TEST_F(ObserverOfHills, BloodHidesWhatIsFarAndDewAll) {
  const auto target = TargetOnBearing(loaded, 0.2, -0.3, 2e-3);
  const Observer observer = Of({*target});
  AttemptFrame frame = FrameAt({-0.3, -0.3, 0, 8e-3});
  observer.Observe(frame);
  const double distance = frame.sight.target[0].distance;
  // Strength at which 0.3 of the green light passes.
  const double haze = -std::log(kLeastTransmittance) / (kHazeExtinction[1] * distance);
  ASSERT_LT(haze, 1);
  frame.haze = static_cast<float>(haze * 0.999);
  observer.Observe(frame);
  EXPECT_TRUE(frame.sight.target[0].is_clear);
  frame.haze = static_cast<float>(haze * 1.001);
  observer.Observe(frame);
  EXPECT_FALSE(frame.sight.target[0].is_clear);
  frame.haze = 0;
  frame.fog = 0.5F;
  observer.Observe(frame);
  EXPECT_TRUE(frame.sight.target[0].is_clear);
  frame.fog = 0.51F;
  observer.Observe(frame);
  EXPECT_FALSE(frame.sight.target[0].is_clear);
}

TEST_F(ObserverOfHills, NothingIsSeenByAScopeOutside) {
  const Observer observer = Of({*TargetOnBearing(loaded, 0, 0, 2e-3)});
  AttemptFrame frame = FrameAt({-0.3, 0, 0, 8e-3});
  frame.tool[0].is_valid = false;
  observer.Observe(frame);
  EXPECT_FALSE(frame.sight.target[0].is_clear);
  EXPECT_EQ(frame.sight.target[0].centre, std::numeric_limits<float>::infinity());
  EXPECT_EQ(frame.sight.targets, 1);
}

TEST_F(ObserverOfHills, IncidenceIsTheAngleToTheSurface) {
  const auto target = TargetOnTissue(loaded, 0, {0, 0, -kBall}, 2e-3);
  ASSERT_TRUE(target);
  const RodPose pose{-0.3, 0.1, 0, 6e-3};
  AttemptFrame frame = FrameAt(pose);
  Of({*target}).Observe(frame);
  const glm::dvec3 to_lens =
      glm::normalize(TipInOwnPortal(pose) - glm::dvec3(frame.sight.target[0].place));
  EXPECT_NEAR(frame.sight.target[0].incidence, std::acos(glm::dot(target->normal, to_lens)), 1e-5);
}

// The ball as a tissue that deforms.
WorldPicture WorldOf(const SurfaceMesh& skin, std::uint64_t shape) {
  WorldPicture world;
  BodyPicture& body = world.bodies.emplace_back();
  body.tissue = 0;
  body.shape = shape;
  body.skin = std::make_shared<const BodySkin>(BodySkin{skin, {}});
  body.positions = skin.vertices;
  return world;
}

TEST_F(ObserverOfHills, TargetMovesWithItsTissue) {
  const auto target = TargetOnTissue(loaded, 0, {0.6 * kBall, 0, -0.8 * kBall}, 2e-3);
  ASSERT_TRUE(target);
  WorldPicture world = WorldOf(*loaded.surfaces[0], 1);
  Observer observer = Of({*target});
  AttemptFrame frame = FrameAt({0, 0, 0, 8e-3});
  observer.Follow(world);
  observer.Observe(frame);
  const glm::dvec3 before(frame.sight.target[0].place);
  EXPECT_LT(glm::distance(before, kMiddle + target->point), 1e-8);
  const glm::dvec3 way(1e-3, -2e-3, 0.5e-3);
  for (glm::dvec3& x : world.bodies[0].positions) x += way;
  ++world.bodies[0].shape;
  observer.Follow(world);
  observer.Observe(frame);
  EXPECT_LT(glm::distance(glm::dvec3(frame.sight.target[0].place), before + way), 1e-8);
}

TEST_F(ObserverOfHills, TargetOfACutTissueIsTiedAnewOrGone) {
  const auto near = TargetOnTissue(loaded, 0, {0, 0, -kBall}, 2e-3);
  Observer observer = Of({*near});
  AttemptFrame frame = FrameAt({0, 0, 0, 8e-3});
  const auto observed = [&](const SurfaceMesh& skin) {
    observer.Follow(WorldOf(skin, 1));
    observer.Observe(frame);
    return frame.sight.target[0];
  };
  EXPECT_FALSE(observed(*loaded.surfaces[0]).is_gone);
  const PointSight shaved = observed(test::Sphere({0, 0, 0}, kBall - 0.9e-3, 4));
  EXPECT_FALSE(shaved.is_gone);
  EXPECT_NEAR(shaved.place.z, kMiddle.z - kBall + 0.9e-3, 2e-5);
  const PointSight gone = observed(test::Sphere({0, 0, 0}, kBall - 1.1e-3, 4));
  EXPECT_TRUE(gone.is_gone);
  EXPECT_FALSE(gone.is_clear);
  EXPECT_FALSE(observed(*loaded.surfaces[0]).is_gone) << "a reset brings it back";
}

TEST_F(ObserverOfHills, AllocatesNothing) {
  std::vector<TargetPlace> targets(16, *TargetOnBearing(loaded, 0.1, 0.1, 2e-3));
  targets[3] = *TargetOnTissue(loaded, 0, {0, 0, -kBall}, 2e-3);
  Observer observer = Of(targets);
  WorldPicture world = WorldOf(*loaded.surfaces[0], 1);
  AttemptFrame frame = FrameAt({0, 0, 0, 8e-3});
  HoldInstrument({0.005, 0, 0.02}, frame);
  const long before = test::Allocations();
  observer.Follow(world);
  for (int i = 0; i < 10; ++i) observer.Observe(frame);
  EXPECT_EQ(test::Allocations(), before);
}

TEST_F(ObserverOfHills, BearingEndsAtTheFirstSurface) {
  const glm::dvec3 way = glm::normalize(kMiddle);
  const auto ball = TargetOnBearing(loaded, std::asin(-way.y), std::atan2(way.x, way.z), 2e-3);
  ASSERT_TRUE(ball);
  EXPECT_EQ(ball->tissue, 0);
  // The ball is an octahedron, cut four times: 0.2 % of its radius.
  EXPECT_NEAR(glm::length(kMiddle + ball->point), glm::length(kMiddle) - kBall, 2e-5);
  const auto wall = TargetOnBearing(loaded, 0.6, 0.6, 2e-3);
  ASSERT_TRUE(wall);
  EXPECT_EQ(wall->tissue, -1);
  EXPECT_NEAR(glm::length(wall->point), kRadius - 0.01, 1e-4);
  EXPECT_FALSE(TargetOnBearing(loaded, 1.5, 0, 2e-3)) << "beyond the panorama";
}

TEST_F(ObserverOfHills, PointFarFromItsTissueIsNotTied) {
  EXPECT_TRUE(TargetOnTissue(loaded, 0, {0, 0, -kBall - 1.9e-3}, 2e-3));
  EXPECT_FALSE(TargetOnTissue(loaded, 0, {0, 0, -kBall - 2.1e-3}, 2e-3));
  EXPECT_FALSE(TargetOnTissue(loaded, 1, {0, 0, 0}, 2e-3));
}

TEST_F(ObserverOfHills, MoreTargetsThanAFrameHoldsAreRefused) {
  EXPECT_THROW(Of(std::vector<TargetPlace>(17)), Error);
}

}  // namespace
}  // namespace arthro::simulation
