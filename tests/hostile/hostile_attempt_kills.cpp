// Ends a window at random moments of attempts, and looks at what the next start finds: every
// attempt that began must be in the records once, none may be running, those that had ended must
// have their outcome, and the log must hold every frame but those of the last quarter of a second.
//   hostile_attempt_kills [--count 20] [--seed 1] [--scene FOLDER] [--most-lost-s 0.25]
// The child is this program with --child: the editor's state and commands without a window.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <fstream>
#include <map>
#include <random>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/editor/every_step.h"
#include "app/files/scene_files.h"
#include "app/records/exchange/backup.h"
#include "app/records/people/trainees.h"
#include "app/state/edits.h"
#include "app/steps/lessons/attempt.h"
#include "app/steps/lessons/exercise_edit.h"
#include "app/steps/lessons/keeping/lesson_records.h"
#include "app/steps/lessons/running_attempt.h"
#include "app/steps/lessons/trainee.h"
#include "app/steps/practice/practice_step.h"
#include "authoring/project/document_io.h"
#include "simulation/core/error.h"
#include "tests/hostile/child_run.h"
#include "tests/support/small_scene.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {
namespace {

namespace fs = std::filesystem;
using app::EditorState;

constexpr double kWindowFrame = 1.0 / 60;  // s
constexpr const char* kCode = "T-1";

// ---- The session that is ended. ----

int RunSession(const fs::path& scene, const std::string& place, const fs::path& log,
               unsigned long long seed) {
  std::mt19937 random(static_cast<unsigned>(seed));
  std::uniform_real_distribution<double> share(0.0, 1.0);
  EditorState state = app::MakeEditorState(app::NewDocument());
  app::StartDocument(state, authoring::OpenDocument(scene), true, app::NoteOnDisk(scene));
  state.steps.practice->pace = simulation::TissuePace::kInline;
  app::OpenLessons(state, place);
  app::TakeTraineeCode(state, kCode);
  if (state.document().scene.exercises.empty()) {
    state.step = app::Step::kExercises;
    app::AddExercise(state);
  }
  state.steps.lessons->chosen = 0;
  const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  const auto say = [&](const std::string& what, const std::string& id, std::size_t frames) {
    const std::string line = fmt::format("{} {} {}\n", what, id, frames);
    if (::write(file, line.data(), line.size()) < 0) std::perror("log");
  };
  for (;;) {
    app::BeginExercise(state);
    while (!state.practice) {
      app::FinishWork(state);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    const auto& kept = state.steps.lessons->records->attempt;
    if (!kept) throw std::runtime_error(state.message);
    const std::string id = kept->record().id;
    say("began", id, 0);
    const int frames = static_cast<int>(60 * (0.2 + 3 * share(random)));
    // Paced as a window is, so that kills at random times meet attempts and not the gaps between.
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < frames && state.practice; ++i) {
      std::this_thread::sleep_until(begin + i * std::chrono::duration<double>(kWindowFrame));
      auto pose = state.practice->scope().pose();
      pose.roll += 0.05 * (share(random) - 0.5);
      state.practice->scope().Set(pose);
      state.practice->Advance(kWindowFrame);
      app::FollowAttempt(state);
      if (state.practice) say("frames", id, state.steps.lessons->running->frames.size());
    }
    if (state.practice) app::StopAttempt(state);
    say("ended", id, 0);
  }
}

// ---- What it leaves. ----

struct Said {
  std::size_t frames = 0;
  bool has_ended = false;
};

std::map<std::string, Said> ReadSaid(const fs::path& log) {
  std::map<std::string, Said> said;
  std::ifstream lines(log);
  std::size_t frames = 0;
  for (std::string what, id; lines >> what >> id >> frames;) {
    Said& own = said[id];
    if (what == "frames") own.frames = frames;
    if (what == "ended") own.has_ended = true;
  }
  return said;
}

struct Outcome {
  std::vector<std::string> faults;
  std::size_t attempts = 0, cut_short = 0;
  double lost_s = 0;
};

Outcome Judge(const std::string& place, const fs::path& log) {
  Outcome outcome;
  const auto fail = [&](const std::string& sentence) { outcome.faults.push_back(sentence); };
  app::LessonRecords records;
  records.place = place;
  app::OpenRecords(records);
  if (!records.open) {
    fail(records.fault);
    return outcome;
  }
  std::map<std::string, app::AttemptRecord> rows;
  for (const app::AttemptRecord& row : app::AttemptsOf(*records.open, kCode))
    if (!rows.emplace(row.id, row).second) fail("attempt " + row.id + " is there twice");
  const auto said = ReadSaid(log);
  for (const auto& [id, own] : said) {
    if (!rows.contains(id)) {
      fail("attempt " + id + " is lost");
      continue;
    }
    const app::AttemptRecord row = *app::ReadAttempt(*records.open, id);
    if (row.outcome != app::AttemptOutcome::kStopped)
      fail(fmt::format("attempt {} is {}", id, simulation::ToString(row.outcome)));
    if (row.metrics.empty()) fail("attempt " + id + " has no metrics");
    outcome.cut_short += own.has_ended ? 0 : 1;
    const auto recording = simulation::ReadAttempt(app::FolderOf(records) / row.log);
    const double lost = simulation::kFrameTime * (static_cast<double>(own.frames) -
                                                  static_cast<double>(recording.frames.size()));
    outcome.lost_s = std::max(outcome.lost_s, lost);
  }
  // A child that is killed between its commit and its line has one attempt more.
  if (rows.size() > said.size() + 1) fail("there are more attempts than began");
  for (const std::string& fault : app::CheckRecords(*records.open).faults) fail(fault);
  outcome.attempts = rows.size();
  return outcome;
}

int RunKills(int count, unsigned long long seed, const std::string& given, double most_lost,
             const std::string& self) {
  std::mt19937_64 random(seed);
  int failures = 0;
  std::size_t attempts = 0, cut_short = 0;
  std::vector<double> lost;
  for (int i = 0; i < count; ++i) {
    const TempFolder temp;
    if (given.empty())
      WriteSmallScene(temp / "knee");
    else
      fs::copy(given, temp / "knee", fs::copy_options::recursive);
    const std::string place = (temp / "records.sqlite").string();
    {
      app::Records records(place);
      app::TraineeRow trainee;
      trainee.code = kCode;
      app::AddTrainee(records, trainee);
    }
    const double life = std::uniform_real_distribution<double>(0.0, 4.0)(random);
    double begun = 0;
    bool is_killed = false;
    ChildCommand command;
    command.arguments = {self,
                         "--child",
                         (temp / "knee").string(),
                         place,
                         (temp / "log").string(),
                         "--seed",
                         std::to_string(random() % 1000000)};
    command.folder = temp.path();
    fs::create_directory(temp / "scratch");
    command.scratch = temp / "scratch";
    const ChildRun run = RunChild(command, [&](int group, double seconds) {
      std::error_code ignored;
      if (begun == 0 && fs::file_size(temp / "log", ignored) > 0 && !ignored) begun = seconds;
      if (is_killed || begun == 0 || seconds < begun + life) return;
      is_killed = true;
      ::kill(-group, SIGKILL);
    });
    Outcome outcome = Judge(place, temp / "log");
    if (run.signal != SIGKILL) outcome.faults.push_back("the session ended: " + run.err);
    if (outcome.lost_s > most_lost)
      outcome.faults.push_back(fmt::format("{:.2f} s of the log are lost", outcome.lost_s));
    attempts += outcome.attempts;
    cut_short += outcome.cut_short;
    lost.push_back(outcome.lost_s);
    for (const std::string& fault : outcome.faults)
      fmt::print("kill {} after {:.2f} s: {}\n", i, life, fault);
    failures += outcome.faults.empty() ? 0 : 1;
  }
  std::sort(lost.begin(), lost.end());
  fmt::print(
      "{} kills in {} attempts, {} of them cut short; lost of the log: median {:.2f} s, worst "
      "{:.2f} s; {} failures\n",
      count, attempts, cut_short, lost[lost.size() / 2], lost.back(), failures);
  if (cut_short == 0) fmt::print("no kill met a running attempt: nothing was tested\n");
  return failures == 0 && cut_short > 0 ? 0 : 1;
}

}  // namespace
}  // namespace arthro::test

int main(int argc, char** argv) {
  CLI::App arguments("Ends windows at random moments of attempts and looks at what is left.");
  int count = 20;
  unsigned long long seed = 1;
  double most_lost = 0.25;
  std::string scene;
  std::vector<std::string> child;
  arguments.add_option("--count", count, "Kills.")->check(CLI::Range(1, 100000));
  arguments.add_option("--seed", seed, "Start of the random sequence.");
  arguments.add_option("--scene", scene, "Folder of the scene; a small one if left out.");
  arguments.add_option("--most-lost-s", most_lost, "Frames older than this must not be lost.");
  arguments.add_option("--child", child, "Scene, records and log of a session.")->expected(3);
  CLI11_PARSE(arguments, argc, argv);
  try {
    if (!child.empty()) return arthro::test::RunSession(child[0], child[1], child[2], seed);
    return arthro::test::RunKills(count, seed, scene, most_lost,
                                  std::filesystem::canonical("/proc/self/exe").string());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "hostile_attempt_kills: %s\n", error.what());
    return 1;
  }
}
