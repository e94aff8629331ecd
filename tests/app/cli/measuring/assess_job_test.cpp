// arthroscene assess: attempts of robots at the exercises of the demo scene have the result that
// they had while they ran, whatever else is given; what cannot be assessed is refused in one
// sentence.
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/records/attempts/attempts.h"
#include "app/records/keeping/kept_attempt.h"
#include "app/records/people/reference_groups.h"
#include "app/records/people/trainees.h"
#include "app/report/assessment_file.h"
#include "app/report/make_report.h"
#include "simulation/core/atomic_file.h"
#include "simulation/scene/exercise/find_exercise.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/json/exercise_json.h"
#include "simulation/training/observe/surface_names.h"
#include "simulation/training/robot/robot.h"
#include "simulation/training/scene_of_attempt.h"
#include "simulation/training/score/recorded_result.h"
#include "tests/support/run_program.h"
#include "tests/support/sample_attempts.h"
#include "tests/support/schema_fault.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;
using simulation::RobotFault;

const fs::path kResources = fs::path(ARTHRO_SOURCE_DIR) / "resources";

const LoadedScene& Demo() {
  static const LoadedScene loaded = LoadScene(kResources / "demo");
  return loaded;
}

const Exercise& ExerciseOf(const std::string& id) {
  return ExerciseWithId(Demo().scene.exercises, id);
}

simulation::AttemptHead HeadOf(const Exercise& exercise) {
  return {.attempt = "00000000-0000-4000-8000-000000000001",
          .exercise = exercise.id,
          .exercise_hash = HashOf(exercise),
          .scene = Demo().scene.title,
          .scene_fingerprint = simulation::FingerprintOfScene(Demo()),
          .mode = "robot",
          .rig = "robot",
          .started = "2026-11-23T20:30:00.000Z",
          .program = "arthroscene 0.1.0",
          .surfaces = simulation::SurfaceNames(Demo().scene)};
}

// An attempt of a robot in a file, and its result while it ran.
simulation::RobotRun WriteAttempt(const fs::path& file, const std::string& id,
                                  RobotFault fault = RobotFault::kNone) {
  static const auto presets = simulation::ReadTissuePresets(kResources / "presets" / "tissues");
  const Exercise& exercise = ExerciseOf(id);
  simulation::AttemptLog log(file, std::vector<simulation::LogSource>{{"", "", "1", {}}},
                             simulation::AttemptHeadText(HeadOf(exercise)));
  simulation::RobotOptions options;
  options.fault = fault;
  auto run = simulation::RunRobot(Demo(), exercise, presets, options, &log);
  log.Close();
  return run;
}

test::ProgramResult Assess(const fs::path& scene, const fs::path& attempt,
                           const std::string& flags) {
  return test::RunProgram(fmt::format("assess {} {} {}", scene.string(), attempt.string(), flags));
}

class AssessedRobot : public testing::TestWithParam<const char*> {};

TEST_P(AssessedRobot, HasTheResultThatItHadWhileItRan) {
  const test::TempFolder folder;
  const simulation::RobotRun run = WriteAttempt(folder / "robot.attempt", GetParam());
  const auto job =
      Assess(kResources / "demo", folder / "robot.attempt",
             fmt::format("--exercise {} --json {}", GetParam(), (folder / "out.json").string()));
  ASSERT_EQ(job.exit_code, 0) << job.err;
  const simulation::AttemptHead head = HeadOf(ExerciseOf(GetParam()));
  app::AttemptReport live = app::MakeReport(ExerciseOf(GetParam()), run.result, run.frames);
  live.attempt.id = head.attempt;
  live.attempt.scene = head.scene;
  live.attempt.started = head.started;
  live.attempt.mode = app::AttemptMode::kRobot;
  live.is_mode_known = true;
  EXPECT_TRUE(ReadWholeFile(folder / "out.json") == app::AttemptJson(live)) << "every byte";
  EXPECT_EQ(test::SchemaFault("assessment-1", ReadWholeFile(folder / "out.json")), "");
}

