// Energy that rigid surfaces give a hand over slow closed cycles. The hand is led from free space
// into contact and back along a random closed curve; the work is that of the force which the device
// gets. Everything between the sample and that force is the program's own session. J, m, s.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "simulation/core/progress.h"
#include "simulation/practice/session.h"
#include "simulation/scene/files/scene_io.h"

namespace arthro::test {

// A backdrop to touch, and what it is made of.
struct CycleGround {
  std::string name;
  LoadedScene loaded;
};
// Depth maps of 96 x 72 and 1024 x 768 pixels: hills, steps, holes and edges, noise, 8 bits; and
// the bare sphere.
std::vector<CycleGround> CycleGrounds();

struct EnergyCycle {
  double speed = 0;         // m/s, of the hand
  double deepest = 0;       // m, penetration
  double strongest = 0;     // N, on the hand
  double largest_rise = 0;  // N, of the force in a tick
  // Work on the hand: over the whole cycle, and the most between two moments without a force. The
  // force of a tick acts until the next one.
  double work = 0, gain = 0;
};

// One session over a ground; each cycle enters anew and depends on its number alone.
class CycleHand {
 public:
  explicit CycleHand(const CycleGround& ground);
  EnergyCycle Go(std::uint64_t number);

 private:
  double radius_, spacing_;
  Projection projection_;
  glm::dvec2 size_px_;
  simulation::Session session_;
  double t_ = 0;
};

// The cycle that gains most of `count` on each ground; a negative gain: every one loses energy.
struct EnergyRow {
  std::string ground;
  int cycles = 0, touched = 0;
  std::uint64_t worst = 0;  // its number
  EnergyCycle cycle;
  double largest_rise = 0;  // N in a tick, of all cycles
};
std::vector<EnergyRow> MeasureEnergy(int count, const Progress& progress);

}  // namespace arthro::test
