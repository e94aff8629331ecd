// Ends an editor at random moments of a session of random edits, saves and undos, and looks at what
// is left: the saved scene must open, and the scene or the recovery copy must hold every edit but
// those of the last seconds.
//   hostile_editor_kills [--count 20] [--seed 1] [--scene FOLDER] [--most-lost-s 2]
// The child is this program with --child: the editor's state, commands and recovery copy without a
// window, in a loop of its own.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <fstream>
#include <random>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/editor/every_step.h"
#include "app/files/recovery_copy.h"
#include "app/files/scene_files.h"
#include "app/state/edits.h"
#include "app/steps/depth/depth_step.h"
#include "authoring/project/document_io.h"
#include "simulation/core/error.h"
#include "tests/hostile/child_run.h"
#include "tests/support/small_scene.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {
namespace {

namespace fs = std::filesystem;
using app::EditorState;

double Now() {  // s, the same clock in every process
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// ---- The session that is ended. ----

// One random edit; each gives the scene an author of its own, by which its state is known again.
void EditOnce(EditorState& state, std::mt19937& random, int number) {
  const auto pick = [&](int count) {
    return std::uniform_int_distribution<int>(0, count - 1)(random);
  };
  const int kind = pick(12);
  if (kind == 0 && state.history.CanUndo()) return state.history.Undo();
  if (kind == 1 && state.history.CanRedo()) return state.history.Redo();
  // Half of the edits go on with a slider, so that they are one step.
  const std::string key = pick(2) == 0 ? "slider" : "";
  app::Edit(state, fmt::format("Edit {}", number), key, [&](authoring::Document& next) {
    next.scene.author = fmt::format("edit {}", number);
    if (kind == 2) next.scene.title = fmt::format("title {}", pick(1000));
    if (kind == 3) next.scene.portals.incision_spacing = 0.02 + 1e-5 * pick(1000);
    if (kind == 4 && !next.scene.tissues.empty())
      next.scene.tissues[0].pose.position.z = 0.02 + 1e-5 * pick(1000);
    if (kind == 5 && next.depth) {
      DepthMap map = *next.depth;
      map.at(pick(map.width), pick(map.height)) = 1e-3f;
      next.depth = Share(std::move(map));
      next.is_depth_imported = true;
    }
    if (kind == 6 && next.scene.tissues.size() < 4 && !next.scene.tissues.empty()) {
      next.scene.tissues.push_back(next.scene.tissues[0]);
      next.scene.tissues.back().name = fmt::format("tissue {}", number);
      next.surfaces.push_back(next.surfaces[0]);
    }
    if (kind == 7 && next.scene.tissues.size() > 1) {
      next.scene.tissues.pop_back();
      next.surfaces.pop_back();
    }
  });
  if (pick(20) == 0) app::EndDrag(state);
}

int RunSession(const fs::path& scene, const fs::path& copies, const fs::path& log,
               unsigned long long seed) {
  std::mt19937 random(static_cast<unsigned>(seed));
  EditorState state = app::MakeEditorState(app::NewDocument());
  app::StartDocument(state, authoring::OpenDocument(scene), true, app::NoteOnDisk(scene));
  app::RecoveryCopy copy(copies);
  const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  const auto say = [&] {
    const std::string line = fmt::format("{:.6f} {}\n", Now(), state.document().scene.author);
    if (::write(file, line.data(), line.size()) < 0) std::perror("log");
  };
  say();
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int number = 1;; ++number) {
    // Bursts, as of a slider that is dragged, and pauses.
    const double until = Now() + (share(random) < 0.03 ? 1.5 : 0.02) * share(random);
    do {
      app::FinishWork(state);
      state.dialogs.clear();
      copy.Follow(state, Now());
      std::this_thread::sleep_for(std::chrono::milliseconds(4));
    } while (Now() < until || (state.jobs.busy() && state.jobs.blocks_editing()));
    EditOnce(state, random, number);
    say();
    if (share(random) < 0.004 && !state.jobs.busy()) app::ReplaceChangedScene(state);
  }
}

// ---- What it leaves. ----

struct Said {
  double t = 0;
  std::string author;
};

std::vector<Said> ReadLog(const fs::path& log) {
  std::vector<Said> said;
  std::ifstream in(log);
  for (std::string line; std::getline(in, line);) {
    const auto blank = line.find(' ');
    if (blank != line.npos) said.push_back({std::stod(line), line.substr(blank + 1)});
  }
  return said;
}

// Seconds of edits before `end` that a document with this author lacks; more than any session where
// the author is not known.
double Lost(const std::vector<Said>& said, const std::string& author, double end) {
  for (std::size_t i = said.size(); i-- > 0;)
    if (said[i].author == author) return i + 1 < said.size() ? end - said[i + 1].t : 0.0;
  return 1e9;
}

struct Outcome {
  double lost_s = 0;
  bool from_copy = false;
  std::string fault;
};

Outcome Judge(const fs::path& scene, const fs::path& copies, const std::vector<Said>& said,
              double end) {
  Outcome outcome;
  try {
    outcome.lost_s = Lost(said, authoring::OpenDocument(scene).scene.author, end);
  } catch (const std::exception& error) {
    outcome.fault = std::string("the saved scene: ") + error.what();
    return outcome;
  }
  for (app::RecoverySession& session : app::RecoverySession::Left(copies)) {
    if (const auto note = session.ReadNote(); !note.problem.empty()) outcome.fault = note.problem;
    try {
      const double lost = Lost(said, authoring::OpenDocument(session.copy()).scene.author, end);
      if (lost < outcome.lost_s) {
        outcome.lost_s = lost;
        outcome.from_copy = true;
      }
    } catch (const std::exception& error) {
      outcome.fault = std::string("the recovery copy: ") + error.what();
    }
  }
  return outcome;
}

int RunKills(int count, unsigned long long seed, const std::string& given, double most_lost,
             const std::string& self) {
  std::mt19937_64 random(seed);
  int failures = 0, copies_used = 0;
  std::size_t edits = 0;
  std::vector<double> lost;
  for (int i = 0; i < count; ++i) {
    const TempFolder temp;
    if (given.empty())
      WriteSmallScene(temp / "knee");
    else
      fs::copy(given, temp / "knee", fs::copy_options::recursive);
    const double life = std::uniform_real_distribution<double>(0.2, 6.0)(random);
    double end = 0, begun = 0;
    ChildCommand command;
    command.arguments = {self,
                         "--child",
                         (temp / "knee").string(),
                         (temp / "copies").string(),
                         (temp / "log").string(),
                         "--seed",
                         std::to_string(random() % 1000000)};
    command.folder = temp.path();
    fs::create_directory(temp / "scratch");
    command.scratch = temp / "scratch";
    const ChildRun run = RunChild(command, [&](int group, double seconds) {
      std::error_code ignored;
      if (begun == 0 && fs::exists(temp / "log", ignored)) begun = seconds;
      if (end != 0 || begun == 0 || seconds < begun + life) return;
      end = Now();
      ::kill(-group, SIGKILL);
    });
    const std::vector<Said> said = ReadLog(temp / "log");
    Outcome outcome = Judge(temp / "knee", temp / "copies", said, end);
    if (run.signal != SIGKILL) outcome.fault = "the session ended by itself: " + run.err;
    if (outcome.fault.empty() && outcome.lost_s > most_lost)
      outcome.fault = fmt::format("{:.2f} s of edits are lost", outcome.lost_s);
    edits += said.size();
    copies_used += outcome.from_copy;
    lost.push_back(outcome.lost_s);
    if (outcome.fault.empty()) continue;
    ++failures;
    fmt::print("kill {} after {:.2f} s: {}\n", i, life, outcome.fault);
  }
  std::sort(lost.begin(), lost.end());
  fmt::print(
      "{} kills in {} edits: {} times the recovery copy was the newer one; edits lost: median "
      "{:.2f} s, worst {:.2f} s; {} failures\n",
      count, edits, copies_used, lost[lost.size() / 2], lost.back(), failures);
  return failures == 0 ? 0 : 1;
}

}  // namespace
}  // namespace arthro::test

int main(int argc, char** argv) {
  CLI::App arguments("Ends editors at random moments and looks at what is left.");
  int count = 20;
  unsigned long long seed = 1;
  double most_lost = 2.0;
  std::string scene;
  std::vector<std::string> child;
  arguments.add_option("--count", count, "Kills.")->check(CLI::Range(1, 100000));
  arguments.add_option("--seed", seed, "Start of the random sequence.");
  arguments.add_option("--scene", scene,
                       "Folder of the scene that is edited; a small one if left out.");
  arguments.add_option("--most-lost-s", most_lost, "Edits older than this must not be lost.");
  arguments.add_option("--child", child, "Scene, folder of copies and log of a session.")
      ->expected(3);
  CLI11_PARSE(arguments, argc, argv);
  try {
    if (!child.empty()) return arthro::test::RunSession(child[0], child[1], child[2], seed);
    return arthro::test::RunKills(count, seed, scene, most_lost,
                                  std::filesystem::canonical("/proc/self/exe").string());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "hostile_editor_kills: %s\n", error.what());
    return 1;
  }
}
