#include "simulation/training/robot/robot.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "simulation/training/metrics/exercise_metrics.h"
#include "simulation/training/observe/surface_names.h"
#include "simulation/training/robot/steps/robot_mind.h"
#include "simulation/training/score/criteria.h"

namespace arthro::simulation {
namespace {

constexpr int kMostTries = 3;    // tries per step before the robot gives up
constexpr double kBegins = 0.3;  // s, in which a trainee looks at the picture

constexpr std::array<std::string_view, kRobotFaults> kFaultWords = {
    "none",       "too-slow",    "presses-too-hard", "looks-away",
    "off-centre", "leaves-line", "marks-beside",     "answers-wrong",
    "drops",      "enters-zone", "cuts-outside",     "gives-up"};

int FirstRunning(const StepEngine& engine) {
  const auto& steps = engine.steps();
  const auto found = std::find_if(steps.begin(), steps.end(), [](const StepResult& step) {
    return step.outcome == StepOutcome::kRunning;
  });
  return found == steps.end() ? -1 : static_cast<int>(found - steps.begin());
}

int LastStep(const Exercise& exercise) { return static_cast<int>(exercise.steps.size()) - 1; }

// Plants the faults of a novice that belong to no step.
void BeginWithFault(RobotMind& mind) {
  if (mind.Has(RobotFault::kTooSlow)) {
    const auto most = mind.MostOf("task_time", "");
    if (most) mind.hands.Wait(*most);
  }
  if (mind.Has(RobotFault::kEntersZone)) EnterZone(mind);
  if (mind.Has(RobotFault::kPressesTooHard))
    if (const auto most = mind.MostOf("peak_force", "scope")) RamScope(mind, 1.05 * *most);
}

void GiveUp(RobotMind& mind) {
  mind.joint.Act({ActKind::kStop, 0, "the robot gave up"});
  mind.hands.Wait(2 * kFrameTime);
}

void Practise(RobotMind& mind) {
  if (!mind.hands.Wait(kBegins)) return;
  BeginWithFault(mind);
  std::vector<int> tries(mind.exercise().steps.size(), 0);
  while (!mind.joint.HasEnded()) {
    mind.step = FirstRunning(mind.joint.engine());
    if (mind.step < 0) return GiveUp(mind);
    const ExerciseStep& step = mind.exercise().steps[static_cast<std::size_t>(mind.step)];
    const bool gives_up = mind.Has(RobotFault::kGivesUp) && mind.step == LastStep(mind.exercise());
    if (gives_up || tries[static_cast<std::size_t>(mind.step)]++ == kMostTries) {
      if (!gives_up) mind.Trouble("the step was tried as often as it may be");
      return GiveUp(mind);
    }
    std::visit([&](const auto& kind) { Do(mind, kind); }, step);
    if (!mind.joint.HasEnded()) mind.hands.Wait(2 * kFrameTime);
  }
}

}  // namespace

std::string_view ToString(RobotFault fault) { return kFaultWords[static_cast<std::size_t>(fault)]; }

std::optional<RobotFault> RobotFaultFromString(std::string_view word) {
  const auto found = std::ranges::find(kFaultWords, word);
  if (found == kFaultWords.end()) return std::nullopt;
  return static_cast<RobotFault>(found - kFaultWords.begin());
}

bool RobotMind::IsRunning() const {
  return !joint.HasEnded() && step >= 0 &&
         joint.engine().steps()[static_cast<std::size_t>(step)].outcome == StepOutcome::kRunning;
}

glm::dvec3 RobotMind::PlaceNow(int target) const {
  return glm::dvec3(joint.frame().sight.target[static_cast<std::size_t>(target)].place);
}

glm::dvec3 RobotMind::NormalOf(int target) const {
  const TargetPlace& place = joint.places()[static_cast<std::size_t>(target)];
  if (place.normal == glm::dvec3(0.0) || place.is_loose)
    return glm::normalize(joint.instrument_portal() - PlaceNow(target));
  if (place.tissue < 0) return place.normal;
  const Pose& pose = joint.loaded().scene.tissues[static_cast<std::size_t>(place.tissue)].pose;
  return pose.quaternion * place.normal;
}

double RobotMind::RadiusOf(int target) const {
  return exercise().targets[static_cast<std::size_t>(target)].radius;
}

std::optional<double> RobotMind::MostOf(const std::string& metric, const std::string& part) const {
  for (const Criterion& criterion : exercise().criteria)
    if (criterion.metric == metric && (part.empty() || criterion.part == part))
      return criterion.max;
  return std::nullopt;
}

PoseSearch RobotMind::Search(const std::vector<TargetPlace>& places) const {
  constexpr double kShaft = 2.5e-3;  // m; a tube that touches nothing, also where it trembles
  return {joint.loaded(), places, joint.view_angle(), joint.relief(), joint.eye(), kShaft, &trial};
}

void RobotMind::Trouble(const std::string& sentence) {
  const std::string id = step < 0 ? "" : joint.engine().steps()[static_cast<std::size_t>(step)].id;
  troubles.push_back(fmt::format("step \"{}\": {}", id, sentence));
}

bool WaitForStep(RobotMind& mind, double seconds) {
  for (int i = 0; i < FramesOf(seconds) && mind.IsRunning(); ++i) mind.hands.Wait(kFrameTime);
  return !mind.IsRunning();
}

RobotRun RunRobot(const LoadedScene& loaded, const Exercise& exercise,
                  const std::vector<TissuePreset>& presets, const RobotOptions& options,
                  AttemptLog* log) {
  RobotRun run;
  RobotJoint joint(loaded, exercise, presets, log);
  RobotHandsMover hands(joint, options);
  ScopeEye trial(loaded);
  RobotMind mind{joint, hands, options, run.troubles, trial, -1};
  Practise(mind);
  joint.Finish();
  run.frames = joint.frames();
  run.result = ResultOf(joint.engine(),
                        MeasureExercise(run.frames, joint.engine(), SurfaceNames(loaded.scene)));
  return run;
}

}  // namespace arthro::simulation
