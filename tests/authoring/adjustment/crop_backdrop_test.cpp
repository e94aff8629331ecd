#include "authoring/adjustment/crop_backdrop.h"

#include <gtest/gtest.h>

#include "authoring/adjustment/scale_backdrop.h"
#include "authoring/project/document_io.h"
#include "simulation/core/error.h"
#include "tests/support/small_scene.h"
#include "tests/support/temp_folder.h"

namespace arthro::authoring {
namespace {

TEST(CropBackdrop, KeepsTheDirectionAndTheDepthOfEveryPixelThatIsLeft) {
  const test::TempFolder folder;
  const Document whole = OpenDocument(test::WriteSmallScene(folder / "scene"));
  Document part = whole;
  CropBackdrop(part, {120, 40, 200, 150});
  ASSERT_EQ(part.panorama->width, 200);
  ASSERT_EQ(part.depth->height, 150);
  for (const auto& [x, y] : {std::pair{0, 0}, {199, 149}, {77, 31}}) {
    EXPECT_EQ(part.depth->at(x, y), whole.depth->at(x + 120, y + 40));
    const auto at = [](const ColourImage& image, int column, int row) {
      return image.rgb[3 * (static_cast<std::size_t>(row) * image.width + column) + 1];
    };
    EXPECT_EQ(at(*part.panorama, x, y), at(*whole.panorama, x + 120, y + 40));
    EXPECT_EQ(DirectionFromPixel(part.scene.backdrop.projection, {x, y}),
              DirectionFromPixel(whole.scene.backdrop.projection, {x + 120, y + 40}));
  }
  // The saved part is opened as it was.
  SaveDocument(part, folder / "part");
  EXPECT_EQ(OpenDocument(folder / "part").panorama->rgb, part.panorama->rgb);
}

TEST(CropBackdrop, TwoCropsAreOneOfTheRecord) {
  const test::TempFolder folder;
  Document document = OpenDocument(test::WriteSmallScene(folder / "scene"));
  FootageRecord record;
  record.clips.emplace_back().fingerprint = "1-2";
  document.footage = Share(std::move(record));
  CropBackdrop(document, {120, 40, 200, 150});
  CropBackdrop(document, {10, 20, 100, 100});
  EXPECT_EQ(document.footage->crop, (PixelBox{130, 60, 100, 100}));
}

TEST(CropBackdrop, StrokesStayOnTheirTissue) {
  const test::TempFolder folder;
  Document document = OpenDocument(test::WriteSmallScene(folder / "scene"));
  // Pixel (200, 100) of 400, with a radius of 12 px.
  document.depth_strokes = Share(DepthStrokes{{.radius = 0.03, .points = {{0.5, 0.25}}}});
  CropBackdrop(document, {120, 40, 200, 150});
  const DepthStroke& stroke = document.depth_strokes->at(0);
  EXPECT_NEAR(stroke.points[0].x, 80.0 / 200, 1e-12);
  EXPECT_NEAR(stroke.points[0].y, 60.0 / 200, 1e-12);
  EXPECT_NEAR(stroke.radius, 12.0 / 200, 1e-12);
}

TEST(CropBackdrop, RefusesAPartThatIsNotOne) {
  const test::TempFolder folder;
  Document document = OpenDocument(test::WriteSmallScene(folder / "scene"));
  for (const PixelBox& box : {PixelBox{300, 0, 200, 100}, {-1, 0, 50, 50}, {0, 0, 4, 100}})
    EXPECT_THROW(CropBackdrop(document, box), Error);
  EXPECT_EQ(document.panorama->width, 400);
}

TEST(ScaleBackdrop, MakesTheTwoPixelsAsFarApartAsTheAuthorSays) {
  const test::TempFolder folder;
  Document document = OpenDocument(test::WriteSmallScene(folder / "scene"));
  const double before = document.scene.backdrop.radius;
  const KnownLength length{0.02, {120, 150}, {260, 150}};
  const double factor = ScaleBackdrop(document, length);
  EXPECT_NEAR(document.scene.backdrop.radius, factor * before, 1e-12);
  EXPECT_NEAR(document.scene.tissues[0].pose.position.z, factor * 0.03, 1e-12);
  EXPECT_EQ(document.scene.tissues[0].pose.scale, 1) << "a tissue keeps its own size";
  // The relief is stored in 32 bits, 6e-8 of its value.
  EXPECT_NEAR(ScaleBackdrop(document, length), 1, 1e-6) << "they are that far apart now";
  EXPECT_THROW(ScaleBackdrop(document, {0.02, {120, 150}, {120, 150}}), Error);
  EXPECT_THROW(ScaleBackdrop(document, {3.0, {120, 150}, {260, 150}}), Error);
}

TEST(ScaleBackdrop, ABareSphereHasASizeToo) {
  const test::TempFolder folder;
  Document document = OpenDocument(test::WriteSmallScene(folder / "scene"));
  SetDepth(document, nullptr);
  // Two pixels at equal distances from the centre of the picture: 2 radius sin(angle).
  const glm::dvec2 centre = document.scene.backdrop.projection.centre_px;
  const double chord = 2 * 0.05 * std::sin(std::atan2(75.0, 150.0));
  EXPECT_NEAR(
      ScaleBackdrop(document, {2 * chord, centre - glm::dvec2(75, 0), centre + glm::dvec2(75, 0)}),
      2, 0.01)
      << "a pixel is read at its centre: half a pixel of 150 at either end";
}

}  // namespace
}  // namespace arthro::authoring
