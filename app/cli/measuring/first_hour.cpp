#include "app/cli/measuring/first_hour.h"

#include <algorithm>
#include <cstdlib>
#include <optional>

#include <fmt/format.h>
#include <glm/vec3.hpp>

namespace arthro::app {
namespace {

using namespace simulation;

constexpr double kShort = 2;     // s, of one push
constexpr double kReading = 10;  // s, of a push that is read on a balance
constexpr double kPulling = 20;  // s, within which a cable is pulled or a switch pressed
// A person's key confirms a push; the dead-man counts as released for this long before it.
constexpr double kReleased = 0.05;    // s
constexpr double kBalanceFactor = 2;  // second force on the balance by that of the trials
constexpr double kFarTooMuch = 100;   // N, which the limiter must hold back

// The person ends the conversation.
struct Ended {};

class Conversation {
 public:
  Conversation(Device& device, const HourTicks& ticks, const Person& person)
      : device_(device), ticks_(ticks), person_(person), force_(TrialForce(device.caps())) {}

  std::vector<HourRow> Run() {
    try {
      Introduce();
      for (const HourStep step : kHourSteps) {
        person_.tell(fmt::format("\nStep {} of {}: {}", rows_.size() + 1, kHourSteps.size(),
                                 ToString(step)));
        rows_.push_back({step, Judge(step)});
        person_.tell(fmt::format("{}: {}.", rows_.back().verdict.has_passed ? "passed" : "FAILED",
                                 rows_.back().verdict.sentence));
        if (!rows_.back().verdict.has_passed && !IsYes("Go on with the next step?")) break;
      }
    } catch (const Ended&) {
      person_.tell("Ended.");
    }
    return std::move(rows_);
  }

 private:
  void Introduce() {
    person_.tell(fmt::format(
        "The program gives forces of at most {:.2f} N. Stand so that the handle cannot reach your "
        "face.\nKeep the emergency switch or the plug of the device within reach of the other "
        "hand.\nAn answer of \"stop\" ends the walk.",
        kBalanceFactor * force_));
    if (device_.caps().buttons > 0)
      uses_button_ = IsYes(
          "Does the handle have a button that you can hold (else a key confirms "
          "each push)?");
  }

  HourVerdict Judge(HourStep step) {
    switch (step) {
      case HourStep::kZero:
        return Zero();
      case HourStep::kDirection:
        return Direction();
      case HourStep::kScale:
        return Scale();
      case HourStep::kLimit:
        return Limit();
      case HourStep::kLoss:
        return Loss();
      case HourStep::kStop:
        return Stop();
    }
    return {};
  }

  HourVerdict Zero() {
    const TrialReport report =
        Try("Hold the handle loosely; no force is given", {glm::dvec3(0.0), Limits(), kShort});
    return JudgeZero(report, device_.caps(), IsYes("Did the handle push or buzz?"));
  }

  HourVerdict Direction() {
    std::vector<Push> pushes;
    for (int axis = 0; axis < std::min(3, device_.caps().actuated_dof); ++axis)
      for (const double sign : {1.0, -1.0}) {
        Push push;
        push.force[axis] = sign * force_;
        push.report = Try(fmt::format("Hold the handle loosely; a push of {:.2f} N along {}{}",
                                      force_, sign > 0 ? '+' : '-', "xyz"[axis]),
                          {push.force, Limits(), kShort});
        if (push.report.end == TrialEnd::kDone) push.way = AskWay();
        pushes.push_back(push);
      }
    return JudgeDirection(pushes);
  }

  HourVerdict Scale() {
    person_.tell(
        "Hook a spring balance to the handle. Hold the handle still by the balance alone.");
    std::vector<BalanceReading> readings;
    for (const double share : {1.0, kBalanceFactor}) {
      const double asked = share * force_;
      ForceTrial trial{{0, 0, 0}, Limits(), kReading};
      trial.force[0] = asked;
      trial.limiter.max_force = asked;
      const TrialReport report =
          Try(fmt::format("Read the balance; {:.2f} N along +x", asked), trial);
      readings.push_back({asked, std::nullopt});
      if (report.end == TrialEnd::kDone) readings.back().read = AskNewtons();
    }
    return JudgeScale(readings);
  }

  HourVerdict Limit() {
    const ForceTrial trial{{kFarTooMuch, 0, 0}, Limits(), kShort};
    return JudgeLimit(Try(fmt::format("The program wants {:.0f} N; its limiter gives {:.2f} N",
                                      kFarTooMuch, force_),
                          trial),
                      trial);
  }

