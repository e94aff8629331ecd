// Codec and kinematics of WoodenHaptics and Polhem version 1 [devices.md, Report layouts]. Input 14
// bytes (RawHID boards pad to 64): int16 encoder a to f, int16 info (bit 0: calibration button).
// Output: report ID 0 and 14 bytes: int16 current a, b, c in mA, int16 command, int16 attribute 0
// to 2. Little-endian. Device frame (origin in the middle of the workspace, z up), m, N, A, rad.
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

// Decodes 14 bytes, or 64 where the board pads; nullopt for any other length.
std::optional<WoodenReport> ParseWooden(ReportBytes report) noexcept;

// Removes and returns the button of a Polhem from its fourth encoder, to which 10000 is added while
// it is pressed.
bool TakePolhemButton(WoodenReport& report) noexcept;

enum class WoodenCommand : std::int16_t { kCurrents = 0, kSetCounters = 1 };
// Encodes a report with its leading report ID. Currents saturate at 32.767 A; WoodenCurrents
// applies the limit that protects hand and motors.
using WoodenOutput = std::array<std::uint8_t, 15>;
WoodenOutput WoodenCurrentReport(const glm::dvec3& amperes) noexcept;
// Encodes the report that sets the counters of arm and gimbal.
WoodenOutput WoodenCounterReport(const std::array<std::int16_t, 6>& counts) noexcept;

// Geometry of the arm; values of the 2015 design.
struct WoodenArm {
  double counts_per_turn = 2000;                                // encoder of a motor
  glm::dvec3 transmission{10.0 / 160, 10.0 / 120, 10.0 / 120};  // ratio of capstan to body diameter
  glm::dvec3 sign{1, 1, 1};                             // −1: that motor turns the other way
  double column = 0.080, upper = 0.205, lower = 0.245;  // m: base to axis, both links
  glm::dvec3 origin{0.0};                               // m, device origin in the frame of the base
  double torque_constant = 0.0259;                      // N m/A
  double gimbal_counts_per_turn = 1024;                 // last three encoders; 0: no gimbal
  glm::dvec3 gimbal_sign{1, 1, 1};                      // −1: that encoder counts the other way
  double largest_current = 3.0;                         // A per motor
};

// Returns the angles of base, upper and lower link, rad, from unwrapped counts.
glm::dvec3 WoodenAngles(const WoodenArm& arm, const std::array<std::int64_t, 6>& counts) noexcept;
glm::dvec3 WoodenPosition(const WoodenArm& arm, const glm::dvec3& angles) noexcept;
// Returns ∂position/∂angles, m/rad; columns are angles.
glm::dmat3 WoodenJacobian(const WoodenArm& arm, const glm::dvec3& angles) noexcept;
// Returns R = Rz(A) Ry(π/2 − C) Rx(D) Ry(E) Rx(F); the identity without a gimbal.
glm::dquat WoodenHandle(const WoodenArm& arm, const glm::dvec3& angles,
                        const std::array<std::int64_t, 6>& counts) noexcept;
// Returns the currents that push the hand with `force` (Jᵀ F through the transmission). Where a
// motor would exceed its largest current, all three are scaled, which keeps the direction. A force
// that is not finite gives none.
glm::dvec3 WoodenCurrents(const WoodenArm& arm, const glm::dvec3& angles,
                          const glm::dvec3& force) noexcept;

// Unwraps 16-bit counters and rejects impossible steps: a step of more than `largest_step` counts
// is rejected once, and accepted when the next report agrees with it.
class EncoderUnwrap {
 public:
  explicit EncoderUnwrap(int largest_step) : largest_step_(largest_step) {}
  // Returns false where the step was rejected; `total` is then unchanged.
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
