// Files of landmark pairs, and places on the relief.
#include "authoring/alignment/landmark_file.h"

#include <gtest/gtest.h>

#include "authoring/alignment/align_report.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "tests/support/build_paths.h"
#include "tests/support/schema_fault.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;

// A backdrop of 50 mm with a step: the right half is 20 mm nearer; the top rows were not imaged.
LoadedScene StepScene() {
  LoadedScene scene;
  scene.scene.backdrop.radius = 0.05;
  scene.scene.backdrop.projection.centre_px = {199.5, 149.5};
  scene.scene.backdrop.projection.focal_px = 150;
  scene.panorama = Share(ColourImage(400, 300));
  DepthMap depth(400, 300);
  for (int v = 0; v < 300; ++v)
    for (int u = 0; u < 400; ++u) depth.at(u, v) = v < 20 ? std::nanf("") : u < 200 ? 0.0f : 0.02f;
  scene.depth = Share(std::move(depth));
  return scene;
}

std::string Text(const std::string& partner) {
  return R"({"schema": "arthroscene.pairs/1", "pairs": [{"name": "a", "model": [0, 0, 0.001], )" +
         partner + "}]}";
}

std::string FaultOf(const std::string& text) {
  try {
    PairsInScene(ParsePairs(text, "p.json"), StepScene(), ReliefOrigin::kMeasured, "p.json");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ScenePoint, AClickInThePanoramaTakesItsRangeFromTheRelief) {
  const LoadedScene scene = StepScene();
  for (const auto& [u, range] : {std::pair{100.0, 0.05}, {300.0, 0.03}}) {
    const auto point = PointOnRelief(scene, SightOfPanorama(scene.scene.backdrop, {u, 149.5}));
    ASSERT_TRUE(point);
    EXPECT_NEAR(glm::length(point->x_in_portal), range, 1e-8);
    EXPECT_FALSE(point->is_guessed);
    EXPECT_NEAR(point->lateral_sigma, kClickSigma * range / point->px_per_radian, 1e-9);
  }
}

TEST(ScenePoint, AnEdgeWithinTheNoiseOfTheClickRaisesTheErrorOfTheRange) {
  const LoadedScene scene = StepScene();
  const auto sigma = [&](double u) {
    return PointOnRelief(scene, SightOfPanorama(scene.scene.backdrop, {u, 149.5}))->range_sigma;
  };
  EXPECT_LT(sigma(190), 1e-3);
  EXPECT_GT(sigma(199), 5e-3) << "some of the pixels around are 20 mm nearer";
}

TEST(ScenePoint, AHoleHasNoRange) {
  const LoadedScene scene = StepScene();
  EXPECT_FALSE(PointOnRelief(scene, SightOfPanorama(scene.scene.backdrop, {100, 5})));
}

TEST(ScenePoint, ARangeThatWasNotMeasuredIsGuessed) {
  LoadedScene scene = StepScene();
  OriginMap origins(400, 300, ReliefOrigin::kBrightness);
  origins.at(100, 150) = ReliefOrigin::kMeasured;
  scene.depth_origin = Share(std::move(origins));
  DepthMap sigma(400, 300, 0.0007f);
  scene.depth_sigma = Share(std::move(sigma));
  const auto measured = PointOnRelief(scene, SightOfPanorama(scene.scene.backdrop, {100, 150}));
  const auto guessed = PointOnRelief(scene, SightOfPanorama(scene.scene.backdrop, {120, 150}));
  EXPECT_FALSE(measured->is_guessed);
  EXPECT_NEAR(measured->range_sigma, 0.0007, 1e-6);
  EXPECT_TRUE(guessed->is_guessed);
  EXPECT_GT(guessed->range_sigma, 2e-3);
}

TEST(ScenePoint, TheNoiseOfAReliefFromBrightnessIsNotItsError) {
  LoadedScene scene = StepScene();
  scene.depth_sigma = Share(DepthMap(400, 300, 0.0002f));
  const Sight sight = SightOfPanorama(scene.scene.backdrop, {120, 150});
  EXPECT_NEAR(PointOnRelief(scene, sight)->range_sigma, 0.0002, 1e-6);
  const auto guessed = PointOnRelief(scene, sight, ReliefOrigin::kBrightness);
  EXPECT_TRUE(guessed->is_guessed);
  EXPECT_GT(guessed->range_sigma, 2e-3);
}

TEST(ScenePoint, TheScopesPictureAndThePanoramaMeetTheSamePlace) {
  const LoadedScene scene = StepScene();
  const simulation::ScopeOptics optics;
  const simulation::ScopeView view =
      simulation::ViewFromPose({0.1, -0.2, 0.5, 0.01}, scene.scene.scope.view_angle);
  const auto sight = SightOfScope(optics, view, 512, {200, 300});
  ASSERT_TRUE(sight);
  const auto point = PointOnRelief(scene, *sight);
  ASSERT_TRUE(point);
  const glm::dvec2 place = simulation::PlaceOf(optics, view, point->x_in_portal - view.tip);
  EXPECT_NEAR(255.5 + 256 * place.x, 200, 1e-6);
  EXPECT_NEAR(255.5 - 256 * place.y, 300, 1e-6);
  const auto pixel = PixelFromDirection(scene.scene.backdrop.projection, point->x_in_portal);
  const auto same = PointOnRelief(scene, SightOfPanorama(scene.scene.backdrop, *pixel));
  EXPECT_LT(glm::distance(same->x_in_portal, point->x_in_portal), 1e-8);
  EXPECT_FALSE(SightOfScope(optics, view, 512, {2, 2})) << "outside of the round window";
}

TEST(LandmarkFile, ReadsEachKindOfPartner) {
  for (const char* partner :
       {R"("panorama": {"pixel": [100, 149.5]})",
        R"("scope": {"pixel": [255.5, 255.5], "size": 512, "latitude_deg": 5, "insertion": 0.01})",
        R"("place": {"position": [0, 0, 0.03], "sigma": 0.0004})"}) {
    const auto pairs =
        PairsInScene(ParsePairs(Text(partner)), StepScene(), ReliefOrigin::kMeasured);
    ASSERT_EQ(pairs.size(), 1u) << partner;
    EXPECT_EQ(pairs[0].name, "a");
    EXPECT_GT(glm::length(pairs[0].scene.x_in_portal), 0.02) << partner;
  }
}

TEST(LandmarkFile, RefusesInOneSentence) {
  EXPECT_NE(FaultOf(Text(R"("panorama": {"pixel": [100, 5]})")).find("nothing was imaged there"),
            std::string::npos);
  EXPECT_NE(FaultOf(Text(R"("panorama": {"pixel": [900, 5]})")).find("outside of the panorama"),
            std::string::npos);
  EXPECT_NE(FaultOf(Text(R"("scope": {"pixel": [1, 1]})")).find("round picture"),
            std::string::npos);
  EXPECT_NE(FaultOf(Text(R"("x-note": 1)")).find("pairs[0]"), std::string::npos);
  EXPECT_NE(FaultOf(Text(R"("panorama": {"pixel": [1, 1]}, "place": {"position": [0, 0, 0]})"))
                .find("one partner"),
            std::string::npos);
  EXPECT_NE(FaultOf(R"({"schema": "arthroscene.scene/1"})").find("arthroscene.pairs/1"),
            std::string::npos);
  EXPECT_NE(FaultOf("[]").find("JSON object"), std::string::npos);
}

TEST(LandmarkFile, SchemaInTheRepositoryIsTheProgramsOwn) {
  const fs::path copy = fs::path(ARTHRO_SOURCE_DIR) / "resources/schemas/pairs-1.schema.json";
  EXPECT_EQ(ReadWholeFile(copy), PairsSchemaText())
      << "a field of the pairs has changed; write the schema anew: arthroscene check "
         "--pairs-schema > resources/schemas/pairs-1.schema.json";
}

TEST(AlignReport, IsAsItsSchemaSaysAndTheSchemaIsTheProgramsOwn) {
  std::vector<LandmarkPair> pairs(2);
  pairs[0].name = "a";
  LandmarkAlignment landmarks;
  landmarks.verdict = AlignVerdict::kAligned;
  landmarks.sentence = "Aligned.";
  landmarks.residuals = {{1e-4, 0.5, true, false}, {2e-4, std::nullopt, true, false}};
  landmarks.warnings = {"Nothing checks it."};
  SurfaceAlignment surface;
  surface.is_aligned = true;
  surface.sentence = "Laid.";
  const std::string text = AlignReportText("meniscus", pairs, landmarks, surface);
  EXPECT_EQ(test::SchemaFault("align-1", text), "") << text;
  EXPECT_NE(text.find("\"after\""), std::string::npos);
  landmarks.verdict = AlignVerdict::kTooFew;
  EXPECT_EQ(test::SchemaFault("align-1", AlignReportText("m", {}, landmarks, {})), "");
  const fs::path copy = fs::path(ARTHRO_SOURCE_DIR) / "resources/schemas/align-1.schema.json";
  EXPECT_EQ(ReadWholeFile(copy), AlignReportSchemaText())
      << "a field of the report has changed; write the schema anew: arthroscene check "
         "--align-schema > resources/schemas/align-1.schema.json";
}

}  // namespace
}  // namespace arthro::authoring
