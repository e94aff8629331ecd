#include "simulation/device/codec/razer_hydra.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace arthro::simulation {
namespace {

constexpr std::size_t kFirstHand = 8, kHandBytes = 22, kShortest = 50, kLongest = 64;

double Unit(std::int16_t value) { return std::clamp(value / 32767.0, -1.0, 1.0); }

std::optional<HydraHand> HandAt(ReportBytes part) noexcept {
  HydraHand hand;
  for (int i = 0; i < 3; ++i)
    hand.position[i] = 1e-3 * SignedAt(part, 2 * static_cast<std::size_t>(i));
  const auto turn = [&](std::size_t i) { return SignedAt(part, 6 + 2 * i) / 32768.0; };
  const glm::dquat q(turn(0), turn(1), turn(2), turn(3));
  const double length = glm::length(q);
  if (!(std::abs(length - 1.0) < 0.1)) return std::nullopt;
  hand.orientation = q / length;
  hand.buttons = part[14] & 0x7f;
  hand.stick = {Unit(SignedAt(part, 15)), Unit(SignedAt(part, 17))};
  hand.trigger = part[19] / 255.0;
  return hand;
}

}  // namespace

std::optional<std::array<HydraHand, 2>> ParseHydra(ReportBytes report) noexcept {
  if (report.size() < kShortest || report.size() > kLongest) return std::nullopt;
  const auto first = HandAt(report.subspan(kFirstHand, kHandBytes - 2)),
             second = HandAt(report.subspan(kFirstHand + kHandBytes, kHandBytes - 2));
  if (!first || !second) return std::nullopt;
  return std::array{*first, *second};
}

std::array<std::uint8_t, 91> HydraMotionReport(bool is_on) noexcept {
  std::array<std::uint8_t, 91> report{};
  report[6] = 1;
  report[8] = 4;
  report[9] = is_on ? 3 : 0;
  report[89] = is_on ? 6 : 5;
  return report;
}

}  // namespace arthro::simulation
