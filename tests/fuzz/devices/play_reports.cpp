#include "tests/fuzz/devices/play_reports.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace arthro::test {
namespace {

constexpr std::uint8_t kOpened = 255, kHome = 254;

bool IsFinite(const glm::dvec3& v) { return std::isfinite(v.x + v.y + v.z); }

void CheckHand(const simulation::DeviceDriver& driver, const simulation::HandReading& hand) {
  Require(IsFinite(hand.sample.hip_in_device), "the place of a hand is finite");
  Require(std::abs(glm::length(hand.sample.handle_in_device) - 1) < 1e-6,
          "the orientation of a handle is a unit quaternion");
  Require(IsFinite(hand.push) && IsFinite(hand.turn) && IsFinite(hand.joints),
          "pushes, turns and joints are finite");
  for (const glm::dvec3& push : {hand.push, hand.turn})
    for (int axis = 0; axis < 3; ++axis)
      Require(std::abs(push[axis]) <= 1, "a push is between -1 and 1");
  for (const glm::dvec3& force : {glm::dvec3(0), glm::dvec3(1, -2, 3), glm::dvec3(NAN, 1e308, 0)}) {
    const simulation::OutputReport report = driver.ForceReport(force, hand.joints);
    Require(report.size <= report.bytes.size(), "a report fits into its room");
  }
}

}  // namespace

void PlayReports(simulation::DeviceDriver& driver, std::string_view bytes) {
  while (!bytes.empty()) {
    const auto length = static_cast<std::uint8_t>(bytes.front());
    bytes.remove_prefix(1);
    if (length == kOpened) {
      driver.Forget();
    } else if (length == kHome) {
      driver.AskHome();
    } else {
      const std::string_view report = bytes.substr(0, length);
      bytes.remove_prefix(report.size());
      driver.Take({reinterpret_cast<const std::uint8_t*>(report.data()), report.size()});
    }
    if (driver.WantsHome()) driver.HomeReport();
    for (int hand = 0; hand < driver.hands(); ++hand) CheckHand(driver, driver.Hand(hand));
  }
}

}  // namespace arthro::test
