// Origin of a depth in a relief: how each cell of the map came to its value [method.md, Scene].
// Stored as an 8-bit picture of the depth map's size.
#pragma once

#include <cstdint>

namespace arthro {

enum class ReliefOrigin : std::uint8_t {
  kNone = 0,         // no depth here
  kMeasured = 1,     // from the motion of the scope
  kBrightness = 2,   // estimated from brightness
  kInterpolated = 3  // spanned between cells that have a depth
};
inline constexpr ReliefOrigin kLastReliefOrigin = ReliefOrigin::kInterpolated;

}  // namespace arthro
