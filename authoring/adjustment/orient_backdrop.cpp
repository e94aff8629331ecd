#include "authoring/adjustment/orient_backdrop.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "authoring/alignment/placing_notes.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

constexpr double kRightAngle = std::numbers::pi / 2;
constexpr double kMostSkew = RadiansFromDegrees(30);  // angle that two arrows drawn by hand miss

double Wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

// Angle of an arrow about the direction straight ahead, from +x towards +y.
double AngleOf(const PanoramaArrow& arrow, const Projection& projection, const char* name) {
  const glm::dvec3 along =
      DirectionFromPixel(projection, arrow.to) - DirectionFromPixel(projection, arrow.from);
  if (!(glm::length(glm::dvec2(along)) > 1e-6))
    throw Error(
        Code::kBadArgument,
        fmt::format("the arrow of \"{}\" has no length; draw it from one point to another", name));
  return std::atan2(along.y, along.x);
}

}  // namespace

double OrientBackdrop(Document& document, const Orientation& orientation) {
  Scene& scene = document.scene;
  Projection& projection = scene.backdrop.projection;
  if (!orientation.up && !orientation.medial)
    throw Error(Code::kBadArgument,
                "no direction is given; say what is up, what is medial, or both");
  double turn = 0;
  if (orientation.up) turn = Wrapped(-kRightAngle - AngleOf(*orientation.up, projection, "up"));
  if (orientation.medial) {
    const double medial = AngleOf(*orientation.medial, projection, "medial");
    if (orientation.up) {
      // Angle of medial once up is up: 0 on the right, 180 degrees on the left.
      const double turned = Wrapped(medial + turn);
      const BodySide side = std::cos(turned) > 0 ? BodySide::kRight : BodySide::kLeft;
      const double skew = side == BodySide::kRight ? turned : Wrapped(turned - 2 * kRightAngle);
      if (std::abs(skew) > kMostSkew)
        throw Error(
            Code::kBadArgument,
            fmt::format("up and medial are at {:.0f} degrees, not at right angles; draw one "
                        "of the arrows anew",
                        DegreesFromRadians(kRightAngle - std::abs(skew))));
      if (scene.side != BodySide::kUnknown && scene.side != side)
        throw Error(
            Code::kBadArgument,
            fmt::format("up and medial belong to a {} knee, and the scene says {}; mend the "
                        "side or an arrow",
                        side == BodySide::kRight ? "right" : "left",
                        side == BodySide::kRight ? "left" : "right"));
      scene.side = side;
      turn = Wrapped(turn - skew / 2);  // neither arrow is exact
    } else {
      if (scene.side == BodySide::kUnknown)
        throw Error(Code::kBadArgument,
                    "medial is right in a right knee and left in a left one; say which knee it is, "
                    "or what is up");
      turn = Wrapped((scene.side == BodySide::kRight ? 0 : 2 * kRightAngle) - medial);
    }
  }
  projection.roll = Wrapped(projection.roll + turn);
  const glm::dquat about_ahead = glm::angleAxis(turn, glm::dvec3(0, 0, 1));
  for (Tissue& tissue : scene.tissues) {
    tissue.pose.position = about_ahead * tissue.pose.position;
    tissue.pose.quaternion = glm::normalize(about_ahead * tissue.pose.quaternion);
  }
  MoveNotes(scene, [&](const glm::dvec3& x) { return about_ahead * x; });
  return turn;
}

}  // namespace arthro::authoring
