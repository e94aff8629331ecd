// Lengths that the author of a scene knows and that set the scale of a relief.
#pragma once

#include <glm/vec2.hpp>

namespace arthro::authoring {

// A distance between the tissue at two pixels of the relief.
struct KnownLength {
  double metres = 0;
  glm::dvec2 from{0.0}, to{0.0};
};

// The diameter of an instrument that touches the tissue, from the two edges of its shaft at two
// pixels of a frame as it was filmed.
struct KnownInstrument {
  double metres = 0;
  int frame = 0;  // in the footage
  glm::dvec2 from{0.0}, to{0.0};
};

}  // namespace arthro::authoring