INSTANTIATE_TEST_SUITE_P(Demo, AssessedRobot,
                         testing::Values("centre-and-hold", "telescope", "periscope-30",
                                         "periscope-70-90", "track", "straight-line", "probe-five",
                                         "measure", "trace-edge", "loose-body", "tour-12",
                                         "stiffness", "trim", "bleeding"),
                         [](const auto& each) {
                           std::string name = each.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

// One attempt for the tests of what is refused.
class AssessJob : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    files_ = new test::TempFolder;
    WriteAttempt(*files_ / "passed.attempt", "telescope");
    WriteAttempt(*files_ / "slow.attempt", "telescope", RobotFault::kTooSlow);
  }
  static void TearDownTestSuite() { delete files_; }
  static fs::path Passed() { return *files_ / "passed.attempt"; }
  static fs::path Slow() { return *files_ / "slow.attempt"; }
  fs::path Demo() const { return kResources / "demo"; }
  // A copy of the demo whose scene.json is changed.
  template <class Change>
  fs::path Changed(const Change& change) const {
    const fs::path scene = folder / "changed";
    fs::copy(Demo(), scene);
    auto json = nlohmann::ordered_json::parse(ReadWholeFile(scene / "scene.json"));
    change(json);
    WriteAtomically(scene / "scene.json", json.dump(2));
    return scene;
  }
  std::string Out(const std::string& name) const { return (folder / name).string(); }
  void ExpectRefused(const test::ProgramResult& job, const std::string& words) {
    EXPECT_EQ(job.exit_code, 1) << job.err;
    EXPECT_NE(job.err.find(words), std::string::npos) << job.err;
    EXPECT_EQ(std::ranges::count(job.err, '\n'), 1) << "one sentence: " << job.err;
    EXPECT_FALSE(fs::exists(folder / "out.json"));
  }

  test::TempFolder folder;
  static test::TempFolder* files_;
};
test::TempFolder* AssessJob::files_ = nullptr;

TEST_F(AssessJob, WritesPageJsonAndTableOfThePassedAttempt) {
  const auto job = Assess(Demo(), Passed(),
                          fmt::format("--exercise telescope --report {} --json {} --csv {} "
                                      "--require-pass",
                                      Out("out.html"), Out("out.json"), Out("out.csv")));
  ASSERT_EQ(job.exit_code, 0) << job.err;
  const std::string page = ReadWholeFile(Out("out.html"));
  for (const char* words : {"Passed: every criterion is met", "<h2>Steps</h2>", "<h2>Force</h2>",
                            "<h2>Centring</h2>", "robot"})
    EXPECT_NE(page.find(words), std::string::npos) << words;
  for (const char* word : {"validated", " %", "score", "total"})
    EXPECT_EQ(page.find(word), std::string::npos) << word;
  EXPECT_EQ(ReadWholeFile(Out("out.csv")).find("metric,part,value,unit,better,"), 0U);
}

TEST_F(AssessJob, ThePageHasAPictureAtTheEndOfEachStepUnlessTheyAreLeftOff) {
  const auto pictures = [&](const std::string& flags) {
    const auto job =
        Assess(Demo(), Passed(), "--exercise telescope --report " + Out("page.html") + " " + flags);
    EXPECT_EQ(job.exit_code, 0) << job.err;
    const std::string page = ReadWholeFile(Out("page.html"));
    long count = 0;
    for (std::size_t at = 0; (at = page.find("<img ", at)) != std::string::npos; ++at) ++count;
    // A machine without OpenGL writes the page without them, and says why.
    if (count == 0 && flags.empty()) {
      EXPECT_NE(job.err.find("the report has no pictures"), std::string::npos) << job.err;
    }
    return count;
  };
  EXPECT_EQ(pictures("--no-pictures"), 0);
  const long count = pictures("");
  EXPECT_TRUE(count == 0 || count == static_cast<long>(ExerciseOf("telescope").steps.size()))
      << count;
}

TEST_F(AssessJob, TheExpertOfTheSceneStandsBesideTheValues) {
  const fs::path scene =
      Changed([](auto& json) { json["exercises"][1]["ghost"] = "expert.attempt"; });
  ASSERT_EQ(ExerciseOf("telescope").id, "telescope");
  fs::copy(Passed(), scene / "expert.attempt");
  const auto job =
      Assess(scene, Slow(), "--exercise telescope --no-pictures --report " + Out("page.html"));
  ASSERT_EQ(job.exit_code, 0) << job.err;
  EXPECT_EQ(job.err, "");
  EXPECT_NE(ReadWholeFile(Out("page.html")).find("<th>Expert</th>"), std::string::npos);
  WriteAtomically(scene / "expert.attempt", "text");
  const auto without =
      Assess(scene, Slow(), "--exercise telescope --no-pictures --report " + Out("page.html"));
  EXPECT_EQ(without.exit_code, 0);
  EXPECT_NE(without.err.find("the expert's attempt is left out"), std::string::npos) << without.err;
}

