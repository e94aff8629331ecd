// WoodenHaptics, and Polhem version 1: what the board says and takes, and the arm between
// [devices.md, Report layouts]. Input 14 bytes (RawHID boards pad to 64): int16 encoder a to f,
// int16 info (bit 0: calibration button). Output: report ID 0 and 14 bytes: int16 current a, b, c
// in mA, int16 command, int16 attribute 0 to 2. Little-endian. Device frame (origin in the middle
// of the workspace, z up), m, N, A, rad.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "simulation/device/codec/report_bytes.h"

namespace arthro::simulation {

struct WoodenReport {
  std::array<std::int16_t, 6> encoder{};  // counts: three of the arm, three of the gimbal
  std::uint16_t info = 0;
};

// 14 bytes, or 64 where the board pads; anything else is no report.
std::optional<WoodenReport> ParseWooden(ReportBytes report) noexcept;

// The button of a Polhem is in its fourth encoder: 10000 is added while it is pressed. Taken out.
bool TakePolhemButton(WoodenReport& report) noexcept;

enum class WoodenCommand : std::int16_t { kCurrents = 0, kSetCounters = 1 };
// With the leading report ID, as it is written. Currents saturate at 32.767 A; see WoodenCurrents
// for the limit that protects hand and motors.
using WoodenOutput = std::array<std::uint8_t, 15>;
WoodenOutput WoodenCurrentReport(const glm::dvec3& amperes) noexcept;
// Sets the counters of the arm and of the gimbal.
WoodenOutput WoodenCounterReport(const std::array<std::int16_t, 6>& counts) noexcept;

// The arm. Values of the 2015 design.
struct WoodenArm {
  double counts_per_turn = 2000;                                // of a motor's encoder
  glm::dvec3 transmission{10.0 / 160, 10.0 / 120, 10.0 / 120};  // capstan over body diameter
  glm::dvec3 sign{1, 1, 1};                             // −1: that motor turns the other way
  double column = 0.080, upper = 0.205, lower = 0.245;  // m: base to axis, both links
  glm::dvec3 origin{0.0};                // m: what is called zero, in the base's frame
  double torque_constant = 0.0259;       // N m/A
  double gimbal_counts_per_turn = 1024;  // of the three last encoders; 0: it has no gimbal
  glm::dvec3 gimbal_sign{1, 1, 1};       // −1: that encoder counts the other way
  double largest_current = 3.0;          // A a motor
};

// Angles of base, upper and lower link, rad, from unwrapped counts.
glm::dvec3 WoodenAngles(const WoodenArm& arm, const std::array<std::int64_t, 6>& counts) noexcept;
glm::dvec3 WoodenPosition(const WoodenArm& arm, const glm::dvec3& angles) noexcept;
// ∂position/∂angles, m/rad; columns are angles.
glm::dmat3 WoodenJacobian(const WoodenArm& arm, const glm::dvec3& angles) noexcept;
// R = Rz(A) Ry(π/2 − C) Rx(D) Ry(E) Rx(F); without a gimbal no rotation.
glm::dquat WoodenHandle(const WoodenArm& arm, const glm::dvec3& angles,
                        const std::array<std::int64_t, 6>& counts) noexcept;
// Currents that push the hand with `force` (Jᵀ F through the transmission). Where a motor would
// need more than its largest, all three are scaled, so that the direction stays. Not finite: none.
glm::dvec3 WoodenCurrents(const WoodenArm& arm, const glm::dvec3& angles,
                          const glm::dvec3& force) noexcept;

// 16-bit counters that go on past their ends, and what cannot have been: a step of more than
// `largest_step` counts is rejected once, and believed when the next report agrees with it.
class EncoderUnwrap {
 public:
  explicit EncoderUnwrap(int largest_step) : largest_step_(largest_step) {}
  // False: rejected; `total` is as it was.
  bool Take(const std::array<std::int16_t, 6>& encoder) noexcept;
  const std::array<std::int64_t, 6>& total() const noexcept { return total_; }
  void Forget() noexcept { *this = EncoderUnwrap(largest_step_); }

 private:
  int largest_step_;
  bool has_last_ = false, has_doubt_ = false;
  std::array<std::int16_t, 6> last_{}, doubt_{};
  std::array<std::int64_t, 6> total_{};
};

}  // namespace arthro::simulation
