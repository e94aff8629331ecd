// First hour with a force device [safety.md, First hour]: six steps, each judged by what the
// program measured and by what the person at the device felt. A step that was not measured is not
// passed. Pure functions; device frame, m, N, s.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "simulation/practice/first_hour/force_trial.h"

namespace arthro::simulation {

enum class HourStep { kZero, kDirection, kScale, kLimit, kLoss, kStop };
inline constexpr std::array kHourSteps{HourStep::kZero,  HourStep::kDirection, HourStep::kScale,
                                       HourStep::kLimit, HourStep::kLoss,      HourStep::kStop};
const char* ToString(HourStep step) noexcept;

// Bounds of the steps. Own choices: no standard covers them.
inline constexpr double kLeastMotion = 2e-3;     // m, by which a push must move a loose hand
inline constexpr double kMostScaleError = 0.25;  // share of the asked force; read on a balance
inline constexpr double kLeastFreshShare = 0.8;  // share of the device's rate
inline constexpr double kMostSilence = 0.006;    // s, from the last sample to zero force

// Force of the trials: a third of the peak, at most 1 N.
double TrialForce(const DeviceCaps& caps) noexcept;

// Direction of a push, as its person felt it.
enum class Way { kRight, kLeft, kUp, kDown, kToMe, kAway };
std::optional<Way> WayFromWord(const std::string& word) noexcept;  // "right", … "to me", "away"

struct Push {
  glm::dvec3 force{0.0};  // N, wanted
  TrialReport report;
  std::optional<Way> way;
};
struct BalanceReading {
  double asked = 0;            // N
  std::optional<double> read;  // N
};

struct HourVerdict {
  bool has_passed = false;
  std::string sentence;  // measurement, or the fault and its remedy
};

HourVerdict JudgeZero(const TrialReport& report, const DeviceCaps& caps, bool was_pushed);
// `pushes`: along both directions of each axis that has a motor. Three axes must give three
// perpendicular ways and a right-handed frame.
HourVerdict JudgeDirection(std::span<const Push> pushes);
HourVerdict JudgeScale(std::span<const BalanceReading> readings);
HourVerdict JudgeLimit(const TrialReport& report, const ForceTrial& trial);
HourVerdict JudgeLoss(const TrialReport& report);
HourVerdict JudgeStop(const TrialReport& report, bool ended_at_once);

}  // namespace arthro::simulation