TEST_F(AssessJob, RequiredPassThatIsNotThereExitsWithOneAndTheReportIsWritten) {
  const auto job =
      Assess(Demo(), Slow(),
             fmt::format("--exercise telescope --json {} --require-pass", Out("out.json")));
  EXPECT_EQ(job.exit_code, 1);
  EXPECT_NE(job.err.find("is not passed"), std::string::npos) << job.err;
  EXPECT_EQ(nlohmann::json::parse(ReadWholeFile(Out("out.json")))["outcome"], "failed");
  EXPECT_EQ(Assess(Demo(), Slow(), "--exercise telescope --json -").exit_code, 0)
      << "an attempt that is not passed is assessed like any other";
}

TEST_F(AssessJob, AnUnknownExerciseIsRefusedWithThoseThatThereAre) {
  ExpectRefused(Assess(Demo(), Passed(), "--exercise tele --json " + Out("out.json")),
                "centre-and-hold, telescope, periscope-30");
}

TEST_F(AssessJob, ASceneAndAnAttemptTheOtherWayRoundAreNamed) {
  for (const std::string& flags : {std::string(), "--json " + Out("out.json")}) {
    ExpectRefused(Assess(Passed(), Demo(), flags), "give the scene first");
    ExpectRefused(Assess(Demo(), Demo(), flags), "is a folder and no attempt");
  }
}

TEST_F(AssessJob, AnotherExerciseThanThatOfTheAttemptIsRefused) {
  ExpectRefused(Assess(Demo(), Passed(), "--exercise track --json " + Out("out.json")),
                "give --exercise telescope");
}

TEST_F(AssessJob, ASceneThatHasChangedIsRefusedUnlessItsTargetsAreSeenAnew) {
  const fs::path scene = Changed([](auto& json) { json["portals"]["incision_spacing"] = 0.019; });
  const std::string flags = "--exercise telescope --json " + Out("out.json");
  ExpectRefused(Assess(scene, Passed(), flags), "has changed since this attempt");
  const auto job = Assess(scene, Passed(), flags + " --reobserve");
  ASSERT_EQ(job.exit_code, 0) << job.err;
  EXPECT_EQ(nlohmann::json::parse(ReadWholeFile(Out("out.json")))["outcome"], "passed");
}

TEST_F(AssessJob, AnExerciseThatWasEditedSinceIsRefusedUnlessItsTargetsAreSeenAnew) {
  const fs::path scene = Changed([](auto& json) {
    for (auto& exercise : json["exercises"])
      if (exercise["id"] == "telescope")
        for (auto& criterion : exercise["criteria"])
          if (criterion["metric"] == "task_time") criterion["max"] = 1;
  });
  const std::string flags = "--exercise telescope --json " + Out("out.json");
  ExpectRefused(Assess(scene, Passed(), flags), "the exercise telescope has changed");
  ASSERT_EQ(Assess(scene, Passed(), flags + " --reobserve").exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(ReadWholeFile(Out("out.json")))["outcome"], "failed");
}

TEST_F(AssessJob, SightAnewInTheSameSceneGivesTheSameResult) {
  const std::string flags = "--exercise telescope --json ";
  ASSERT_EQ(Assess(Demo(), Passed(), flags + Out("a.json")).exit_code, 0);
  ASSERT_EQ(Assess(Demo(), Passed(), flags + Out("b.json") + " --reobserve").exit_code, 0);
  const auto a = nlohmann::json::parse(ReadWholeFile(Out("a.json"))),
             b = nlohmann::json::parse(ReadWholeFile(Out("b.json")));
  EXPECT_EQ(a["outcome"], b["outcome"]);
  EXPECT_EQ(a["steps"], b["steps"]);
}

TEST_F(AssessJob, ADamagedAttemptIsRefusedAndOneThatWasCutShortIsStopped) {
  std::string bytes = ReadWholeFile(Passed());
  const fs::path attempt = folder / "damaged.attempt";
  std::string damaged = bytes;
  for (int i = 0; i < 8; ++i) damaged[damaged.size() / 2 + i] ^= 0x55;
  WriteAtomically(attempt, damaged);
  const std::string flags = "--exercise telescope --json " + Out("out.json");
  ExpectRefused(Assess(Demo(), attempt, flags), "damaged.attempt");
  WriteAtomically(attempt, std::string("ARTHRLOG") + char(99) + bytes.substr(9));
  ExpectRefused(Assess(Demo(), attempt, flags), "version");
  WriteAtomically(attempt, bytes.substr(0, bytes.size() / 2));
  const auto job = Assess(Demo(), attempt, flags);
  ASSERT_EQ(job.exit_code, 0) << job.err;
  EXPECT_NE(job.err.find("warning"), std::string::npos) << job.err;
  EXPECT_EQ(nlohmann::json::parse(ReadWholeFile(Out("out.json")))["outcome"], "stopped");
}

