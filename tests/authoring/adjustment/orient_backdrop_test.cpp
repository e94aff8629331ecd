#include "authoring/adjustment/orient_backdrop.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

Document SceneWith(BodySide side) {
  Document document;
  document.scene.side = side;
  Projection& projection = document.scene.backdrop.projection;
  projection.centre_px = {500, 400};
  projection.focal_px = 600;
  document.scene.tissues.emplace_back().pose.position = {0.01, 0, 0.03};
  return document;
}

// An arrow through the centre of the picture at an angle from +x, towards +y.
PanoramaArrow Arrow(double degrees) {
  const double angle = RadiansFromDegrees(degrees);
  const glm::dvec2 along(std::cos(angle), std::sin(angle));
  return {glm::dvec2(500, 400) - 50.0 * along, glm::dvec2(500, 400) + 50.0 * along};
}

// Direction of an arrow of the picture as it is seen from the portal.
glm::dvec2 Seen(const Document& document, const PanoramaArrow& arrow) {
  const Projection& projection = document.scene.backdrop.projection;
  return glm::normalize(glm::dvec2(DirectionFromPixel(projection, arrow.to) -
                                   DirectionFromPixel(projection, arrow.from)));
}

TEST(OrientBackdrop, WhatIsUpPointsUpAndTissuesTurnWithThePicture) {
  Document document = SceneWith(BodySide::kUnknown);
  const auto pixel = PixelFromDirection(document.scene.backdrop.projection,
                                        document.scene.tissues[0].pose.position);
  OrientBackdrop(document, {Arrow(20), {}});
  EXPECT_NEAR(Seen(document, Arrow(20)).x, 0, 1e-12);
  EXPECT_NEAR(Seen(document, Arrow(20)).y, -1, 1e-12);
  const auto after = PixelFromDirection(document.scene.backdrop.projection,
                                        document.scene.tissues[0].pose.position);
  EXPECT_LT(glm::distance(*pixel, *after), 1e-9) << "the tissue lies on the same pixel";
}

TEST(OrientBackdrop, MedialIsOnTheRightOfARightKneeAndOnTheLeftOfALeftOne) {
  for (const auto& [side, x] : {std::pair{BodySide::kRight, 1.0}, {BodySide::kLeft, -1.0}}) {
    Document document = SceneWith(side);
    OrientBackdrop(document, {{}, Arrow(130)});
    EXPECT_NEAR(Seen(document, Arrow(130)).x, x, 1e-12);
  }
}

TEST(OrientBackdrop, BothArrowsGiveTheSideAndShareTheirError) {
  Document document = SceneWith(BodySide::kUnknown);
  OrientBackdrop(document, {Arrow(-90), Arrow(190)});  // medial to the left, 10 degrees off
  EXPECT_EQ(document.scene.side, BodySide::kLeft);
  const glm::dvec2 up = Seen(document, Arrow(-90));
  EXPECT_NEAR(DegreesFromRadians(std::atan2(up.x, -up.y)), -5, 1e-9);
}

TEST(OrientBackdrop, RefusesInOneSentence) {
  const auto refuses = [](BodySide side, const Orientation& orientation) {
    Document document = SceneWith(side);
    EXPECT_THROW(OrientBackdrop(document, orientation), Error);
    EXPECT_EQ(document.scene.backdrop.projection.roll, 0);
  };
  refuses(BodySide::kUnknown, {});
  refuses(BodySide::kUnknown, {{}, Arrow(0)});                       // unknown side
  refuses(BodySide::kUnknown, {Arrow(-90), Arrow(-60)});             // no right angle
  refuses(BodySide::kLeft, {Arrow(-90), Arrow(0)});                  // a right knee
  refuses(BodySide::kUnknown, {PanoramaArrow{{1, 1}, {1, 1}}, {}});  // no length
}

}  // namespace
}  // namespace arthro::authoring
