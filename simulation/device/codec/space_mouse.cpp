#include "simulation/device/codec/space_mouse.h"

#include <algorithm>

namespace arthro::simulation {
namespace {

constexpr double kFullPush = 350.0;  // counts
constexpr std::uint8_t kPush = 1, kTurn = 2, kButtons = 3, kLight = 4, kBattery = 0x17;
constexpr std::size_t kThreeAxes = 7, kSixAxes = 13;  // bytes, the ID included

glm::dvec3 AxesAt(ReportBytes report, std::size_t at) noexcept {
  glm::dvec3 axes;
  for (int i = 0; i < 3; ++i)
    axes[i] =
        std::clamp(SignedAt(report, at + 2 * static_cast<std::size_t>(i)) / kFullPush, -1.0, 1.0);
  return axes;
}

}  // namespace

SpaceMouseNews TakeReport(ReportBytes report, SpaceMouse& mouse) noexcept {
  using enum SpaceMouseNews;
  if (report.empty()) return kRejected;
  switch (report[0]) {
    case kPush:
      if (report.size() != kThreeAxes && report.size() != kSixAxes) return kRejected;
      mouse.push = AxesAt(report, 1);
      if (report.size() == kSixAxes) mouse.turn = AxesAt(report, 7);
      return kTaken;
    case kTurn:
      if (report.size() != kThreeAxes) return kRejected;
      mouse.turn = AxesAt(report, 1);
      return kTaken;
    case kButtons: {
      if (report.size() < 2 || report.size() > 9) return kRejected;
      std::uint32_t buttons = 0;
      for (std::size_t i = 1; i < std::min<std::size_t>(report.size(), 5); ++i)
        buttons |= static_cast<std::uint32_t>(report[i]) << (8 * (i - 1));
      mouse.buttons = buttons;
      return kTaken;
    }
    case kBattery:
      return kIgnored;
    default:
      return kRejected;
  }
}

std::array<std::uint8_t, 2> SpaceMouseLight(bool is_on) noexcept {
  return {kLight, static_cast<std::uint8_t>(is_on ? 1 : 0)};
}

}  // namespace arthro::simulation
