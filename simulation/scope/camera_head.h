// How the camera's head is held on the scope's eyepiece [method.md, Oblique view]: as in the paper
// it turns with the scope, or the other hand holds it upright while the scope turns in it; in
// either it can be turned on. With κ = 0 the picture's up is the rod's north, carried from the
// rod's direction to the view's along the shortest arc. rad, up towards right.
#pragma once

#include <string_view>

namespace arthro::simulation {

struct CameraHead {
  bool is_upright = false;
  double turn = 0;  // from upright, or from the scope's own mark
  friend bool operator==(const CameraHead&, const CameraHead&) = default;
};

// κ of a scope whose roll is γ.
inline double HeadRoll(const CameraHead& head, double roll) noexcept {
  return (head.is_upright ? 0.0 : roll) + head.turn;
}

// Of command lines: "scope" turns with it, "upright" is held. Throws Error(kBadArgument).
CameraHead CameraHeadFromString(std::string_view word);

}  // namespace arthro::simulation
