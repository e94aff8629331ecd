// How far the force that the servo makes of a tissue between two steps of it is from the tissue's
// own: a tip strokes in and out of a tissue whose force is a closed form, of which the servo is
// told a few times a second, one step late. Ours (simulation/tissue/contact/coupling.h) beside the
// three that others use. [method.md, Tissue coupling] N, m, s.
#pragma once

#include <array>
#include <vector>

namespace arthro::test {

// Under a tool on a spring h, at a depth d of its tip: F = 500 x + 60 000 x² = h (d − x).
double BridgedForce(double depth) noexcept;

enum class Bridge { kHold, kSecant, kTangent, kOurs };
inline constexpr std::array kBridges{Bridge::kHold, Bridge::kSecant, Bridge::kTangent,
                                     Bridge::kOurs};
const char* Word(Bridge bridge) noexcept;

struct BridgeRow {
  Bridge bridge{};
  double step_rate = 0;    // Hz, of the tissue
  double stroke_rate = 0;  // Hz, of the tip: 2 mm ± 1.5 mm deep
  double rms = 0;          // share of the tissue's own rms
  double excess_step = 0;  // N, largest change in a tick beyond the tissue's own
  double seconds = 0;      // a tick, mean; of the rounds the least
};
BridgeRow MeasureBridge(Bridge bridge, double step_rate, double stroke_rate, int rounds);
std::vector<BridgeRow> MeasureBridges(int rounds);

}  // namespace arthro::test
