// Robots at the exercises of the demo scene, as they are installed: an expert passes each of them;
// a novice with a planted fault misses exactly the criteria that name the fault; each attempt has
// the same result from its log. ARTHRO_ROBOT_SEEDS=20 tries both with the seeds 1 to 20.
#include "simulation/training/robot/robot.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "simulation/scene/files/scene_io.h"
#include "simulation/training/attempt_words.h"
#include "simulation/training/observe/surface_names.h"
#include "simulation/training/robot/robot_joint.h"
#include "simulation/training/score/recorded_result.h"
#include "tests/support/build_paths.h"
#include "tests/support/temp_folder.h"

namespace arthro::simulation {
namespace {

const std::filesystem::path kResources = std::filesystem::path(ARTHRO_SOURCE_DIR) / "resources";

const LoadedScene& Demo() {
  static const LoadedScene loaded = LoadScene(kResources / "demo");
  return loaded;
}

const std::vector<TissuePreset>& Presets() {
  static const std::vector<TissuePreset> presets =
      ReadTissuePresets(kResources / "presets" / "tissues");
  return presets;
}

const Exercise& ExerciseOf(const std::string& id) {
  const auto& exercises = Demo().scene.exercises;
  const auto found = std::ranges::find(exercises, id, &Exercise::id);
  if (found == exercises.end()) throw std::runtime_error("there is no exercise " + id);
  return *found;
}

// All of a result, with every bit of its numbers.
std::string TextOf(const AttemptResult& result) {
  const auto number = [](const std::optional<double>& value) {
    return value ? fmt::format("{:a}", *value) : std::string("none");
  };
  std::string text =
      fmt::format("{} {} {:a}\n", ToString(result.outcome), result.reason, result.duration);
  for (const StepResult& step : result.steps)
    text += fmt::format("{} {} {:a} {}\n", step.id, ToString(step.outcome), step.began,
                        number(step.ended));
  for (const CriterionResult& each : result.criteria)
    text += fmt::format("{} {} {} {}\n", each.metric, each.part, number(each.value), each.is_met);
  for (const MetricValue& value : result.metrics)
    text += fmt::format("{} {} {} {}\n", value.metric->id, value.part, number(value.value),
                        value.why_none);
  for (const AttemptEvent& event : result.events)
    text += fmt::format("{:a} {} {} {} {:a} {}\n", event.t, ToString(event.kind), event.step,
                        event.target, event.value, event.note);
  return text;
}

// Runs a robot, and expects the same result from the log of its attempt.
RobotRun RunWithLog(const Exercise& exercise, const RobotOptions& options) {
  const test::TempFolder folder;
  AttemptLog log(folder / "robot.attempt", std::vector<LogSource>{{"", "", "1", {}}}, "{}");
  RobotRun run = RunRobot(Demo(), exercise, Presets(), options, &log);
  log.Close();
  const RecordedAttempt recorded = ReadAttempt(folder / "robot.attempt");
  EXPECT_EQ(recorded.torn, "");
  EXPECT_TRUE(recorded.frames == run.frames);
  EXPECT_EQ(TextOf(ResultOfRecording(recorded, exercise, SurfaceNames(Demo().scene))),
            TextOf(run.result));
  return run;
}

std::set<std::string> Missed(const AttemptResult& result) {
  std::set<std::string> missed;
  for (const CriterionResult& criterion : result.criteria)
    if (!criterion.is_met) missed.insert(criterion.metric);
  return missed;
}

std::string Troubles(const RobotRun& run) {
  std::string text;
  for (const std::string& sentence : run.troubles) text += sentence + "\n";
  for (const CriterionResult& criterion : run.result.criteria)
    text += fmt::format("{} {} {}\n", criterion.is_met ? "met" : "missed", criterion.metric,
                        criterion.value.value_or(-1));
  return text;
}

struct Attempt {
  const char* exercise;
  RobotFault fault = RobotFault::kNone;
  std::set<std::string> missed = {};  // metrics of the criteria
};

std::string NameOf(const testing::TestParamInfo<Attempt>& info) {
  std::string name = std::string(info.param.exercise);
  if (info.param.fault != RobotFault::kNone) name += "_" + std::string(ToString(info.param.fault));
  std::ranges::replace(name, '-', '_');
  return name;
}

int Seeds() {
  const char* asked = std::getenv("ARTHRO_ROBOT_SEEDS");
  return asked == nullptr ? 1 : std::max(1, std::atoi(asked));
}

class RobotExpert : public testing::TestWithParam<Attempt> {};

TEST_P(RobotExpert, PassesTheShippedExercise) {
  for (int seed = 1; seed <= Seeds(); ++seed) {
    RobotOptions options;
    options.seed = seed;
    const RobotRun run = RunWithLog(ExerciseOf(GetParam().exercise), options);
    fmt::print("{} seed {}: {} after {:.1f} s {}\n", GetParam().exercise, seed,
               ToString(run.result.outcome), run.result.duration, run.result.reason);
    EXPECT_EQ(run.result.outcome, AttemptOutcome::kPassed)
        << "seed " << seed << ": " << run.result.reason << "\n"
        << Troubles(run);
  }
}

INSTANTIATE_TEST_SUITE_P(Demo, RobotExpert,
                         testing::Values(Attempt{"centre-and-hold"}, Attempt{"telescope"},
                                         Attempt{"periscope-30"}, Attempt{"periscope-70-90"},
                                         Attempt{"track"}, Attempt{"straight-line"},
                                         Attempt{"probe-five"}, Attempt{"measure"},
                                         Attempt{"trace-edge"}, Attempt{"loose-body"},
                                         Attempt{"tour-12"}, Attempt{"stiffness"}, Attempt{"trim"},
                                         Attempt{"bleeding"}),
                         NameOf);

// True for faults that leave a step undone.
bool IsInStep(RobotFault fault) {
  return fault == RobotFault::kAnswersWrong || fault == RobotFault::kGivesUp;
}

class RobotNovice : public testing::TestWithParam<Attempt> {};

TEST_P(RobotNovice, MissesExactlyTheCriteriaThatNameItsFault) {
  for (int seed = 1; seed <= Seeds(); ++seed) {
    RobotOptions options;
    options.fault = GetParam().fault;
    options.seed = seed;
    const RobotRun run = RunWithLog(ExerciseOf(GetParam().exercise), options);
    fmt::print("{} {} seed {}: {} after {:.1f} s {}\n", GetParam().exercise,
               ToString(options.fault), seed, ToString(run.result.outcome), run.result.duration,
               run.result.reason);
    EXPECT_NE(run.result.outcome, AttemptOutcome::kPassed) << "seed " << seed;
    // All but the criteria is as in a pass, unless the fault is in a step.
    for (const StepResult& step : run.result.steps)
      if (!IsInStep(options.fault)) {
        EXPECT_EQ(step.outcome, StepOutcome::kDone) << "seed " << seed << " " << step.id << "\n"
                                                    << Troubles(run);
      }
    EXPECT_EQ(Missed(run.result), GetParam().missed) << "seed " << seed << "\n" << Troubles(run);
  }
}

using enum RobotFault;
INSTANTIATE_TEST_SUITE_P(
    Demo, RobotNovice,
    testing::Values(Attempt{"centre-and-hold", kTooSlow, {"task_time"}},
                    Attempt{"centre-and-hold", kOffCentre, {"centring"}},
                    Attempt{"centre-and-hold", kPressesTooHard, {"peak_force"}},
                    Attempt{"telescope", kTooSlow, {"task_time"}},
                    Attempt{"telescope", kEntersZone, {"zone_entries"}},
                    Attempt{"periscope-30", kPressesTooHard, {"peak_force"}},
                    Attempt{"periscope-70-90", kTooSlow, {"task_time"}},
                    Attempt{"track", kLeavesLine, {"track_error"}},
                    Attempt{"straight-line", kLeavesLine, {"line_error"}},
                    Attempt{"track", kEntersZone, {"zone_entries"}},
                    Attempt{"probe-five", kPressesTooHard, {"peak_force"}},
                    Attempt{"probe-five", kLooksAway, {"tool_loss"}},
                    Attempt{"measure", kMarksBeside, {"measure_error"}},
                    Attempt{"measure", kPressesTooHard, {"peak_force"}},
                    Attempt{"trace-edge", kPressesTooHard, {"peak_force"}},
                    Attempt{"loose-body", kDrops, {"drops"}},
                    Attempt{"tour-12", kTooSlow, {"task_time"}},
                    Attempt{"tour-12", kGivesUp, {"seen_share"}},
                    Attempt{"stiffness", kAnswersWrong, {}},
                    Attempt{"stiffness", kPressesTooHard, {"peak_force"}},
                    Attempt{"trim", kCutsOutside, {"taken_outside", "rim_min"}},
                    Attempt{"trim", kPressesTooHard, {"peak_force"}},
                    Attempt{"bleeding", kTooSlow, {"task_time"}},
                    Attempt{"bleeding", kPressesTooHard, {"peak_force"}},
                    Attempt{"probe-five", kEntersZone, {"zone_entries"}},
                    Attempt{"bleeding", kEntersZone, {"zone_entries"}}),
    NameOf);

TEST(Robot, SameSeedGivesTheSameFramesAndAnotherOneOthers) {
  const Exercise& exercise = ExerciseOf("straight-line");
  const RobotRun first = RunRobot(Demo(), exercise, Presets());
  EXPECT_TRUE(RunRobot(Demo(), exercise, Presets()).frames == first.frames);
  RobotOptions other;
  other.seed = 2;
  EXPECT_FALSE(RunRobot(Demo(), exercise, Presets(), other).frames == first.frames);
}

TEST(RobotJoint, AnInstrumentOutsideTheJointLeavesTheTissueAsleep) {
  RobotJoint joint(Demo(), ExerciseOf("probe-five"), Presets());
  ASSERT_LT(joint.hands().instrument.depth, 0);
  for (int i = 0; i < 50; ++i) joint.Advance(joint.hands());
  ASSERT_NE(joint.tissues(), nullptr);
  for (const BodyPicture& body : joint.tissues()->bodies) {
    EXPECT_TRUE(body.report.is_asleep) << body.tissue;
    EXPECT_EQ(body.report.contacts, 0) << body.tissue;
  }
}

TEST(Robot, FaultsHaveWords) {
  for (int i = 0; i < kRobotFaults; ++i) {
    const auto fault = static_cast<RobotFault>(i);
    EXPECT_EQ(RobotFaultFromString(ToString(fault)), fault);
  }
  EXPECT_FALSE(RobotFaultFromString("late"));
}

}  // namespace
}  // namespace arthro::simulation
