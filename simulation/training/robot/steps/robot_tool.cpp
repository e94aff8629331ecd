// Steps that are done with the instrument, and the answer to a question.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "simulation/scope/disturbances.h"
#include "simulation/training/robot/steps/robot_mind.h"
#include "simulation/training/steps/exercise_index.h"

namespace arthro::simulation {
namespace {

constexpr double kAbove = 6e-3;         // m over a surface, from where a tip approaches
constexpr double kApproach = 10e-3;     // m/s without contact
constexpr double kFeels = 0.05;         // N, from which the hand feels a contact
constexpr double kPressSpeed = 6e-3;    // m/s per N that is missing
constexpr double kFastestPress = 5e-3;  // m/s
constexpr double kDeepest = 0.03;       // m behind the surface
constexpr double kTries = 8.0;          // s, for a force to be reached and held
constexpr double kTouch = 0.4;          // N, of a light touch

// Roll that turns the hook of a probe away from a surface.
double RollAwayFrom(const RobotMind& mind, const glm::dvec3& x, const glm::dvec3& normal) {
  const RodBasis basis = BasisOf(PoseOfTip(mind.joint.instrument_portal(), x, 0));
  return std::atan2(glm::dot(normal, basis.east), glm::dot(normal, basis.north));
}

// A tip over a point of a surface, that goes up and down along the normal.
struct Press {
  glm::dvec3 place, normal;
  double roll, height;
};

RodPose PoseOf(const RobotMind& mind, const Press& press) {
  return PoseOfTip(mind.joint.instrument_portal(), press.place + press.height * press.normal,
                   press.roll);
}

// `aslant`: 0 along the surface's normal, 1 along the rod.
bool Approach(RobotMind& mind, int target, double aslant, Press& press) {
  press.place = mind.PlaceNow(target);
  const glm::dvec3 back = glm::normalize(mind.joint.instrument_portal() - press.place);
  press.normal = glm::normalize((1 - aslant) * mind.NormalOf(target) + aslant * back);
  press.roll = RollAwayFrom(mind, press.place, mind.NormalOf(target));
  press.height = kAbove;
  return mind.hands.Lead(DeviceRole::kInstrument, PoseOf(mind, press));
}

bool MoveTo(RobotMind& mind, Press& press, double height) {
  press.height = height;
  RobotHands to = mind.hands.at();
  to.instrument = PoseOf(mind, press);
  return mind.hands.Frame(to);
}

// Presses with a force until `until` holds. Returns false where it does not within the time.
template <class Until>
bool PressWith(RobotMind& mind, Press& press, double force, const Until& until) {
  for (int i = 0; i < FramesOf(kTries); ++i) {
    if (until()) return true;
    const double now = InstrumentOf(mind).mean_force;
    const double speed =
        now < kFeels ? kApproach
                     : std::clamp(kPressSpeed * (force - now), -kFastestPress, kFastestPress);
    if (press.height < -kDeepest) return false;
    if (!MoveTo(mind, press, press.height - speed * kFrameTime)) return false;
  }
  return until();
}

bool Retreat(RobotMind& mind, Press& press) {
  press.height = kAbove;
  return mind.hands.Leg(DeviceRole::kInstrument, PoseOf(mind, press));
}

// A novice presses too hard before it finds the right force.
void Overshoot(RobotMind& mind, Press& press) {
  const auto most = mind.MostOf("peak_force", "instrument");
  if (!mind.Has(RobotFault::kPressesTooHard) || !most) return;
  PressWith(mind, press, 1.3 * *most,
            [&] { return InstrumentOf(mind).peak_force > static_cast<float>(1.05 * *most); });
}

// A force surely in the band, near its lower end.
double LightForce(const glm::dvec2& band) {
  return std::min(1.4 * band.x, 0.5 * (band.x + band.y));
}

// Targets of this step and of those that follow it with the instrument.
std::vector<int> WorkFrom(const RobotMind& mind) {
  std::vector<int> targets;
  const auto& steps = mind.exercise().steps;
  for (auto i = static_cast<std::size_t>(mind.step); i < steps.size(); ++i) {
    if (!UsesInstrument(steps[i])) break;
    for (const int target : TargetsOf(mind.exercise(), steps[i]))
      if (std::ranges::find(targets, target) == targets.end()) targets.push_back(target);
  }
  return targets;
}

// Distance from which haze lets the tip be seen.
double FarthestIn(double haze) {
  constexpr double kShare = 0.9;
  return haze > 0 ? kShare * std::log(1 / kLeastTransmittance) / (kHazeExtinction[1] * haze)
                  : kFarthestLook;
}

// The free pose with the present insertion whose view is farthest from a point.
RodPose PoseAwayFrom(const RobotMind& mind, const glm::dvec3& x) {
  const PoseSearch search = mind.Search({TargetInBall(x, 1e-3)});
  RodPose away = mind.hands.at().scope;
  float farthest = 0;
  for (const double roll : PoseSearch::Rolls())
    for (const double degrees : {-45.0, -30.0, -15.0, 0.0, 15.0, 30.0, 45.0}) {
      RodPose pose = mind.hands.at().scope;
      pose.roll = roll;
      pose.longitude = RadiansFromDegrees(degrees);
      const float centre = search.See(pose).target[0].centre;
      if (centre <= farthest || !search.IsFree(pose)) continue;
      farthest = centre, away = pose;
    }
  return away;
}

// Turns the scope away from the tip and waits, while the instrument is in the joint.
void LookAway(RobotMind& mind) {
  if (!mind.Has(RobotFault::kLooksAway)) return;
  constexpr double kAway = 25.0;  // s
  const RodPose before = mind.hands.at().scope;
  const RodPose away = PoseAwayFrom(mind, mind.hands.InstrumentTip());
  if (!mind.hands.Lead(DeviceRole::kScope, away) || !mind.hands.Wait(kAway)) return;
  mind.hands.Lead(DeviceRole::kScope, before);
}

std::size_t ProbedCount(const RobotMind& mind) {
  const auto& events = mind.joint.engine().events();
  return static_cast<std::size_t>(std::ranges::count_if(
      events, [](const AttemptEvent& event) { return event.kind == EventKind::kProbed; }));
}

// Presses a target until the step has it, from other directions where the tip slips off.
bool PressTarget(RobotMind& mind, int target, double force) {
  bool overshoots = true;
  for (const double aslant : {0.0, 1.0, 0.5}) {
    Press press{};
    if (!mind.IsRunning() || !Approach(mind, target, aslant, press)) return true;
    if (std::exchange(overshoots, false)) {
      if (mind.step == 0) LookAway(mind);
      Overshoot(mind, press);
    }
    const std::size_t before = ProbedCount(mind);
    const auto is_probed = [&] { return !mind.IsRunning() || ProbedCount(mind) > before; };
    const auto has_slipped = [&] {
      return InstrumentOf(mind).contact != kNoContact &&
             glm::distance(glm::dvec3(InstrumentOf(mind).drawn_tip), mind.PlaceNow(target)) >
                 mind.RadiusOf(target);
    };
    PressWith(mind, press, force, [&] { return is_probed() || has_slipped(); });
    const bool is_done = is_probed();
    if (!Retreat(mind, press) || is_done) return true;
  }
  return false;
}

void PressEach(RobotMind& mind, const ExerciseStep& step, const glm::dvec2& force,
               double farthest) {
  const std::vector<int> work = WorkFrom(mind), targets = TargetsOf(mind.exercise(), step);
  LookAtWork(mind, farthest < kFarthestLook ? targets : work, farthest);
  for (const int target : targets)
    if (!PressTarget(mind, target, LightForce(force)))
      mind.Trouble(fmt::format("the tip does not stay on \"{}\" with {:.2g} N",
                               mind.exercise().targets[static_cast<std::size_t>(target)].id,
                               LightForce(force)));
}

// A point inside the target, away from a place.
glm::dvec3 Within(const glm::dvec3& target, const glm::dvec3& from, double metres) {
  return target + metres * glm::normalize(target - from);
}

}  // namespace

void Do(RobotMind& mind, const ProbeStep& step) {
  PressEach(mind, step, step.force, kFarthestLook);
}

void Do(RobotMind& mind, const RecoverStep& step) {
  PressEach(mind, step, step.force, FarthestIn(step.haze));
}

void Do(RobotMind& mind, const MeasureStep& step) {
  const std::vector<int> targets = TargetsOf(mind.exercise(), step);
  LookAtWork(mind, WorkFrom(mind), kFarthestLook);
  for (std::size_t i = 0; i < targets.size() && mind.IsRunning(); ++i) {
    Press press{};
    if (!Approach(mind, targets[i], 0, press)) return;
    if (i == 0 && mind.Has(RobotFault::kMarksBeside)) {
      const double off = 1.3 * mind.MostOf("measure_error", "").value_or(0);
      const glm::dvec3 other = mind.PlaceNow(targets[(i + 1) % targets.size()]);
      press.place = Within(press.place, other, -off);
    }
    if (i == 0) Overshoot(mind, press);
    if (!PressWith(mind, press, kTouch, [&] {
          return InstrumentOf(mind).mean_force > static_cast<float>(0.8 * kTouch) &&
                 InstrumentOf(mind).mean_force < static_cast<float>(2 * kTouch);
        }))
      mind.Trouble("the tip does not touch the point to mark");
    mind.joint.Act({ActKind::kMark, 0, ""});
    mind.hands.Wait(kSettle);
    if (!Retreat(mind, press)) return;
  }
}

void Do(RobotMind& mind, const TransferStep& step) {
  const int goal = TargetIndex(mind.exercise(), step.to);
  int drops = mind.Has(RobotFault::kDrops) ? 2 : 0;
  for (const int body : TargetsOf(mind.exercise(), step)) {
    constexpr int kGrasps = 4;
    LookAtWork(mind, {body}, kFarthestLook);
    for (int i = 0; i < kGrasps && mind.IsRunning(); ++i) {
      if (!mind.hands.Close(false, kSettle)) return;
      const glm::dvec3 place = mind.PlaceNow(body), to = mind.PlaceNow(goal);
      if (glm::distance(place, to) <= mind.RadiusOf(goal)) break;
      // The jaws come along the rod, until the body is between them.
      const glm::dvec3 portal = mind.joint.instrument_portal();
      const double roll = mind.hands.at().instrument.roll;
      const glm::dvec3 back = glm::normalize(portal - place);
      const glm::dvec3 grip = place + mind.RadiusOf(body) * back;
      if (!mind.hands.Lead(DeviceRole::kInstrument, PoseOfTip(portal, grip, roll))) return;
      if (!mind.hands.Close(true, 2 * kSettle)) return;
      const glm::dvec3 tip = mind.hands.InstrumentTip();
      const glm::dvec3 end = to + (tip - mind.PlaceNow(body));
      RodPose there = PoseOfTip(portal, end, roll);
      if (there.depth > mind.RadiusOf(goal)) there.depth = mind.RadiusOf(goal);
      // Straight back along the rod first, then into the goal.
      RodPose lifted = mind.hands.at().instrument;
      lifted.depth = std::max(there.depth, 2e-3);
      if (drops > 0) {
        lifted.depth = 0.5 * (lifted.depth + mind.hands.at().instrument.depth);
        --drops;
        if (!mind.hands.Leg(DeviceRole::kInstrument, lifted)) return;
        if (!mind.hands.Close(false, 1.5)) return;
        continue;
      }
      if (!mind.hands.Leg(DeviceRole::kInstrument, lifted)) return;
      if (glm::distance(mind.PlaceNow(body), to) > mind.RadiusOf(goal)) {
        RodPose nearer = lifted;
        nearer.depth = 2e-3;
        if (!mind.hands.Leg(DeviceRole::kInstrument, nearer)) return;
      }
      if (!mind.hands.Close(false, 4 * kSettle)) return;
    }
  }
  WaitForStep(mind, 1.0);
}

void Do(RobotMind& mind, const AnswerStep& step) {
  const auto choices = static_cast<int>(step.choices.size());
  const bool is_wrong = mind.Has(RobotFault::kAnswersWrong) && choices > 1;
  mind.joint.Act({ActKind::kAnswer, is_wrong ? (step.right + 1) % choices : step.right, ""});
  WaitForStep(mind, kSettle);
}

void TouchTooHard(RobotMind& mind, int target) {
  if (!mind.Has(RobotFault::kPressesTooHard)) return;
  Press press{};
  if (!Approach(mind, target, 0, press)) return;
  Overshoot(mind, press);
  Retreat(mind, press);
}

void EnterZone(RobotMind& mind) {
  if (mind.exercise().avoid.empty()) return mind.Trouble("the exercise has no zone to avoid");
  const AvoidZone& zone = mind.exercise().avoid.front();
  const int target = TargetIndex(mind.exercise(), zone.target);
  const glm::dvec3 x = mind.PlaceNow(target);
  const bool has_instrument = std::ranges::any_of(mind.exercise().steps, UsesInstrument);
  const bool by_scope =
      zone.by == AvoidBy::kScope || (zone.by == AvoidBy::kBoth && !has_instrument);
  const glm::dvec3 portal = by_scope ? glm::dvec3(0.0) : mind.joint.instrument_portal();
  const DeviceRole role = by_scope ? DeviceRole::kScope : DeviceRole::kInstrument;
  const RodPose before =
      role == DeviceRole::kScope ? mind.hands.at().scope : mind.hands.at().instrument;
  const glm::dvec3 in = x + 0.5 * mind.RadiusOf(target) * glm::normalize(portal - x);
  if (!mind.hands.Lead(role, PoseOfTip(portal, in, before.roll))) return;
  mind.hands.Wait(kSettle);
  mind.hands.Lead(role, before);
}

}  // namespace arthro::simulation
