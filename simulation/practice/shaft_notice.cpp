#include "simulation/practice/shaft_notice.h"

namespace arthro::simulation {
namespace {

// Smaller turns and depths cannot be seen, and change from one moment to the next.
constexpr double kSeen = 1e-3;  // m

}  // namespace

const char* ShaftNotice(const ToolState& instrument) noexcept {
  if (instrument.shaft_through > kSeen)
    return "The shaft of the instrument passes through bone; draw it back and lead it around.";
  if (instrument.shaft_held > kSeen)
    return "Bone holds the shaft of the instrument; the tip goes no further this way.";
  return "";
}

}  // namespace arthro::simulation
