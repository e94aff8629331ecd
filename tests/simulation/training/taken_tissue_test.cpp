// Tissue that was taken, by the regions of the targets, and the rim that is left.
#include "simulation/training/observe/taken_tissue.h"

#include <gtest/gtest.h>

#include "simulation/training/observe/exercise_targets.h"
#include "tests/support/shapes.h"

namespace arthro::simulation {
namespace {

// A ball of 10 mm, held by a ball of 2 mm at its lower pole, with a region of 3 mm at the upper
// one.
LoadedScene HeldBall() {
  LoadedScene loaded;
  Tissue tissue;
  tissue.name = "meniscus";
  tissue.fixed = {{{0, 0, -0.01}, 0.002}};
  tissue.regions = {{"kept", {{0.01, 0, 0}, 0.003}}, {"flap", {{0, 0, 0.01}, 0.003}}};
  loaded.scene.tissues.push_back(tissue);
  loaded.surfaces.push_back(Share(test::Sphere({0, 0, 0}, 0.01, 4)));
  return loaded;
}

Exercise TrimOfFlap() {
  Exercise exercise;
  ExerciseTarget target;
  target.id = "flap";
  target.on = "meniscus";
  target.regions = {"flap"};
  exercise.targets = {target};
  return exercise;
}

// Picture after the volumes in mm³ were removed from the regions and elsewhere.
WorldPicture Removed(double kept, double flap, double elsewhere,
                     std::shared_ptr<const BodySkin> skin = nullptr) {
  WorldPicture world;
  BodyPicture& body = world.bodies.emplace_back();
  body.tissue = 0;
  body.skin = std::move(skin);
  body.cut.cuts = 1;
  body.cut.by_region = {1e-9 * kept, 1e-9 * flap, 1e-9 * elsewhere};
  body.cut.volume_by_region = {10e-9, 20e-9, 100e-9};
  body.cut.removed = 1e-9 * (kept + flap + elsewhere);
  return world;
}

AttemptFrame Measured(TakenTissue& taken, const WorldPicture& world) {
  AttemptFrame frame;
  taken.Measure(&world, frame);
  return frame;
}

// Frames hold 32 bits, so volumes agree within this share.
constexpr double kTakenRounding = 1e-6;

TEST(TakenTissue, IsCountedByTheRegionsOfTheTargets) {
  const LoadedScene loaded = HeldBall();
  TakenTissue taken(loaded, PlacesOfTargets(loaded, TrimOfFlap()));
  AttemptFrame frame = Measured(taken, Removed(0, 5, 0));
  EXPECT_NEAR(frame.sight.target[0].taken_share, 0.25, kTakenRounding);
  EXPECT_NEAR(frame.taken, 5e-9, 5e-9 * kTakenRounding);
  EXPECT_EQ(frame.taken_outside, 0.0F);
  // A region that no target names lies outside.
  frame = Measured(taken, Removed(2, 15, 1));
  EXPECT_NEAR(frame.sight.target[0].taken_share, 0.75, kTakenRounding);
  EXPECT_NEAR(frame.taken, 13e-9, 13e-9 * kTakenRounding);
  EXPECT_NEAR(frame.taken_outside, 3e-9, 3e-9 * kTakenRounding);
  frame = Measured(taken, Removed(2, 15, 1));
  EXPECT_EQ(frame.taken, 0.0F);
  EXPECT_EQ(frame.taken_outside, 0.0F);
  EXPECT_NEAR(frame.sight.target[0].taken_share, 0.75, kTakenRounding);
}

TEST(TakenTissue, ResetPutsNothingBack) {
  const LoadedScene loaded = HeldBall();
  TakenTissue taken(loaded, PlacesOfTargets(loaded, TrimOfFlap()));
  Measured(taken, Removed(0, 5, 2));
  AttemptFrame frame = Measured(taken, Removed(0, 0, 0));
  EXPECT_EQ(frame.taken, 0.0F);
  EXPECT_EQ(frame.taken_outside, 0.0F);
  EXPECT_EQ(frame.sight.target[0].taken_share, 0.0F);
  frame = Measured(taken, Removed(0, 0, 1));
  EXPECT_NEAR(frame.taken_outside, 1e-9, 1e-9 * kTakenRounding);
}

TEST(TakenTissue, RimIsTheDistanceOfCutFacesFromTheWall) {
  const LoadedScene loaded = HeldBall();
  TakenTissue taken(loaded, PlacesOfTargets(loaded, TrimOfFlap()));
  EXPECT_EQ(Measured(taken, Removed(0, 0, 0)).rim, -1.0F);
  // Two points of a cut face on the axis, and one old point at the wall.
  auto skin = std::make_shared<BodySkin>();
  skin->surface.vertices = {{0, 0, 0.007}, {0, 0, 0.006}, {0, 0, -0.01}};
  skin->is_fresh = {1, 1, 0};
  const AttemptFrame frame = Measured(taken, Removed(0, 5, 0, skin));
  // The wall reaches 5 mm from the lower pole: the skin's points with 2 (10 mm)² (1 - cos θ) at
  // most (5 mm)². From z = 6 mm its rim is nearest, which lies within an edge of the mesh, 1.2 mm.
  const double cosine = 1 - 0.5 * 0.25, rim = std::sqrt(1e-4 * (1 - cosine * cosine));
  EXPECT_NEAR(frame.rim, std::hypot(rim, 0.006 + 0.01 * cosine), 1.2e-3);
  // 0 and 1 mm from the sphere of the region.
  EXPECT_NEAR(frame.contour, 1e-3 / std::sqrt(2), 1e-8);
}

}  // namespace
}  // namespace arthro::simulation
