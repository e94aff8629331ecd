// Simulated force device with a hand that follows a recording and wanders about it, for long runs
// on the servo's own thread. It reads a clock of its own at each tick, and keeps what it was told.
// Device frame, m, N, s.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "simulation/core/random.h"
#include "simulation/device/plant_device.h"
#include "simulation/device/trace_io.h"
#include "simulation/practice/time_histogram.h"

namespace arthro::test {

class SoakHand final : public simulation::Device {
 public:
  // `rows` of one hand, at least two, in order of time.
  SoakHand(std::vector<simulation::TraceRow> rows, std::uint64_t seed, const char* serial);

  const simulation::DeviceCaps& caps() const noexcept override { return plant_.caps(); }
  const std::string& name() const noexcept override { return plant_.name(); }
  const std::string& serial() const noexcept override { return plant_.serial(); }
  simulation::DeviceSample Read(double now) noexcept override;
  void HoldDeadMan(bool is_held) noexcept override { plant_.HoldDeadMan(is_held); }
  void Command(const glm::dvec3& force) noexcept override;
  simulation::DeviceStatus status() const noexcept override { return plant_.status(); }

  // Draws the hand out, and presses its button; callable from any thread.
  void DrawOut(bool is_out) noexcept { is_out_ = is_out; }
  void Press(bool is_pressed) noexcept { is_pressed_ = is_pressed; }

  // Ends a stretch of ticks: the servo was stopped.
  void EndStretch() noexcept;

  // Read after the servo has stopped.
  struct Kept {
    long ticks = 0, left_out = 0;  // ticks by the hand's clock, and those that never came
    int stretches = 0;
    long not_finite = 0, above_peak = 0, pushed = 0;
    double largest = 0;  // N
    simulation::TimeHistogram between;
  };
  const Kept& kept() const noexcept { return kept_; }

 private:
  glm::dvec3 Intent(double t) noexcept;

  std::vector<simulation::TraceRow> rows_;
  Random random_;
  simulation::PlantDevice plant_;
  std::atomic<bool> is_out_{false}, is_pressed_{false};
  glm::dvec3 wander_{0.0}, drift_{0.0};
  double first_ = 0, last_ = 0;  // s, first and newest tick of this stretch
  double begin_ = -1;            // s, first tick at all
  long ticks_ = 0;               // ticks of this stretch
  double out_ = 0;               // share of the way out
  Kept kept_;
};

}  // namespace arthro::test
