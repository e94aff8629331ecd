// Error of the servo's force between two steps of a tissue [method.md, Tissue coupling]. A tip
// strokes in and out of a tissue whose force is a closed form; the servo gets a few samples per
// second, one step late. Compares simulation/tissue/contact/coupling.h with three common methods.
// N, m, s.
#pragma once

#include <array>
#include <vector>

namespace arthro::test {

// Under a tool on a spring h, at a depth d of its tip: F = 500 x + 60 000 x² = h (d − x).
double BridgedForce(double depth) noexcept;

enum class Bridge { kHold, kSecant, kTangent, kOurs };
inline constexpr std::array kBridges{Bridge::kHold, Bridge::kSecant, Bridge::kTangent,
                                     Bridge::kOurs};
const char* ToString(Bridge bridge) noexcept;

struct BridgeRow {
  Bridge bridge{};
  double step_rate = 0;    // Hz, of the tissue
  double stroke_rate = 0;  // Hz, of the tip: 2 mm ± 1.5 mm deep
  double rms = 0;          // relative to the tissue's own rms
  double excess_step = 0;  // N, largest change per tick beyond the tissue's own
  double seconds = 0;      // per tick, mean; the least of all rounds
};
BridgeRow MeasureBridge(Bridge bridge, double step_rate, double stroke_rate, int rounds);
std::vector<BridgeRow> MeasureBridges(int rounds);

}  // namespace arthro::test