  HourVerdict Loss() {
    HourVerdict verdict =
        JudgeLoss(Try("Pull the cable of the device out of the computer while it pushes",
                      {{force_, 0, 0}, Limits(), kPulling}));
    Ask("Plug the cable in again; then press Enter");
    return verdict;
  }

  HourVerdict Stop() {
    const TrialReport report =
        Try(uses_button_ ? "Release the button while it pushes"
                         : "Press the emergency switch, or pull the plug, while it pushes",
            {{force_, 0, 0}, Limits(), kPulling});
    return JudgeStop(report, IsYes("Did the push end at once?"));
  }

  LimiterOptions Limits() const {
    LimiterOptions limits;
    limits.max_force = force_;
    return limits;
  }

  TrialReport Try(const std::string& what, const ForceTrial& trial) {
    Ask(uses_button_ ? what + ". Press Enter, then hold the button"
                     : fmt::format("{}. Enter starts {:.0f} s", what, trial.seconds));
    if (!uses_button_) person_.tell("Ctrl-C ends it.");
    std::optional<double> begin;
    const TrialTicks ticks{[&] {
                             const double now = ticks_.next();
                             if (!begin) begin = now;
                             return now;
                           },
                           [&](const DeviceSample& sample) {
                             return uses_button_ ? sample.buttons != 0
                                                 : sample.t > *begin + kReleased;
                           },
                           ticks_.stops};
    const TrialReport report = TryForce(device_, trial, ticks);
    if (report.end == TrialEnd::kStopped) throw Ended();
    return report;
  }

  std::string Ask(const std::string& question) {
    std::string answer = person_.ask(question + ": ");
    if (answer == "stop" || ticks_.stops()) throw Ended();
    return answer;
  }

  bool IsYes(const std::string& question) {
    for (;;) {
      const std::string answer = Ask(question + " yes/no");
      if (answer == "yes" || answer == "y") return true;
      if (answer == "no" || answer == "n") return false;
      person_.tell("Answer yes or no.");
    }
  }

  Way AskWay() {
    for (;;) {
      if (const auto way = WayFromWord(Ask("Where did it push? right/left/up/down/to me/away")))
        return *way;
      person_.tell("Answer with one of these words.");
    }
  }

  // nullopt: there is no balance.
  std::optional<double> AskNewtons() {
    for (;;) {
      const std::string answer = Ask("Reading in N (100 g on a scale are 0.98 N; none: -)");
      if (answer == "-") return std::nullopt;
      char* end = nullptr;
      const double read = std::strtod(answer.c_str(), &end);
      if (end != answer.c_str() && *end == '\0' && read >= 0 && read < kFarTooMuch) return read;
      person_.tell("Answer with a number of newtons, such as 0.95.");
    }
  }

  Device& device_;
  const HourTicks& ticks_;
  const Person& person_;
  const double force_;
  bool uses_button_ = false;
  std::vector<HourRow> rows_;
};

std::string_view VerdictOf(const std::vector<HourRow>& rows, HourStep step) {
  const auto row =
      std::find_if(rows.begin(), rows.end(), [&](const HourRow& own) { return own.step == step; });
  return row == rows.end() ? "not done" : row->verdict.has_passed ? "passed" : "FAILED";
}

}  // namespace

std::vector<HourRow> TakeFirstHour(Device& device, const HourTicks& ticks, const Person& person) {
  return Conversation(device, ticks, person).Run();
}

bool HasPassed(const std::vector<HourRow>& rows) {
  return rows.size() == kHourSteps.size() &&
         std::all_of(rows.begin(), rows.end(),
                     [](const HourRow& row) { return row.verdict.has_passed; });
}

std::string RecordText(const std::vector<HourRow>& rows, const Device& device,
                       const std::string& date, const std::string& version) {
  std::string text = fmt::format(
      "First hour with a force device\n\nDevice   {}\nSerial   {}\nDate     {}\nProgram  {}\n\n",
      device.name(), device.serial().empty() ? "none" : device.serial(), date, version);
  for (const HourStep step : kHourSteps) {
    text += fmt::format("{:<10}  {}\n", VerdictOf(rows, step), ToString(step));
    for (const HourRow& row : rows)
      if (row.step == step) text += fmt::format("            {}\n", row.verdict.sentence);
  }
  return text + fmt::format("\n{}\n\nName, signature  ____________________________________\n",
                            HasPassed(rows)
                                ? "All six steps passed."
                                : "Not all steps passed: give no forces with this device.");
}

}  // namespace arthro::app
