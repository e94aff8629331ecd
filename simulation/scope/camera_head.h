// Orientation of the camera head on the eyepiece of the scope [method.md, Oblique view]. As in the
// paper it turns with the scope, or the other hand holds it upright while the scope turns in it;
// both can be turned further. With κ = 0 the up direction of the picture is north of the rod,
// carried from the direction of the rod to that of the view along the shortest arc. rad, from up
// towards right.
#pragma once

#include <string_view>

namespace arthro::simulation {

struct CameraHead {
  bool is_upright = false;
  double turn = 0;  // rad, from upright, or from the mark of the scope
  friend bool operator==(const CameraHead&, const CameraHead&) = default;
};

// Returns κ for a scope with roll γ.
inline double HeadRoll(const CameraHead& head, double roll) noexcept {
  return (head.is_upright ? 0.0 : roll) + head.turn;
}

// Reads a flag: "scope" turns with it, "upright" is held. Throws Error(kBadArgument).
CameraHead CameraHeadFromString(std::string_view word);

}  // namespace arthro::simulation
