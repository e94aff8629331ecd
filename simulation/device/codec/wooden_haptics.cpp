#include "simulation/device/codec/wooden_haptics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include "simulation/core/finite.h"

namespace arthro::simulation {
namespace {

constexpr std::size_t kReport = 14, kPadded = 64;
constexpr int kPolhemButton = 10000, kPolhemPressed = 5000;  // counts
constexpr double kMilli = 1000.0;

// Returns the shorter difference of two 16-bit counts.
std::int32_t Way(std::int16_t from, std::int16_t to) noexcept {
  const int way = static_cast<int>(to) - static_cast<int>(from);
  return way > 32767 ? way - 65536 : way < -32768 ? way + 65536 : way;
}

}  // namespace

std::optional<WoodenReport> ParseWooden(ReportBytes report) noexcept {
  if (report.size() != kReport && report.size() != kPadded) return std::nullopt;
  WoodenReport parsed;
  for (std::size_t i = 0; i < 6; ++i) parsed.encoder[i] = SignedAt(report, 2 * i);
  parsed.info = UnsignedAt(report, 12);
  return parsed;
}

bool TakePolhemButton(WoodenReport& report) noexcept {
  std::int16_t& encoder = report.encoder[3];
  if (encoder <= kPolhemPressed) return false;
  encoder = static_cast<std::int16_t>(encoder - kPolhemButton);
  return true;
}

WoodenOutput WoodenCurrentReport(const glm::dvec3& amperes) noexcept {
  WoodenOutput report{};
  for (int i = 0; i < 3; ++i)
    PutSigned(report, 1 + 2 * static_cast<std::size_t>(i), Saturated(kMilli * amperes[i]));
  PutSigned(report, 7, static_cast<std::int16_t>(WoodenCommand::kCurrents));
  return report;
}

WoodenOutput WoodenCounterReport(const std::array<std::int16_t, 6>& counts) noexcept {
  WoodenOutput report{};
  for (std::size_t i = 0; i < 3; ++i) {
    PutSigned(report, 1 + 2 * i, counts[3 + i]);
    PutSigned(report, 9 + 2 * i, counts[i]);
  }
  PutSigned(report, 7, static_cast<std::int16_t>(WoodenCommand::kSetCounters));
  return report;
}

glm::dvec3 WoodenAngles(const WoodenArm& arm, const std::array<std::int64_t, 6>& counts) noexcept {
  glm::dvec3 angles;
  for (int i = 0; i < 3; ++i)
    angles[i] = arm.sign[i] * arm.transmission[i] * 2 * std::numbers::pi *
                static_cast<double>(counts[static_cast<std::size_t>(i)]) / arm.counts_per_turn;
  return angles;
}

glm::dvec3 WoodenPosition(const WoodenArm& arm, const glm::dvec3& angles) noexcept {
  const double reach = arm.upper * std::sin(angles.y) + arm.lower * std::sin(angles.z);
  return glm::dvec3(std::cos(angles.x) * reach, std::sin(angles.x) * reach,
                    arm.column + arm.upper * std::cos(angles.y) - arm.lower * std::cos(angles.z)) -
         arm.origin;
}

glm::dmat3 WoodenJacobian(const WoodenArm& arm, const glm::dvec3& angles) noexcept {
  const double ca = std::cos(angles.x), sa = std::sin(angles.x);
  const double reach = arm.upper * std::sin(angles.y) + arm.lower * std::sin(angles.z);
  const double b = arm.upper * std::cos(angles.y), c = arm.lower * std::cos(angles.z);
  return {glm::dvec3(-sa * reach, ca * reach, 0),
          glm::dvec3(ca * b, sa * b, -arm.upper * std::sin(angles.y)),
          glm::dvec3(ca * c, sa * c, arm.lower * std::sin(angles.z))};
}

glm::dquat WoodenHandle(const WoodenArm& arm, const glm::dvec3& angles,
                        const std::array<std::int64_t, 6>& counts) noexcept {
  if (!(arm.gimbal_counts_per_turn > 0)) return {1, 0, 0, 0};
  const auto turn = [&](std::size_t i) {
    return arm.gimbal_sign[static_cast<int>(i) - 3] * 2 * std::numbers::pi *
           static_cast<double>(counts[i]) / arm.gimbal_counts_per_turn;
  };
  const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  return glm::angleAxis(angles.x, z) * glm::angleAxis(0.5 * std::numbers::pi - angles.z, y) *
         glm::angleAxis(turn(3), x) * glm::angleAxis(turn(4), y) * glm::angleAxis(turn(5), x);
}

glm::dvec3 WoodenCurrents(const WoodenArm& arm, const glm::dvec3& angles,
                          const glm::dvec3& force) noexcept {
  if (!IsFinite(force) || !IsFinite(angles)) return glm::dvec3(0.0);
  const glm::dvec3 torque = glm::transpose(WoodenJacobian(arm, angles)) * force;
  const glm::dvec3 amperes = torque * arm.sign * arm.transmission / arm.torque_constant;
  const double most = std::max({std::abs(amperes.x), std::abs(amperes.y), std::abs(amperes.z)});
  if (!std::isfinite(most)) return glm::dvec3(0.0);
  return most > arm.largest_current ? amperes * (arm.largest_current / most) : amperes;
}

bool EncoderUnwrap::Take(const std::array<std::int16_t, 6>& encoder) noexcept {
  const auto goes_on_from = [&](const std::array<std::int16_t, 6>& from) {
    for (std::size_t i = 0; i < 6; ++i)
      if (std::abs(Way(from[i], encoder[i])) > largest_step_) return false;
    return true;
  };
  if (!has_last_) {
    for (std::size_t i = 0; i < 6; ++i) total_[i] = encoder[i];
  } else {
    // Rejects a leap once; if the next report agrees, it is the true position.
    if (!goes_on_from(last_) && !(has_doubt_ && goes_on_from(doubt_))) {
      doubt_ = encoder;
      has_doubt_ = true;
      return false;
    }
    for (std::size_t i = 0; i < 6; ++i) total_[i] += Way(last_[i], encoder[i]);
  }
  last_ = encoder;
  has_last_ = true;
  has_doubt_ = false;
  return true;
}

}  // namespace arthro::simulation
