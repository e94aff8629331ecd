// A scene is told from another by what scope and instrument meet, and by nothing else; recorded
// hands are observed as an attempt that ends with its exercise.
#include "simulation/training/scene_of_attempt.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "simulation/device/trace_io.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/json/exercise_json.h"
#include "simulation/training/observe/surface_names.h"
#include "simulation/training/observed_recording.h"
#include "tests/support/build_paths.h"

namespace arthro::simulation {
namespace {

const std::filesystem::path kShipped = std::filesystem::path(ARTHRO_SOURCE_DIR) / "resources";

LoadedScene FreshDemo() { return LoadScene(kShipped / "demo"); }

TEST(FingerprintOfScene, IsThatOfTheGeometryAlone) {
  const LoadedScene demo = FreshDemo();
  const std::string print = FingerprintOfScene(demo);
  LoadedScene same = demo;
  same.scene.title = "another title";
  same.scene.backdrop.rights.licence = "another licence";
  same.scene.backdrop.panorama = "other.png";
  same.scene.exercises.clear();
  same.scene.rig.scope.pivot.x += 0.1;
  EXPECT_EQ(FingerprintOfScene(same), print);
  const auto differs = [&](const auto& change) {
    LoadedScene other = demo;
    change(other);
    return FingerprintOfScene(other) != print;
  };
  EXPECT_TRUE(differs([](LoadedScene& s) { s.scene.portals.incision_spacing += 1e-6; }));
  EXPECT_TRUE(differs([](LoadedScene& s) { s.scene.tissues[0].pose.position.y += 1e-6; }));
  EXPECT_TRUE(differs([](LoadedScene& s) { s.scene.backdrop.radius += 1e-6; }));
  EXPECT_TRUE(differs([](LoadedScene& s) {
    DepthMap depth = *s.depth;
    depth.at(depth.width / 2, depth.height / 2) += 1e-5F;
    s.depth = Share(std::move(depth));
  }));
  EXPECT_TRUE(differs([](LoadedScene& s) {
    SurfaceMesh surface = *s.surfaces[0];
    surface.vertices[0].x += 1e-6;
    s.surfaces[0] = Share(std::move(surface));
  }));
}

TEST(SceneOfAttempt, OfAnOlderHeadIsToldByTitleAndSurfaces) {
  const LoadedScene demo = FreshDemo();
  const Exercise& exercise = demo.scene.exercises[0];
  AttemptHead head;
  head.exercise = exercise.id;
  head.exercise_hash = HashOf(exercise);
  head.scene = demo.scene.title;
  head.surfaces = SurfaceNames(demo.scene);
  EXPECT_EQ(WhyAnotherScene(head, demo, exercise), "");
  AttemptHead other = head;
  other.scene = "Another knee";
  EXPECT_NE(WhyAnotherScene(other, demo, exercise).find("Another knee"), std::string::npos);
  other = head;
  other.exercise_hash = "0";
  EXPECT_NE(WhyAnotherScene(other, demo, exercise).find("--reobserve"), std::string::npos);
  EXPECT_NE(WhyAnotherScene({}, demo, exercise), "");
}

TEST(ObserveRecording, BeginsInTheStateOfTheExerciseAndEndsWithIt) {
  const LoadedScene demo = FreshDemo();
  const Recording recording{ReadTrace(kShipped / "demo/trace.csv"), {}};
  const auto presets = ReadTissuePresets(kShipped / "presets" / "tissues");
  const auto observe = [&](const Exercise& exercise) {
    return ObserveRecording(demo, recording, exercise, {}, {}, presets);
  };
  Exercise exercise = demo.scene.exercises[0];
  exercise.setup.view_angles = {1.0};
  exercise.setup.disturbances.haze = 0.25;
  exercise.setup.instruments = {"grasper"};
  const auto frames = observe(exercise);
  ASSERT_GT(frames.size(), 100U);
  EXPECT_FLOAT_EQ(frames[10].view_angle, 1.0F);
  EXPECT_FLOAT_EQ(frames[10].haze, 0.25F);
  EXPECT_EQ(frames[10].instrument, ToolKind::kGrasper);
  EXPECT_EQ(frames[10].sight.targets, static_cast<int>(exercise.targets.size()));
  exercise.limits.time = 0.5;
  EXPECT_EQ(observe(exercise).size(), 50U) << "the limit ends it";
}

}  // namespace
}  // namespace arthro::simulation
