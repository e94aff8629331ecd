// Places of a tissue and what its author took of it, as plain values in the tissue's own frame at
// rest (before the scale of its pose), m. Places and not lists of nodes, so that they outlive a new
// mesh; a cut less in the list is that cut undone.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/core/frames.h"

namespace arthro {

struct Ball {
  glm::dvec3 centre{0.0};
  double radius = 1e-3;
  friend bool operator==(const Ball&, const Ball&) = default;
};

// Part of a tissue by name, so that what is taken of it is told: "posterior horn".
struct Region {
  std::string name;
  Ball ball;
  friend bool operator==(const Region&, const Region&) = default;
};

// What is taken outside of all regions is told under this name; no region has it.
inline constexpr const char* kElsewhere = "elsewhere";

// A bite of round jaws, or a pass of the shaver; a ball where both ends are one.
struct CapsuleCut {
  glm::dvec3 a{0.0}, b{0.0};
  double radius = 1e-3;
  friend bool operator==(const CapsuleCut&, const CapsuleCut&) = default;
};
// A bite of square jaws: what lies in a box.
struct BoxCut {
  Rigid3 rest_from_box;
  glm::dvec3 half{1e-3};
  friend bool operator==(const BoxCut&, const BoxCut&) = default;
};
// A slot along a path on the surface, as deep as said along `into`. It begins `lead` before the
// path, so that it is open. Slots narrower than 1.5 spacings of a field would not separate and are
// made that wide.
struct TearCut {
  std::vector<glm::dvec3> path;  // two points at least
  glm::dvec3 into{0, 0, -1};
  double depth = 2e-3, width = 5e-4, lead = 1e-3;
  friend bool operator==(const TearCut&, const TearCut&) = default;
};
using Cut = std::variant<CapsuleCut, BoxCut, TearCut>;

// The same in a frame in which everything is `scale` times as large.
Ball Scaled(Ball ball, double scale);
Cut Scaled(Cut cut, double scale);

}  // namespace arthro
