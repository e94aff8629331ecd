// Exercises in the window: the briefing by `practise --exercise --trainee`, the attempt, its result
// and the look back, later as well; the steps that an author makes.
#include <gtest/gtest.h>

#include "simulation/scene/files/scene_io.h"
#include "tests/support/run_window.h"

namespace arthro {
namespace {

class LessonWindow : public testing::Test {
 protected:
  void SetUp() override { ARTHRO_REQUIRE_XVFB(); }
  std::string Flags(const std::string& flags) const {
    return "practise " ARTHRO_SOURCE_DIR "/resources/demo --records " +
           (folder / "records.sqlite").string() + " " + flags;
  }
  void AddTrainee(const std::string& code) {
    ASSERT_EQ(test::RunProgram("records trainee add " + code + " --records " +
                               (folder / "records.sqlite").string())
                  .exit_code,
              0);
  }
  test::TempFolder folder;
};

TEST_F(LessonWindow, OpensOnTheBriefingAndKeepsTheAttemptAsATest) {
  AddTrainee("T-1");
  const auto result = test::RunWindow(Flags("--exercise centre-and-hold --trainee T-1 --test"), R"(
wait frames 5
expect "Centre and hold"
expect "Kept for trainee T-1."
expect value "Test, for the gate" on
expect enabled "Begin"
click "Begin"
wait job
wait frames 60
click "End attempt"
expect "Stopped"
expect "Kept for T-1 in the records."
click "Look back"
wait frames 5
expect "Events"
click "Result"
expect enabled "Save report…"
click "Trainee's page"
wait frames 5
expect "Earlier attempts"
expect "T-1"
)");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const auto list = test::RunProgram("records list --trainee T-1 --records " +
                                     (folder / "records.sqlite").string());
  EXPECT_NE(list.out.find("test      stopped"), std::string::npos) << list.out;
}

TEST_F(LessonWindow, ACodeThatWasTypedIsUsedBeforeAnExerciseStarts) {
  AddTrainee("T-1");
  const auto result = test::RunWindow(Flags("--exercise centre-and-hold"), R"(
wait frames 5
click "Trainee's page"
set "Trainee's code" T-2
click "Start##start0"
wait frames 3
expect "Add this trainee, or clear the code to practise without a record."
expect "No trainee has the code T-2 yet."
expect not "Begin"
set "Trainee's code" T-1
click "Start##start0"
wait frames 3
expect "Kept for trainee T-1."
expect enabled "Begin"
)");
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(LessonWindow, SlidersOfAStepGiveNoValueThatASceneRefuses) {
  const std::filesystem::path saved = folder / "knee";
  const auto result = test::RunWindow("edit " ARTHRO_SOURCE_DIR "/resources/demo", R"(
click Exercises
click "New exercise"
click "Add a target by a click"
click Picture 0 0
click "Add a step"
click See
expect value "Hint after" "20.0 s"
set "Distance to" -5
expect value "Distance to" "0.1 mm"
expect value "Distance from" "0.1 mm"
set "Distance from" 7
expect value "Distance to" "7.0 mm"
set "Hint after" 99999
expect value "Hint after" "120.0 s"
do save-as )" + saved.string() + R"(
wait job
expect "Saved in"
)");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(std::filesystem::exists(saved / "scene.json"));
}

// The kinds of steps, as the page names them. Hold comes first: later its entry has the name of a
// slider of other kinds.
constexpr const char* kStepKinds[] = {"Hold",   "See",     "Telescope", "Periscope",
                                      "Track",  "Probe",   "Follow",    "Measure",
                                      "Resect", "Recover", "Transfer",  "Answer"};

TEST_F(LessonWindow, AuthorsAnExerciseWithEveryKindOfStepAndTarget) {
  const std::filesystem::path saved = folder / "knee";
  std::string script = R"(
click Exercises
click "New exercise"
click "Add a target by a click"
click Picture 0 0
click "Add a target by a click"
click Overview 0 0
expect "The target lies on"
click "Add a target by a click"
click Picture 30 20
click "A loose body"
click "Add a target by a click"
click Picture -30 20
click "Kind of target"
click "Ball in space"
expect value "Kind of target" "Ball in space"
click "Add a target by a click"
click Picture 0 0
click "Kind of target"
click "Regions of a tissue"
)";
  for (const char* kind : kStepKinds)
    script += std::string("click \"Add a step\"\nclick ") + kind + "\n";
  script += R"(
set "Question" "What is it?"
set "Answer 2" "A meniscus"
click "Right answer"
click "2. A meniscus"
click "More of this step"
click "May fail"
expect not "this kind of step needs"
do save-as )" +
            saved.string() + R"(
wait job
expect "Saved in"
)";
  const auto result = test::RunWindow("edit " ARTHRO_SOURCE_DIR "/resources/demo", script);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const Scene scene = ReadScene(saved);
  const Exercise& exercise = scene.exercises.back();
  EXPECT_EQ(exercise.steps.size(), std::size(kStepKinds));
  EXPECT_TRUE(exercise.targets[2].is_loose);
  EXPECT_TRUE(exercise.targets[3].ball);
  EXPECT_FALSE(exercise.targets[4].regions.empty());
  const auto& answer = std::get<AnswerStep>(exercise.steps.back());
  EXPECT_EQ(answer.question, "What is it?");
  EXPECT_EQ(answer.right, 1);
  EXPECT_TRUE(answer.is_optional);
  const auto check = test::RunProgram("check " + saved.string());
  EXPECT_EQ(check.exit_code, 0) << check.err;
}

