// The whole way of an exercise, by mouse events: authored on a scene that was put together from
// footage, tried by hand, tried by a scripted expert and a novice, looked back at, written as a
// report, and shown on the instructor's page. Once on a digital knee, once on a real clip.
#include <cstdio>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/scene/files/scene_io.h"
#include "tests/support/run_window.h"
#include "tests/support/shared_data.h"

namespace arthro {
namespace {

constexpr const char* kPathScreen = "1280x800x24";

// Actions of a user in a script: waiting and looking are none.
int ActionsOf(const std::string& script) {
  std::istringstream lines(script);
  int actions = 0;
  for (std::string line; std::getline(lines, line);)
    actions += !line.empty() && !line.starts_with("wait") && !line.starts_with("expect") ? 1 : 0;
  return actions;
}

// A kept attempt, by the table of the records.
struct KeptLine {
  std::string id, started, outcome;
};

class ExercisePath : public testing::Test {
 protected:
  std::string Path(const std::string& name) const { return (temp_ / name).string(); }
  std::string Records() const { return " --records " + Path("records.sqlite"); }
  static void Do(const std::string& arguments) {
    const auto result = test::RunProgram(arguments);
    ASSERT_EQ(result.exit_code, 0) << arguments << "\n" << result.err;
  }
  void Drive(const std::string& arguments, const std::string& script) {
    actions_ += ActionsOf(script);
    const auto result = test::RunWindow(arguments + " --size 1280x800", script, kPathScreen);
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }

  // Two targets, a step that looks at them and one criterion, tried by hand.
  std::string AuthorScript() const {
    return R"(
click Exercises
click "New exercise"
set "Title of the exercise" "Look around"
click "Add a target by a click"
click Picture 0 0
click "Add a target by a click"
click Overview 0 0
expect "The target lies on"
click "Add a step"
click See
set Hold 0.5
click "Criteria of a pass"
click "Add a criterion"
click "Check that targets can be seen"
wait job
expect "Some pose sees each target of the steps."
click "Start exercise…"
click Begin
wait job
wait frames 30
click "End attempt"
expect "Stopped"
click Close
click "Save as…"
set "File name" )" +
           Path("mine") + R"(
click Save
wait job
expect "Saved in"
)";
  }

  std::vector<KeptLine> Kept() const {
    const auto table = test::RunProgram("records export -o -" + Records());
    EXPECT_EQ(table.exit_code, 0) << table.err;
    std::istringstream lines(table.out);
    std::vector<KeptLine> kept;
    std::vector<std::string> head;
    for (std::string line; std::getline(lines, line);) {
      std::vector<std::string> cells;
      std::istringstream row(line);
      for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
      if (head.empty()) {
        head = cells;
        continue;
      }
      std::map<std::string, std::string> by_name;
      for (std::size_t i = 0; i < cells.size() && i < head.size(); ++i) by_name[head[i]] = cells[i];
      kept.push_back({by_name["attempt"], by_name["started"], by_name["outcome"]});
    }
    return kept;
  }

  // From the exercise in the scene "mine" to the report and the page of the cohort.
  void TryAndJudge() {
    const Exercise exercise = ReadScene(Path("mine")).exercises.back();
    ASSERT_EQ(exercise.targets.size(), 2u);
    ASSERT_NO_FATAL_FAILURE(Do("records trainee add T-1" + Records()));
    const std::string robot =
        "robot " + Path("mine") + " --exercise " + exercise.id + " --trainee T-1" + Records();
    ASSERT_NO_FATAL_FAILURE(Do(robot + " --require-pass"));
    ASSERT_NO_FATAL_FAILURE(Do(robot + " --fault too-slow"));
    const auto kept = Kept();
    ASSERT_EQ(kept.size(), 2u);
    const auto failed = kept[0].outcome == "failed" ? kept[0] : kept[1];
    ASSERT_EQ(failed.outcome, "failed") << "the novice waits beyond the time";
    const std::string entry = failed.started.substr(0, 10) + " " + failed.started.substr(11, 5) +
                              "  failed  robot##" + failed.id;
    ASSERT_NO_FATAL_FAILURE(Drive("edit " + Path("mine") + Records(), R"(
do instructor-page
wait frames 5
click Robots
wait frames 5
click "1/2##T-1 1"
wait frames 5
click ")" + entry + R"("
wait frames 5
click "Look back"
wait frames 5
expect "Events"
click Play
wait frames 20
click Result
click "Save report…"
set "File name" )" + Path("report.html") + R"(
click Save
wait job
expect "The report is in"
do instructor-page
wait frames 5
expect "T-1"
)"));
    const std::string report = ReadWholeFile(Path("report.html"));
    EXPECT_NE(report.find("Look around"), std::string::npos);
    EXPECT_NE(report.find("<svg"), std::string::npos);
    std::printf("%d clicks and texts from footage to the page of the cohort\n", actions_);
  }
  int actions_ = 0;
  test::TempFolder temp_;
};

TEST_F(ExercisePath, LeadsFromADigitalKneeToTheReportOfANoviceInFiftyActions) {
  ARTHRO_REQUIRE_XVFB();
  ASSERT_NO_FATAL_FAILURE(Do("phantom --seed 3 --size S --footage-frames 12 -o " + Path("knee")));
  ASSERT_NO_FATAL_FAILURE(Drive("edit", "click New\ndrop " + Path("knee/footage") + R"(
wait job
click "Lens of the scope"
click "from a file…"
set "File name" )" + Path("knee/lens.json") +
                                            R"(
wait job
click "Measure relief from motion"
click no
click Run
wait job
click "Use this panorama"
wait job
click Depth
wait job
)" + AuthorScript()));
  ASSERT_NO_FATAL_FAILURE(TryAndJudge());
  EXPECT_LE(actions_, 50);
}

TEST_F(ExercisePath, LeadsFromARealClipToTheReportOfANoviceInFiftyActions) {
  ARTHRO_REQUIRE_SHARED(clip, "data/laparoscopy_rvim/endo.mp4");
  ARTHRO_REQUIRE_XVFB();
  ASSERT_NO_FATAL_FAILURE(Drive("edit", "click New\ndrop " + clip.string() + R"(
wait job
click "More options"
set "Use every n-th frame" 4
click Run
wait job
click "Use this panorama"
wait job
click Depth
wait job
)" + AuthorScript()));
  ASSERT_NO_FATAL_FAILURE(TryAndJudge());
  EXPECT_LE(actions_, 50);
}

}  // namespace
}  // namespace arthro
