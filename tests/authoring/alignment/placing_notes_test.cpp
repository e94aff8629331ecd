// Landmarks and frames of imports that are kept with a scene.
#include "authoring/alignment/placing_notes.h"

#include <gtest/gtest.h>

#include "simulation/core/error.h"

namespace arthro::authoring {
namespace {

PlacingNotes Sample() {
  PlacingNotes notes;
  TissueLandmarks& own = notes.landmarks.emplace_back();
  own.tissue = "meniscus";
  own.solves_scale = true;
  LandmarkPair& pair = own.pairs.emplace_back();
  pair.name = "anterior horn";
  pair.x_in_tissue = {0.01, -0.002, 0.0005};
  pair.scene = {{0.003, 0.001, 0.04}, {0, 0, 0.01}, 600, 1e-4, 1.0 / 3e3, true};
  pair.is_left_out = true;
  notes.imports.push_back({"tibia", 2, {0.1, 0.2, 0.3}});
  return notes;
}

TEST(PlacingNotes, ComeBackFromTheirTextToTheLastBit) {
  EXPECT_EQ(NotesFromText(NotesText(Sample())), Sample());
}

TEST(PlacingNotes, RefuseWhatIsNoNotesInOneSentence) {
  const auto refusal = [](const std::string& text) {
    try {
      NotesFromText(text);
    } catch (const Error& error) {
      return std::string(error.sentence());
    }
    return std::string();
  };
  EXPECT_NE(refusal("[]").find("must be a JSON object"), std::string::npos);
  EXPECT_NE(refusal(R"({"schema": "arthroscene.placing/9"})").find("arthroscene.placing/1"),
            std::string::npos);
  EXPECT_NE(refusal(R"({"schema": "arthroscene.placing/1", "landmarks": [{"tissue": "a",
                       "pairs": [{"model": [0, 0], "place": [0, 0, 0]}]}]})")
                .find("landmarks[0].pairs[0].model"),
            std::string::npos);
}

TEST(PlacingNotes, FollowTheNameAndTheMirrorImageOfTheirTissue) {
  Scene scene;
  PutNotes(scene, Sample());
  RenameInNotes(scene, "meniscus", "medial meniscus");
  EXPECT_FALSE(LandmarksOf(NotesOf(scene), "meniscus"));
  MirrorInNotes(scene, "medial meniscus", 0.004);
  PlacingNotes notes = NotesOf(scene);
  ASSERT_TRUE(LandmarksOf(notes, "medial meniscus"));
  EXPECT_DOUBLE_EQ(LandmarksOf(notes, "medial meniscus")->pairs[0].x_in_tissue.x, -0.002);
  EXPECT_TRUE(FrameOf(notes, "tibia"));
  MirrorInNotes(scene, "tibia", 0);
  notes = NotesOf(scene);
  EXPECT_FALSE(FrameOf(notes, "tibia")) << "a mirror image fits its file no more";
  RenameInNotes(scene, "medial meniscus", "");
  EXPECT_FALSE(scene.extensions.contains(kPlacingKey)) << "nothing is left";
}

TEST(PlacingNotes, MoveWithTheScene) {
  Scene scene;
  MoveNotes(scene, [](const glm::dvec3& x) { return x; });
  EXPECT_TRUE(scene.extensions.empty()) << "there are none";
  PutNotes(scene, Sample());
  MoveNotes(scene, [](const glm::dvec3& x) { return 2.0 * x; });
  const PlacingNotes notes = NotesOf(scene);
  const ScenePoint& point = LandmarksOf(notes, "meniscus")->pairs[0].scene;
  EXPECT_EQ(point.x_in_portal, glm::dvec3(0.006, 0.002, 0.08));
  EXPECT_EQ(point.eye, glm::dvec3(0, 0, 0.02));
  EXPECT_DOUBLE_EQ(point.lateral_sigma, 2e-4);
}

TEST(PlacingNotes, OfAnotherVersionAreNoReasonNotToOpenAScene) {
  Scene scene;
  scene.extensions[kPlacingKey] = R"({"schema": "arthroscene.placing/9"})";
  EXPECT_TRUE(NotesOf(scene).empty());
  const Scene before = scene;
  RenameInNotes(scene, "meniscus", "medial meniscus");
  MirrorInNotes(scene, "meniscus", 0);
  MoveNotes(scene, [](const glm::dvec3& x) { return 2.0 * x; });
  EXPECT_EQ(scene.extensions, before.extensions) << "kept for the version that reads them";
}

}  // namespace
}  // namespace arthro::authoring
