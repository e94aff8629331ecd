// Orientation of a scene by arrows that its author draws on the panorama: "this way is up", "this
// way is medial". The backdrop and the tissues turn about the direction straight ahead of the
// portal; no pixel changes.
#pragma once

#include <optional>

#include <glm/vec2.hpp>

#include "authoring/project/document.h"

namespace arthro::authoring {

struct PanoramaArrow {
  glm::dvec2 from{0.0}, to{0.0};  // px of the panorama
};

struct Orientation {
  std::optional<PanoramaArrow> up, medial;
};

// Medial is on the right of a right knee that is seen from the front with the patella up, and on
// the left of a left one. With both arrows the side follows; with medial alone it must be known.
// Returns the turn, rad. Throws Error(kBadArgument): no arrow, one without length, arrows that are
// not at right angles within 30 degrees, medial alone without a side, both with the other side.
double OrientBackdrop(Document& document, const Orientation& orientation);

}  // namespace arthro::authoring
