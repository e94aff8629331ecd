// Pages of the records over 10 x 5, 100 x 50 and 1 000 x 50 attempts, in SQLite and PostgreSQL: the
// trainee's page and the instructor's page from closed records to their rows, a cell that is
// chosen, and an attempt that is opened. Each attempt has a log in the folder of the records.
// Beside the times stand wrong numbers on the page, against how the attempts were made.
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "app/editor/every_step.h"
#include "app/files/scene_files.h"
#include "app/platform/resource_folder.h"
#include "app/records/attempts/records_file.h"
#include "app/records/keeping/kept_attempt.h"
#include "app/steps/lessons/instructor/cohort_board.h"
#include "app/steps/lessons/keeping/lesson_records.h"
#include "app/steps/lessons/trainee.h"
#include "tests/benchmark/bench_report.h"
#include "tests/support/many_attempts.h"
#include "tests/support/postgres_server.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {
namespace {

using namespace app;

constexpr int kShown = 20;  // rows of the instructor's page that its window has room for

void Close(EditorState& state) {
  state.steps.lessons->records->open.reset();
  state.steps.lessons->start->is_stale = true;
  *state.steps.lessons->cohort = CohortBoard();
}

void MeasurePages(BenchReport& report, const char* words, const std::string& place,
                  const RecordsSize& size) {
  EditorState state = MakeEditorState(OpenSceneDocument(ResourceFolder() / "demo"));
  const auto& exercises = state.document().scene.exercises;
  const int count = static_cast<int>(exercises.size());
  std::vector<ExerciseRow> rows;
  rows.reserve(exercises.size());
  for (const Exercise& exercise : exercises) rows.push_back(ExerciseRowOf(exercise));
  LessonRecords& records = *state.steps.lessons->records;
  records.place = place;
  {
    Records all(place);
    FillRecords(all, size, rows);
    std::filesystem::create_directories(all.folder() / "attempts");
    for (const AttemptRecord& attempt : AttemptsOf(all, ""))
      std::ofstream(all.folder() / attempt.log);
  }
  const auto name = [&](const char* what) {
    return fmt::format("{} {} x {}, {}", words, size.trainees, size.attempts, what);
  };
  constexpr int kSamples = 100;
  int sample = 0, wrong = 0;
  records.trainee = CodeOf(0);
  state.steps.lessons->chosen = 0;
  const auto start_page = [&] {
    Close(state);
    records.trainee = CodeOf(37 * ++sample % size.trainees);
    const StartBoard& board = FreshStartBoard(state);
    for (int i = 0; i < count; ++i)
      wrong += board.rows.at(static_cast<std::size_t>(i)).tries != Tries(size, i, count);
  };
  report.Measure(name("trainee's page"), 1, start_page, fmt::format("{} wrong", wrong), kSamples);
  const auto instructor_page = [&] {
    Close(state);
    const CohortBoard& board = FreshCohortBoard(state);
    ReadShownRows(state, 0, kShown);
    const int shown = std::min(kShown, size.trainees);
    for (int row = 0; row < shown; ++row)
      for (int i = 0; i < count; ++i)
        wrong += board.rows.at(static_cast<std::size_t>(row))
                     .cells.at(static_cast<std::size_t>(i))
                     .tries != Tries(size, i, count);
  };
  instructor_page();
  report.Measure(name("instructor's page"), 1, instructor_page, fmt::format("{} wrong", wrong),
                 kSamples);
  const auto scroll = [&] {
    CohortBoard& board = FreshCohortBoard(state);
    for (CohortRowOfPage& row : board.rows) row.cells.clear();
    const int first = 53 * ++sample % size.trainees;
    ReadShownRows(state, first, first + kShown);
  };
  report.Measure(name("scrolled to other rows"), 1, scroll, "", kSamples);
  const auto cell = [&] {
    ChooseCell(state, 37 * ++sample % size.trainees, 0);
    wrong += static_cast<int>(FreshCohortBoard(state).curve.points.size()) != Tries(size, 0, count);
  };
  cell();
  report.Measure(name("cell with its curve"), 1, cell, fmt::format("{} wrong", wrong), kSamples);
  const std::string id = FreshCohortBoard(state).curve.points.at(0).id;
  report.Measure(
      name("attempt opened"), 1,
      [&] { KeepAlive(ReadBundleOf(*records.open, id).attempts.size()); }, "", kSamples);
}

}  // namespace
}  // namespace arthro::test

int main(int argc, char** argv) {
  using namespace arthro::test;
  BenchReport report("record pages", argc, argv);
  std::vector<RecordsSize> sizes = {{10, 5}, {100, 50}, {1000, 50}};
  if (report.quick()) sizes = {{10, 5}};
  try {
    for (const RecordsSize& size : sizes) {
      TempFolder folder;
      MeasurePages(report, "SQLite", (folder / "records.sqlite").string(), size);
    }
    PostgresServer server;
    if (!server.why_none().empty()) {
      std::printf("PostgreSQL is left out: %s\n", server.why_none().c_str());
      return 0;
    }
    for (const RecordsSize& size : sizes) {
      // Logs of a server's attempts lie in the folder of this user's records.
      TempFolder folder;
      ::setenv("XDG_DATA_HOME", folder.path().c_str(), 1);
      {
        arthro::app::Database database(server.connection(), 10);
        database.Do("DROP SCHEMA public CASCADE");
        database.Do("CREATE SCHEMA public");
      }
      MeasurePages(report, "PostgreSQL", server.connection(), size);
    }
  } catch (const std::exception& fault) {
    std::printf("%s\n", fault.what());
    return 1;
  }
  return 0;
}
