// Last stage of the output chain, which every force passes [method.md, Output chain]. In this
// order: not a number → zero and a fault · length clamped, direction kept · rise limited, fall free
// · hand too fast → zero · ramp after arming. After a fault the ramp starts again. N, s, m/s;
// noexcept, allocates nothing.
#pragma once

#include <glm/vec3.hpp>

#include "simulation/core/options.h"
#include "simulation/haptics/output/fault.h"

namespace arthro::simulation {

struct LimiterOptions {
  double max_force = 3.3;         // N; peak of a Touch-class device
  double max_rise = 300.0;        // N/s; a 1 N/mm wall met at 0.2 m/s needs 200
  double max_hand_speed = 1.0;    // m/s; surgery stays below 0.5
  double ramp_time = 0.5;         // s; armed inside tissue, a hand is pushed out gently
  double max_sample_age = 0.005;  // s; five missed reports
  double lost_after = 0.020;      // s
  template <class V>
  void Visit(V&& v) {
    v("max_force", max_force, Range{0, 20}, "N", "Largest force that is sent to a device.");
    v("max_rise", max_rise, Range{10, 10000}, "N/s",
      "Largest rise of a force; it may fall at once.");
    v("max_hand_speed", max_hand_speed, Range{0.05, 10}, "m/s", "A faster hand gets no force.");
    v("ramp_time", ramp_time, Range{0, 5}, "s",
      "Time from no force to full force after arming or a fault.");
    v("max_sample_age", max_sample_age, Range{0.001, 1}, "s",
      "A sample of this age gets no force.");
    v("lost_after", lost_after, Range{0.001, 10}, "s",
      "With no new sample for this long a device is lost.");
  }
};

struct LimiterState {
  glm::dvec3 held{0.0};  // force before the ramp
  double ramp = 0;       // 0..1
};

struct LimitedForce {
  glm::dvec3 force{0.0};
  Fault fault = Fault::kNone;
};

// Limits a force. A `fault` of an earlier stage (no sample, stale…) gives zero. `hand_speed` in
// m/s.
LimitedForce LimitForce(const LimiterOptions& options, const glm::dvec3& force, double hand_speed,
                        Fault fault, double dt, LimiterState& state) noexcept;

}  // namespace arthro::simulation