TEST_F(LessonWindow, TheCheckOfPosesRunsBesideTheWindow) {
  const auto result = test::RunWindow("edit " ARTHRO_SOURCE_DIR "/resources/demo", R"(
click Exercises
click "New exercise"
expect disabled "Check that targets can be seen"
click "Add a target by a click"
click Picture 0 0
click "Add a step"
click See
click "Check that targets can be seen"
wait job
expect "Some pose sees each target of the steps."
click "Kind of target"
click "Ball in space"
set In -50
click "Check that targets can be seen"
wait job
expect "No pose sees \"target-1\" with 30°."
)");
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(LessonWindow, SaysWhyAnExerciseIsShut) {
  AddTrainee("T-1");
  const auto result = test::RunWindow(Flags("--exercise telescope --trainee T-1"), R"(
wait frames 5
expect "Shut for T-1: pass \"Centre and hold\" first"
expect disabled "Begin"
)");
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(LessonWindow, AnAttemptIsPausedAndOffersTheLensesOfItsExercise) {
  const auto result = test::RunWindow(Flags("--exercise periscope-70-90"), R"(
wait frames 5
expect "Scope: 70° or 90°"
expect enabled "Unscored"
click "Begin"
wait job
wait frames 20
expect enabled "70°"
expect enabled "90°"
expect not "30°"
click "Pause"
wait frames 5
expect "Time, paused"
click "Pause"
set "Remark" steady
click "Note"
wait frames 5
expect not "Time, paused"
click "End attempt"
expect "Stopped"
click "Look back"
wait frames 5
expect "Force on the tips, N: scope grey, instrument blue"
)");
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(LessonWindow, AFreeOrderShowsEveryStepThatIsLeft) {
  const auto result = test::RunWindow(Flags("--exercise tour-12"), R"(
wait frames 5
click "Unscored"
wait job
wait frames 20
expect "To do, in any order"
expect "Show the femoral condyle."
expect "Show the rim of the meniscus."
click "End attempt"
expect "Not scored"
)");
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(LessonWindow, ClosingThePageEndsTheJob) {
  const auto result = test::RunWindow(Flags("--exercise telescope"), R"(
wait frames 5
expect "No trainee is chosen: the attempt is not kept."
expect enabled "Begin"
click "Close"
)");
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(LessonWindow, RefusesAnUnknownTraineeOrExerciseBeforeThereIsAWindow) {
  const auto refused = [&](const std::string& flags, int code, const std::string& words) {
    const auto result = test::RunProgram(Flags(flags), "DISPLAY=");
    EXPECT_EQ(result.exit_code, code) << result.err;
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
  };
  refused("--exercise telescope --trainee T-9", 1, "records trainee add T-9 --records");
  AddTrainee("T-1");
  refused("--exercise telescope --trainee T-9", 1, "no trainee has the code T-9");
  refused("--exercise telescope --trainee 'Jane Doe'", 1, "must not be a name");
  refused("--exercise none --trainee T-1", 1, "it has centre-and-hold, telescope");
  refused("--trainee T-1", 2, "--exercise");
  refused("--exercise telescope --test", 2, "--trainee");
}

}  // namespace
}  // namespace arthro
