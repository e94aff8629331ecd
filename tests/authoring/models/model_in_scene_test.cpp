// A model lands on the relief, its base along the normal.
#include "authoring/models/model_in_scene.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "authoring/models/model_library.h"
#include "authoring/models/model_thumbnail.h"
#include "simulation/scene/backdrop/hidden_share.h"

namespace arthro::authoring {
namespace {

// A picture of 200 x 150 degrees, with a relief of `height` metres everywhere.
Document SceneOf(float height) {
  Document document;
  Projection& projection = document.scene.backdrop.projection;
  projection.type = ProjectionType::kEquirectangular;
  projection.centre_px = {199.5, 149.5};
  projection.px_per_deg = 2;
  document.scene.backdrop.radius = 0.05;
  document.panorama = Share(ColourImage(400, 300));
  document.depth = Share(DepthMap(400, 300, height));
  return document;
}

TEST(ModelInScene, FindsTheReliefAndItsNormalOnASphere) {
  const Document document = SceneOf(0.01f);
  const auto point = FindOnRelief(document, {0.002, 0.001, 0.003}, {0.2, -0.3, 1}, 0.004);
  ASSERT_TRUE(point.has_value());
  // The march ends within a millionth of its step; float relief has 1e-9 m.
  EXPECT_NEAR(glm::length(point->place), 0.04, 1e-8);
  // The ring of samples is symmetric about the direction, to the rounding to pixels of half a
  // degree.
  EXPECT_GT(glm::dot(point->normal, -glm::normalize(point->place)), std::cos(0.02));
}

TEST(ModelInScene, LaysTheBaseOnTheReliefAlongItsNormal) {
  const Document document = SceneOf(0.01f);
  const LibraryModel model = MakeModel(DefaultOptionsOf(ModelKind::kLooseBody), KneeSide::kRight);
  const Pose pose = PoseOnRelief(model, document, glm::dvec3(0), {0, 0.5, 1});
  const glm::dvec3 z = pose.quaternion * glm::dvec3(0, 0, 1);
  EXPECT_GT(glm::dot(z, -glm::normalize(pose.position)), std::cos(0.02));
  EXPECT_NEAR(glm::length(pose.position), 0.04, 6.1e-3) << "lifted by 6 mm at most";
  EXPECT_LE(HiddenShare(model.surface, pose, *document.depth, document.scene.backdrop), 0.25);
  // Posterior points into the joint.
  EXPECT_GT((pose.quaternion * glm::dvec3(0, 1, 0)).z, 0);
}

// A groove of 2 degrees, 15 mm deeper than its surroundings, before the scope.
TEST(ModelInScene, IsSeenWhereTheReliefHasANarrowGroove) {
  Document document = SceneOf(0.02f);
  DepthMap depth = *document.depth;
  for (int y = 0; y < depth.height; ++y)
    for (int x = 198; x <= 201; ++x) depth.at(x, y) = 0.005f;
  document.depth = Share(depth);
  for (const ModelEntry& entry : ModelEntries()) {
    const LibraryModel model = MakeModel(DefaultOptionsOf(entry.kind), KneeSide::kRight);
    const Pose pose = PoseOnRelief(model, document, glm::dvec3(0), {0, 0, 1});
    EXPECT_LE(HiddenShare(model.surface, pose, *document.depth, document.scene.backdrop), 0.5)
        << entry.title;
  }
}

TEST(ModelInScene, WhereNothingWasImagedItLiesBeforeTheScope) {
  const Document document = SceneOf(std::nanf(""));
  const LibraryModel model = MakeModel(DefaultOptionsOf(ModelKind::kLooseBody), KneeSide::kRight);
  const Pose pose = PoseOnRelief(model, document, glm::dvec3(0), {0, 0, 1});
  EXPECT_NEAR(pose.position.z, 0.35 * 0.05, 1e-12);
}

TEST(ModelInScene, AddsItWithAFreeNameAndItsParts) {
  Document document = SceneOf(0);
  const LibraryModel model =
      MakeModel(DefaultOptionsOf(ModelKind::kMedialMeniscus), KneeSide::kLeft);
  AddModel(document, model, {}, {}, "/nowhere/m.vtu");
  AddModel(document, model, {}, {}, {});
  ASSERT_EQ(document.scene.tissues.size(), 2u);
  ASSERT_EQ(document.surfaces.size(), 2u);
  EXPECT_EQ(document.scene.tissues[1].name, "medial meniscus 2");
  EXPECT_EQ(document.scene.tissues[0].regions.size(), 3u);
  EXPECT_EQ(document.scene.tissues[0].fixed, model.fixed);
  EXPECT_EQ(document.files.at(document.scene.tissues[0].mesh.string()).file, "/nowhere/m.vtu");
  EXPECT_TRUE(document.scene.tissues[1].mesh.empty());
}

TEST(ModelThumbnail, FillsItsSquareWithFewTriangles) {
  for (const ModelEntry& entry : ModelEntries()) {
    const LibraryModel model = MakeModel(DefaultOptionsOf(entry.kind), KneeSide::kRight);
    const ModelThumbnail thumbnail = ThumbnailOf(model.surface, {});
    EXPECT_GT(thumbnail.facets.size(), 60u) << entry.title;
    EXPECT_LE(thumbnail.facets.size(), 500u);
    float widest = 0;
    for (const auto& facet : thumbnail.facets)
      for (const glm::vec2& x : facet.at) {
        EXPECT_GE(std::min(x.x, x.y), 0);
        EXPECT_LE(std::max(x.x, x.y), 1);
        widest = std::max({widest, std::abs(x.x - 0.5f), std::abs(x.y - 0.5f)});
      }
    EXPECT_GT(widest, 0.4f) << "the model fills its square";
  }
}

}  // namespace
}  // namespace arthro::authoring
