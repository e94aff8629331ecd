#include "simulation/practice/first_hour/first_hour.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "simulation/core/units.h"

namespace arthro::simulation {
namespace {

constexpr double kLargestTrial = 1.0;  // N
constexpr double kShareOfPeak = 1.0 / 3;
constexpr double kMostAside = 0.5;  // share of the motion, perpendicular to the push
constexpr double kRounding = 1e-9;

const char* const kNotReady =
    "the device was not ready; run `arthroscene devices --self-test` and follow its sentence";
const char* const kNotArmed =
    "the dead-man was not taken, or was held from the start; release it, then hold it";
const char* const kWasLost = "the device was lost during the push; see to its cable";

// Why a trial that should have lasted was not carried out; nullptr where it was.
const char* WhyNotDone(const TrialReport& report) {
  switch (report.end) {
    case TrialEnd::kDone:
      return nullptr;
    case TrialEnd::kNotReady:
      return kNotReady;
    case TrialEnd::kNotArmed:
      return kNotArmed;
    case TrialEnd::kReleased:
      return "the dead-man was released before the end; hold it until the push ends";
    case TrialEnd::kLost:
      return kWasLost;
    case TrialEnd::kStopped:
      return "it was ended";
  }
  return kNotReady;
}

// Directions of a room as a right-handed frame: right, up, to the person.
glm::dvec3 DirectionOf(Way way) {
  switch (way) {
    case Way::kRight:
      return {1, 0, 0};
    case Way::kLeft:
      return {-1, 0, 0};
    case Way::kUp:
      return {0, 1, 0};
    case Way::kDown:
      return {0, -1, 0};
    case Way::kToMe:
      return {0, 0, 1};
    case Way::kAway:
      return {0, 0, -1};
  }
  return {0, 0, 0};
}

std::string NameOf(const glm::dvec3& force) {
  const int axis = force.x != 0 ? 0 : force.y != 0 ? 1 : 2;
  return fmt::format("{}{}", force[axis] < 0 ? '-' : '+', "xyz"[axis]);
}

// The measured motion of one push; "" where it follows the force.
std::string FaultOf(const Push& push) {
  const std::string name = NameOf(push.force);
  if (const char* why = WhyNotDone(push.report)) return fmt::format("{}: {}", name, why);
  const glm::dvec3 along = glm::normalize(push.force);
  const double motion = glm::dot(push.report.moved, along);
  const double aside = glm::length(push.report.moved - motion * along);
  if (motion <= -kLeastMotion)
    return fmt::format(
        "the push along {} moved the hand {:.1f} mm against it; a motor or an encoder is reversed",
        name, -MmFromMetres(motion));
  if (motion < kLeastMotion && aside < kLeastMotion)
    return fmt::format(
        "the push along {} moved the hand only {:.1f} mm; hold the handle more loosely, and see "
        "to the motor",
        name, MmFromMetres(motion));
  if (aside > kMostAside * std::max(motion, 0.0))
    return fmt::format(
        "the push along {} moved the hand {:.1f} mm along it and {:.1f} mm aside; two motors or "
        "encoders may be exchanged",
        name, MmFromMetres(motion), MmFromMetres(aside));
  return "";
}

// Ways of the three axes as felt; "" where they are those of a right-handed frame.
std::string FaultOfWays(std::span<const Push> pushes) {
  std::array<glm::dvec3, 3> felt{};
  for (const Push& push : pushes) {
    if (!push.way) return fmt::format("{}: nobody said where it went", NameOf(push.force));
    const int axis = push.force.x != 0 ? 0 : push.force.y != 0 ? 1 : 2;
    const double sign = push.force[axis] < 0 ? -1 : 1;
    const glm::dvec3 way = sign * DirectionOf(*push.way);
    glm::dvec3& known = felt[static_cast<std::size_t>(axis)];
    if (glm::length(known) > 0 && known != way)
      return fmt::format("the two pushes along {} were not felt as opposite", "xyz"[axis]);
    known = way;
  }
  const double handedness = glm::dot(glm::cross(felt[0], felt[1]), felt[2]);
  if (handedness == 0) return "two axes were felt along the same line";
  return handedness > 0 ? "" : "the axes were felt as a left-handed frame; one axis is mirrored";
}

}  // namespace

const char* ToString(HourStep step) noexcept {
  switch (step) {
    case HourStep::kZero:
      return "zero force";
    case HourStep::kDirection:
      return "direction";
    case HourStep::kScale:
      return "scale";
    case HourStep::kLimit:
      return "limit";
    case HourStep::kLoss:
      return "loss";
    case HourStep::kStop:
      return "stop";
  }
  return "";
}

double TrialForce(const DeviceCaps& caps) noexcept {
  return std::min(kLargestTrial, kShareOfPeak * caps.peak_force);
}

std::optional<Way> WayFromWord(const std::string& word) noexcept {
  constexpr std::array<std::pair<const char*, Way>, 6> kWords{{{"right", Way::kRight},
                                                               {"left", Way::kLeft},
                                                               {"up", Way::kUp},
                                                               {"down", Way::kDown},
                                                               {"to me", Way::kToMe},
                                                               {"away", Way::kAway}}};
  for (const auto& [known, way] : kWords)
    if (word == known) return way;
  return std::nullopt;
}

HourVerdict JudgeZero(const TrialReport& report, const DeviceCaps& caps, bool was_pushed) {
  if (const char* why = WhyNotDone(report)) return {false, why};
  if (report.largest > 0)
    return {false, fmt::format("{:.2f} N were commanded instead of none", report.largest)};
  if (report.rate < kLeastFreshShare * caps.rate)
    return {false, fmt::format("{:.0f} new samples a second came, {:.0f} are expected", report.rate,
                               caps.rate)};
  if (was_pushed) return {false, "the handle was felt to push or to buzz without a force"};
  return {true, fmt::format("no force for {:.1f} s at {:.0f} samples a second; the hand moved "
                            "{:.1f} mm",
                            report.seconds, report.rate, MmFromMetres(report.spread))};
}

HourVerdict JudgeDirection(std::span<const Push> pushes) {
  if (pushes.empty()) return {false, "no push was given"};
  double least = 1;
  for (const Push& push : pushes) {
    if (std::string fault = FaultOf(push); !fault.empty()) return {false, std::move(fault)};
    least = std::min(least, glm::dot(push.report.moved, glm::normalize(push.force)));
  }
  if (std::string fault = FaultOfWays(pushes); !fault.empty()) return {false, std::move(fault)};
  return {true, fmt::format("{} pushes moved the hand along their force, by {:.1f} mm or more",
                            pushes.size(), MmFromMetres(least))};
}

HourVerdict JudgeScale(std::span<const BalanceReading> readings) {
  if (readings.empty()) return {false, "no force was read on a balance"};
  std::string list;
  for (const BalanceReading& reading : readings) {
    if (!reading.read) return {false, "not measured; read each force on a spring balance"};
    list += fmt::format("{}{:.2f} N were read for {:.2f} N", list.empty() ? "" : ", ",
                        *reading.read, reading.asked);
    if (!(std::abs(*reading.read - reading.asked) <= kMostScaleError * reading.asked))
      return {false, fmt::format("{}; {:.0f} % off are too much, see to the model of the arm in "
                                 "the rig",
                                 list, 100 * std::abs(*reading.read / reading.asked - 1))};
  }
  return {true, list};
}

HourVerdict JudgeLimit(const TrialReport& report, const ForceTrial& trial) {
  if (const char* why = WhyNotDone(report)) return {false, why};
  const double wanted = glm::length(trial.force);
  if (report.largest > trial.limiter.max_force * (1 + kRounding))
    return {false, fmt::format("{:.2f} N were commanded where {:.2f} N are the limit",
                               report.largest, trial.limiter.max_force)};
  if (report.steepest > trial.limiter.max_rise * (1 + kRounding))
    return {false, fmt::format("the force rose by {:.0f} N/s where {:.0f} N/s are the limit",
                               report.steepest, trial.limiter.max_rise)};
  return {true, fmt::format("{:.0f} N were wanted, {:.2f} N were given, with a rise of {:.1f} N/s "
                            "at most",
                            wanted, report.largest, report.steepest)};
}

HourVerdict JudgeLoss(const TrialReport& report) {
  if (report.end == TrialEnd::kDone) return {false, "the cable was not pulled while it pushed"};
  if (report.end != TrialEnd::kLost) return {false, WhyNotDone(report)};
  if (report.largest == 0) return {false, "the cable was pulled before it pushed"};
  const std::string text = fmt::format("no force {:.1f} ms after the last sample; then {}",
                                       1e3 * report.silence, ToString(report.status.state));
  if (report.silence > kMostSilence + kClockGrain)
    return {false, fmt::format("{}; {:.0f} ms are the limit", text, 1e3 * kMostSilence)};
  return {true, text};
}

HourVerdict JudgeStop(const TrialReport& report, bool ended_at_once) {
  if (report.end == TrialEnd::kDone) return {false, "it was not stopped while it pushed"};
  if (report.end != TrialEnd::kReleased && report.end != TrialEnd::kLost)
    return {false, WhyNotDone(report)};
  if (report.largest == 0) return {false, "it was stopped before it pushed"};
  if (!ended_at_once) return {false, "the push did not end at once; do not use this device"};
  return {true, report.end == TrialEnd::kReleased ? "the force ended when the dead-man was released"
                                                  : "the force ended with the emergency switch"};
}

}  // namespace arthro::simulation