TEST_F(AssessJob, RecordedHandsAreObservedAtAnExercise) {
  const auto job = Assess(Demo(), Demo() / "trace.csv",
                          fmt::format("--exercise centre-and-hold --json {} --report {}",
                                      Out("out.json"), Out("out.html")));
  ASSERT_EQ(job.exit_code, 0) << job.err;
  const auto json = nlohmann::json::parse(ReadWholeFile(Out("out.json")));
  EXPECT_EQ(json["outcome"], "stopped") << "the recording ends before the exercise";
  EXPECT_FALSE(json.contains("mode"));
  EXPECT_GT(json["frames"], 100);
  EXPECT_EQ(json["criteria"].size(), ExerciseOf("centre-and-hold").criteria.size());
}

TEST_F(AssessJob, HandsWithoutAnExerciseAreMeasuredAsEver) {
  const auto job = Assess(Demo(), Demo() / "trace.csv",
                          fmt::format("-o {} --json {}", Out("out.csv"), Out("out.json")));
  ASSERT_EQ(job.exit_code, 0) << job.err;
  EXPECT_NE(ReadWholeFile(Out("out.csv")).find("\ntask_time,both,"), std::string::npos);
  const auto json = nlohmann::json::parse(ReadWholeFile(Out("out.json")));
  EXPECT_FALSE(json.contains("outcome"));
  EXPECT_FALSE(json.contains("exercise"));
  EXPECT_EQ(test::SchemaFault("assessment-1", ReadWholeFile(Out("out.json"))), "");
  EXPECT_EQ(Assess(Demo(), Demo() / "trace.csv", "").exit_code, 1) << "nothing is to be written";
  EXPECT_EQ(Assess(Demo(), Demo() / "trace.csv", "--require-pass").exit_code, 1);
}

TEST_F(AssessJob, AReferenceGroupStandsBesideTheValues) {
  const std::string place = Out("records.sqlite");
  {
    app::Records records(place, test::RepeatedOptions());
    std::vector<std::string> codes;
    const auto run = simulation::ResultOfRecording(simulation::ReadAttempt(Passed()),
                                                   ExerciseOf("telescope"), {});
    for (int i = 0; i < 6; ++i) {
      codes.push_back(fmt::format("E-{}", i));
      app::AddTrainee(records, test::NewTrainee(codes.back()));
      const auto session = app::StartSession(records, codes.back(), "test", "robot");
      auto started =
          app::StartAttempt(records, session, app::ExerciseRowOf(ExerciseOf("telescope")), "Demo",
                            app::AttemptMode::kTest, simulation::kMetricsVersion);
      auto result = run;
      for (auto& value : result.metrics)
        if (value.value) *value.value *= 1 + 0.02 * i;
      app::SetResult(started.record, result);
      app::FinishAttempt(records, started.record);
    }
    app::ReferenceRule rule;
    rule.trainees = codes;
    rule.rig = "robot";
    app::MakeReferenceGroup(records, "experts", HashOf(ExerciseOf("telescope")), rule);
  }
  const std::string flags = fmt::format("--exercise telescope --records {} --json {} --reference ",
                                        place, Out("out.json"));
  ExpectRefused(Assess(Demo(), Passed(), flags + "masters"), "there are: experts");
  const auto job = Assess(Demo(), Passed(), flags + "experts --report " + Out("out.html"));
  ASSERT_EQ(job.exit_code, 0) << job.err;
  EXPECT_NE(ReadWholeFile(Out("out.html")).find("Middle half of experts"), std::string::npos);
  const auto json = nlohmann::json::parse(ReadWholeFile(Out("out.json")));
  const auto& time = *std::ranges::find(json["metrics"], "task_time",
                                        [](const auto& metric) { return metric["metric"]; });
  EXPECT_EQ(time["group"]["n"], 6);
  EXPECT_GT(time["group"]["z"], 1) << "the shortest time of all";
}

}  // namespace
}  // namespace arthro
