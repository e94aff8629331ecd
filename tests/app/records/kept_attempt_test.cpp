// Attempts from begin to record: log first, results after, whatever the database does meanwhile.
#include "app/records/keeping/kept_attempt.h"

#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>

#include "app/records/attempts/outbox.h"
#include "app/records/people/trainees.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/sha256.h"
#include "simulation/scene/json/exercise_json.h"
#include "simulation/training/score/recorded_result.h"
#include "tests/support/sample_attempts.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {
namespace {

using namespace app;
using simulation::AttemptFrame;

Exercise FreePractice() {
  Exercise exercise;
  exercise.id = "free";
  exercise.title = "Free practice";
  exercise.criteria.push_back({"task_time", "both", {}, 120.0, {}, "own start value"});
  return exercise;
}

std::vector<AttemptFrame> Frames(int count) {
  std::vector<AttemptFrame> frames(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k)
    for (simulation::ToolFrame& tool : frames[static_cast<std::size_t>(k)].tool) {
      tool.is_valid = true;
      tool.depth = 0.02F;
      tool.tip = tool.drawn_tip = {0.0001F * static_cast<float>(k), 0, 0.02F};
    }
  return frames;
}

AttemptPlan PlanOf(const Exercise& exercise) {
  AttemptPlan plan;
  plan.trainee = "T-1";
  plan.exercise = ExerciseRowOf(exercise);
  plan.scene = "Demo";
  plan.surfaces = {"backdrop"};
  plan.mode = AttemptMode::kTest;
  return plan;
}

struct Station {
  TempFolder folder;
  std::string place = (folder / "records.sqlite").string();
  Records records{place, RepeatedOptions()};
  SessionRow session;
  Station() {
    AddTrainee(records, NewTrainee("T-1"));
    session = StartSession(records, "T-1", "test", "mouse and keys");
  }
  std::filesystem::path LogOf(const KeptAttempt& kept) const { return folder / kept.record().log; }
};

// The attempt as the window makes it: frames and events of an engine that runs.
simulation::AttemptResult Attempt(KeptAttempt& kept, const Exercise& exercise, int frames) {
  simulation::RecordedAttempt live;
  live.frames = Frames(frames);
  simulation::StepEngine engine(exercise);
  std::size_t told = 0;
  for (const AttemptFrame& frame : live.frames) {
    engine.Advance(frame);
    kept.Add({&frame, 1}, std::span(engine.events()).subspan(told));
    told = engine.events().size();
  }
  live.events = engine.events();
  return simulation::ResultOfRecording(live, exercise, {"backdrop"});
}

TEST(KeptAttempt, IsRunningWithItsLogBeforeItsResultIsThere) {
  Station station;
  KeptAttempt kept(&station.records, station.folder.path(), station.session,
                   PlanOf(FreePractice()));
  EXPECT_TRUE(kept.notices().empty());
  EXPECT_EQ(ReadAttempt(station.records, kept.record().id)->outcome, AttemptOutcome::kRunning);
  kept.Add(Frames(200), {});
  const auto log = simulation::ReadAttempt(station.LogOf(kept));
  EXPECT_GE(log.frames.size(), 200U - 25U) << "at most 0.25 s are not on the disk";
  kept.Finish(&station.records, SampleResult());
}

TEST(KeptAttempt, IsInTheRecordsWithTheChecksumOfItsLog) {
  Station station;
  const Exercise exercise = FreePractice();
  KeptAttempt kept(&station.records, station.folder.path(), station.session, PlanOf(exercise));
  const auto result = Attempt(kept, exercise, 300);
  EXPECT_EQ(kept.Finish(&station.records, result), "");
  const auto record = ReadAttempt(station.records, kept.record().id);
  ASSERT_TRUE(record);
  EXPECT_EQ(record->outcome, AttemptOutcome::kStopped);
  EXPECT_EQ(record->log_sha256, Sha256(ReadWholeFile(station.LogOf(kept))));
  EXPECT_EQ(record->metrics.size(), result.metrics.size());
  EXPECT_EQ(simulation::ReadAttempt(station.LogOf(kept)).frames, Frames(300));
}

TEST(KeptAttempt, ThatIsCutShortIsRecoveredWithTheMetricsOfTheFramesInItsLog) {
  Station station;
  const Exercise exercise = FreePractice();
  std::string id;
  std::size_t logged = 0;
  {
    KeptAttempt kept(&station.records, station.folder.path(), station.session, PlanOf(exercise));
    Attempt(kept, exercise, 300);
    id = kept.record().id;
    logged = simulation::ReadAttempt(station.LogOf(kept)).frames.size();
  }
  EXPECT_GE(logged, 300U - 25U) << "at most 0.25 s are lost";
  simulation::RecordedAttempt observed;
  observed.frames = Frames(static_cast<int>(logged));
  const auto result = simulation::ResultOfRecording(observed, exercise, {"backdrop"});
  const auto sentences = RecoverAttempts(station.records, [&](const AttemptRecord& record) {
    return ResultFromLog(station.records, record);
  });
  ASSERT_EQ(sentences.size(), 1U);
  const auto record = ReadAttempt(station.records, id);
  EXPECT_EQ(record->outcome, AttemptOutcome::kStopped);
  EXPECT_FALSE(record->log_sha256.empty());
  ASSERT_EQ(record->metrics.size(), result.metrics.size());
  for (const MetricRow& row : record->metrics) {
    const auto live = std::find_if(
        result.metrics.begin(), result.metrics.end(),
        [&](const auto& value) { return value.metric->id == row.name && value.part == row.part; });
    ASSERT_NE(live, result.metrics.end()) << row.name;
    EXPECT_EQ(live->value, row.value) << row.name << " " << row.part;
  }
}

TEST(KeptAttempt, GoesToTheOutboxWhileNoDatabaseIsReachedAndIntoTheRecordsAfter) {
  TempFolder folder;
  const Exercise exercise = FreePractice();
  std::string id;
  {
    KeptAttempt kept(nullptr, folder.path(), std::nullopt, PlanOf(exercise));
    id = kept.record().id;
    const auto result = Attempt(kept, exercise, 100);
    EXPECT_NE(kept.Finish(nullptr, result).find("outbox"), std::string::npos);
  }
  Records records((folder / "records.sqlite").string(), RepeatedOptions());
  EXPECT_EQ(SyncOutbox(records, folder.path()).fresh, 1);
  EXPECT_EQ(SyncOutbox(records, folder.path()).fresh, 0) << "it is not doubled";
  ASSERT_TRUE(ReadAttempt(records, id));
  EXPECT_EQ(ReadAttempt(records, id)->outcome, AttemptOutcome::kStopped);
}

TEST(KeptAttempt, ThatIsCutShortWhileNoDatabaseIsReachedIsRecoveredToo) {
  TempFolder folder;
  const Exercise exercise = FreePractice();
  std::string id;
  {
    KeptAttempt kept(nullptr, folder.path(), std::nullopt, PlanOf(exercise));
    id = kept.record().id;
    Attempt(kept, exercise, 100);
  }
  RecordsOptions options;  // station: this machine
  Records records((folder / "records.sqlite").string(), options);
  EXPECT_EQ(SyncOutbox(records, folder.path()).fresh, 1);
  EXPECT_EQ(ReadAttempt(records, id)->outcome, AttemptOutcome::kRunning);
  RecoverAttempts(records,
                  [&](const AttemptRecord& record) { return ResultFromLog(records, record); });
  EXPECT_EQ(ReadAttempt(records, id)->outcome, AttemptOutcome::kStopped);
  EXPECT_FALSE(ReadAttempt(records, id)->metrics.empty());
}

TEST(KeptAttempt, OfADatabaseThatIsLockedAtTheEndGoesToTheOutbox) {
  Station station;
  RecordsOptions hasty = RepeatedOptions(7);
  hasty.timeout = 0.1;
  Records records(station.place, hasty);
  KeptAttempt kept(&records, station.folder.path(), station.session, PlanOf(FreePractice()));
  station.records.database().Write([&] {
    const std::string where = kept.Finish(&records, SampleResult());
    EXPECT_NE(where.find("locked"), std::string::npos) << where;
    EXPECT_NE(where.find("outbox"), std::string::npos) << where;
  });
  EXPECT_EQ(SyncOutbox(records, station.folder.path()).fresh, 1);
  EXPECT_EQ(ReadAttempt(records, kept.record().id)->outcome, AttemptOutcome::kFailed);
}

// A data folder of the user in which nothing can be made, so that there is no spare folder.
void BlockDataFolder(const TempFolder& folder) {
  std::ofstream(folder / "data") << "a file in the place of the folder";
  ::setenv("XDG_DATA_HOME", (folder / "data").c_str(), 1);
}

TEST(KeptAttempt, IsNotLostWhereNeitherRecordsNorOutboxTakeIt) {
  TempFolder folder;
  BlockDataFolder(folder);
  std::ofstream(folder / "outbox") << "a file in the place of the folder";
  KeptAttempt kept(nullptr, folder.path(), std::nullopt, PlanOf(FreePractice()));
  EXPECT_EQ(kept.notices().size(), 1U);
  EXPECT_THROW(kept.Finish(nullptr, SampleResult()), Error);
  std::filesystem::remove(folder / "outbox");
  EXPECT_NE(kept.Finish(nullptr, SampleResult()).find("outbox"), std::string::npos);
}

TEST(KeptAttempt, WithoutALogKeepsItsResultAndSaysSo) {
  Station station;
  BlockDataFolder(station.folder);
  std::filesystem::remove_all(station.folder / "attempts");
  std::ofstream(station.folder / "attempts") << "a file in the place of the folder";
  KeptAttempt kept(&station.records, station.folder.path(), station.session,
                   PlanOf(FreePractice()));
  ASSERT_EQ(kept.notices().size(), 1U);
  kept.Add(Frames(10), {});
  EXPECT_EQ(kept.Finish(&station.records, SampleResult()), "");
  EXPECT_EQ(ReadAttempt(station.records, kept.record().id)->log_bytes, -1);
}

TEST(ExerciseJson, OfTheRecordsGivesTheSameExercise) {
  const Exercise exercise = FreePractice();
  EXPECT_EQ(ExerciseFromJson(CanonicalJson(exercise)), exercise);
  EXPECT_EQ(HashOf(ExerciseFromJson(CanonicalJson(exercise))), HashOf(exercise));
}

}  // namespace
}  // namespace arthro::test
