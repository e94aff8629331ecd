// Simulated hands on a sampled wall: largest stable stiffness, rest of random hands, energy that
// they gain [method.md, Stability; benchmarks.md, Haptics]. The wall is the program's own contact
// and output chain on a bare sphere so large that it is flat, with one tick per period of the
// plant's clock. m, N, s.
#pragma once

#include <cstdint>

#include "simulation/device/hand_plant.h"
#include "simulation/haptics/contact.h"
#include "simulation/haptics/output/output_chain.h"

namespace arthro::test {

// Parameters of a servo.
struct WallServo {
  double period = 1e-3;
  int delay = 1;  // ticks
  double stiffness = 500, damping = 1;
  bool is_guarded = true;
};

// The largest stiffness of the linear wall F = −K x − B v, v the difference of two samples, on a
// released device (45 g, 0.2 N s/m, no friction, no quantum), to 0.2 %.
double LargestStableStiffness(double period, double damping, int delay);
// (b + B)/(T/2 + t_d).
double RuleStiffness(double period, double damping, int delay);

// A flat wall, free where x > 0, and a Touch-class device with a hand on it.
class TouchedWall {
 public:
  TouchedWall(const WallServo& servo, const simulation::PlantOptions& device,
              const simulation::HandModel& hand, double at);
  void SetIntent(double x) noexcept { plant_.SetIntent({0, 0, kWall - x}); }
  void Tick() noexcept;
  double position() const noexcept { return kWall - plant_.position().z; }
  double work() const noexcept { return plant_.work(); }
  double force() const noexcept { return force_; }  // N, sent last
  simulation::HandPlant& plant() noexcept { return plant_; }

 private:
  static constexpr double kWall = 10.0;  // m, radius: flat to 1e-7 m over a millimetre
  WallServo servo_;
  simulation::DepthField field_;
  simulation::ContactOptions contact_;
  simulation::PassivityOptions passivity_;
  simulation::ThermalOptions thermal_;
  simulation::LimiterOptions limiter_;
  simulation::ContactState state_;
  simulation::OutputState output_;
  simulation::HandPlant plant_;
  glm::dvec3 hand_{0.0};
  double force_ = 0;
};

struct HandTrial {
  double swing = 0;       // m, in the last quarter of the time
  double energy_out = 0;  // J, that the wall gave in all, beyond what it took
  bool has_escaped = false;
};
// A hand drawn by its number, from 2 mm before the wall to an aim up to 8 mm behind it at 0.04 to
// 0.2 m/s, and held there: 0.7 s. Escaped: it swings by more than half a millimetre in the end and
// not less than before, or it comes back further than where it began, for which the wall must have
// given it energy.
HandTrial TryRandomHand(std::uint64_t number, const WallServo& servo);

// J, the most that the wall gives to a hand between touching it and leaving it again, over strokes
// of 0.5 to 8 Hz and 1 to 4 mm.
double MostEnergyOut(const simulation::HandModel& hand, const WallServo& servo);

}  // namespace arthro::test
