#include "tests/faults/faulted_job.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>

#include "app/records/attempts/attempts.h"
#include "app/records/people/trainees.h"
#include "simulation/scene/json/lens_io.h"
#include "tests/support/board_picture.h"
#include "tests/support/build_paths.h"
#include "tests/support/relief/cavity_clip.h"
#include "tests/support/sample_attempts.h"

namespace arthro::test {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

const char* const kDemo = ARTHRO_SOURCE_DIR "/resources/demo";
const char* const kShort = "periscope-30";  // exercise of the demo that a robot ends in 11 s

std::string To(const char* name) { return std::string("../out/") + name; }

// Two databases: one to read and change, and the export of another trainee's attempts.
void MakeRecords(const Samples& samples) {
  for (const char* const name : {"records", "other"}) {
    const std::string place = samples.in() / (std::string(name) + ".sqlite");
    app::RecordsOptions options = RepeatedOptions(name[0]);
    options.folder = samples.in();
    app::Records records(place, options);
    app::AddTrainee(records, NewTrainee(name));
    const app::SessionRow session = app::StartSession(records, name, "faults", "none");
    for (int i = 0; i < 20; ++i) {
      auto running = app::StartAttempt(records, session, SampleExercise(), "Small knee",
                                       app::AttemptMode::kPractice, 1);
      app::SetResult(running.record, SampleResult(60 + i));
      app::FinishAttempt(records, running.record);
    }
  }
  const ChildRun exported = RunChild(samples.CommandOf(
      {"records", "export", "--records", "other.sqlite", "--json", "export.json"}));
  if (exported.exit_code != 0) throw std::runtime_error("no export: " + exported.err);
}

// A chessboard from four sides through a pinhole with a round window, and a clip that has a relief.
void MakePictures(const Samples& samples) {
  constexpr int kSide = 220;
  constexpr double kMiddle = (kSide - 1) / 2.0, kFocal = 150;
  const auto ray_of = [](double x, double y, glm::dvec3& ray) {
    ray = {(x - kMiddle) / kFocal, (y - kMiddle) / kFocal, 1};
    return std::hypot(x - kMiddle, y - kMiddle) < 0.48 * kSide;
  };
  int number = 0;
  for (const BoardPlace& place : {BoardPlace{0.4, 0, 0.1}, BoardPlace{-0.4, 0.1, 0},
                                  BoardPlace{0, 0.4, 0.2}, BoardPlace{0.1, -0.4, 0.1}})
    cv::imwrite(samples.in() / fmt::format("board{}.png", number++),
                BoardPicture({kSide, kSide}, ray_of, place, ChessAt));
  CavityOptions clip;
  clip.frames = 10;
  fs::create_directory(samples.in() / "cavity");
  WriteCavityClip(samples.in() / "cavity", clip);
  WriteLens(samples.in() / "cavity.json", CavityLensFile(clip));
}

void MakeScript(const Samples& samples) {
  std::ofstream script(samples.in() / "save.script");
  script << "wait job\nclick Portals\n";
  for (int i = 0; i < 10; ++i)
    script << "set \"Incision spacing\" " << 10 + i << "\nkey ctrl+s\nwait job\n";
  std::ofstream(samples.in() / "pairs.json") << R"({"schema": "arthroscene.pairs/1", "pairs": [
 {"model": [0.006, 0, 0], "place": {"position": [0.0063, 0.0002, 0.031]}},
 {"model": [-0.006, 0, 0], "place": {"position": [-0.0059, 0, 0.031]}},
 {"model": [0, 0.006, 0], "place": {"position": [0, 0.0061, 0.031]}},
 {"model": [0, 0, -0.006], "place": {"position": [0, 0, 0.0252]}}]})";
}

void MakeAttempt(const Samples& samples) {
  const ChildRun made =
      RunChild(samples.CommandOf({"robot", kDemo, "--exercise", kShort, "-o", "robot.attempt"}));
  if (made.exit_code != 0) throw std::runtime_error("no attempt: " + made.err);
}

// Arguments with others behind them: another result of the same job.
Words Also(Words arguments, const Words& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

std::vector<FaultedJob> AuthoringJobs() {
  std::vector<FaultedJob> jobs;
  const auto add = [&](FaultedJob job) -> FaultedJob& { return jobs.emplace_back(std::move(job)); };
  add({"adjust", {"adjust", "knee", "--mirror", "-o", To("mirrored")}, {}, {"mirrored/"}});
  add({"adjust to an archive",
       {"adjust", "knee", "--side", "left", "--overwrite", "-o", To("left.arthro")},
       {"adjust", "knee", "--side", "right", "-o", To("left.arthro")},
       {"left.arthro"}});
  add({"align",
       {"align", "knee", "--tissue", "octahedron", "--pairs", "pairs.json", "-o", To("aligned"),
        "--report", To("align.json")},
       {},
       {"aligned/", "align.json"}});
  const Words depth{"depth", "pano.png", "-o", To("d.tiff")};
  add({"depth",
       depth,
       Also(depth, {"--estimator", "shading"}),
       {"d.tiff"},
       {"depth", "pano.png", "-o", "-"}});
  add({"lens",
       {"lens", "board0.png", "board1.png", "board2.png", "board3.png", "--spacing-mm", "1", "-o",
        To("lens.json"), "--report", To("l.json")},
       {},
       {"lens.json", "l.json"}});
  add({"model",
       {"model", "loose-body", "--overwrite", "-o", To("m.ply"), "--report", To("m.json")},
       {"model", "synovial-tuft", "-o", To("m.ply"), "--report", To("m.json")},
       {"m.ply", "m.json"},
       {"model", "loose-body", "--overwrite", "-o", To("m.ply"), "--report", "-"}});
  add({"model in a scene",
       {"model", "loose-body", "--scene", "knee", "--save-scene", To("with"), "--budget", "coarse"},
       {},
       {"with/"}});
  const Words panorama{"panorama", "frames", "-o", To("p.png"), "--report", To("p.json")};
  add({"panorama",
       panorama,
       Also(panorama, {"--leave-out", "2"}),
       {"p.png", "p.json"},
       {"panorama", "frames", "-o", "-", "--report", To("p.json")}});
  add({"panorama with a scene",
       Also(panorama, {"--scene", To("made")}),
       {},
       {"p.png", "p.json", "made/"}});
  add({"phantom",
       {"phantom", "--size", "S", "--footage-frames", "2", "-o", To("knee")},
       {"phantom", "--size", "S", "--footage-frames", "2", "-o", To("knee"), "--seed", "2"},
       {"knee/"}})
      .is_slow = true;
  add({"rectify",
       {"rectify", "film.avi", "--lens", "knee/lens.json", "-o", To("flat")},
       {},
       {"flat/"}});
  const Words relief{"relief",     "cavity",   "--lens",     "cavity.json", "-o",
                     To("r.tiff"), "--report", To("r.json"), "--scene",     To("made")};
  add({"relief",
       relief,
       {},
       {"r.tiff", "r.json", "made/"},
       {"relief", "cavity", "--lens", "cavity.json", "-o", "-", "--report", To("r.json")}});
  const Words tets{"tetrahedralize", "body.ply", "--unit",    "m", "-o",
                   To("t.vtu"),      "--report", To("t.json")};
  add({"tetrahedralize",
       Also(tets, {"--max-edge-mm", "1"}),
       Also(tets, {"--max-edge-mm", "3"}),
       {"t.vtu", "t.json"},
       {"tetrahedralize", "body.ply", "--unit", "m", "--max-edge-mm", "1", "-o", "-"}})
      .has_child = true;
  return jobs;
}

std::vector<FaultedJob> PracticeJobs() {
  std::vector<FaultedJob> jobs;
  const auto add = [&](FaultedJob job) -> FaultedJob& { return jobs.emplace_back(std::move(job)); };
  add({"check",
       {"check", "knee", "--report", To("check.json")},
       {},
       {"check.json"},
       {"check", "knee", "--report", "-"}});
  add({"demo", {"demo", "-o", To("demo"), "--pictures", "2", "--size", "64"}, {}, {"demo/"}});
  add({"help", {"help", "troubleshooting"}, {}, {}});
  const Words replay{"replay", "knee", "session.bin", "-o", To("f.csv"), "--report", To("r.json")};
  const Words robot{"robot", kDemo, "--exercise", kShort, "--overwrite", "-o", To("r.attempt")};
  add({"robot", robot, Also(robot, {"--seed", "2"}), {"r.attempt"}});
  add({"replay",
       replay,
       Also(replay, {"--static-friction", "0"}),
       {"f.csv", "r.json"},
       {"replay", "knee", "session.bin", "-o", "-"}});
  for (const char* const film : {"film.avi", "film.mp4", "film.mkv"})
    add({std::string("replay --video ") + film,
         {"replay", "knee", "trace.csv", "-o", To("f.csv"), "--video", To(film), "--video-size",
          "256", "--fps", "25"},
         {},
         {"f.csv", film}})
        .is_film = true;
  add({"view",
       {"view", "knee", "-o", To("v.png")},
       {"view", "knee", "-o", To("v.png"), "--roll-deg", "30"},
       {"v.png"},
       {"view", "knee", "-o", "-"}});
  FaultedJob& run = add({"run", {"run", "save.script", "--scene", To("knee")}, {}, {"knee/"}});
  run.in_place = "knee";
  run.check = {"check", To("knee")};
  run.has_child = true;
  return jobs;
}

std::vector<FaultedJob> MeasuringJobs() {
  std::vector<FaultedJob> jobs;
  const auto add = [&](FaultedJob job) -> FaultedJob& { return jobs.emplace_back(std::move(job)); };
  add({"assess",
       {"assess", "knee", "trace.csv", "-o", To("a.csv"), "--report", To("a.html"), "--json",
        To("a.json")},
       {"assess", "knee", "trace.csv", "-o", To("a.csv"), "--report", To("a.html"), "--json",
        To("a.json"), "--harm-force", "1"},
       {"a.csv", "a.html", "a.json"},
       {"assess", "knee", "trace.csv", "-o", "-"}});
  const Words attempt{"assess",    kDemo,      "robot.attempt", "--exercise", kShort,      "-o",
                      To("r.csv"), "--report", To("r.html"),    "--json",     To("r.json")};
  add({"assess an attempt",
       attempt,
       Also(attempt, {"--harm-force", "1"}),
       {"r.csv", "r.html", "r.json"}});
  add({"bench",
       {"bench", "micro", "--quick", "--only", "scope", "--json", To("b.json"), "--plot",
        To("b.svg")},
       {},
       {"b.json", "b.svg"},
       {"bench", "micro", "--quick", "--only", "scope", "--json", "-"}});
  const Words centres{"centres", "knee", "-o", To("c.csv"), "--picture", To("c.png")};
  add({"centres",
       centres,
       Also(centres, {"--roll-steps", "30"}),
       {"c.csv", "c.png"},
       {"centres", "knee", "-o", "-"}});
  add({"devices",
       {"devices", "--json", To("dev.json")},
       {},
       {"dev.json"},
       {"devices", "--json", "-"}})
      .has_arm = true;
  add({"devices --self-test",
       {"devices", "--self-test", "--seconds", "1", "--model", "woodenhaptics_2015", "--log",
        To("self.bin")},
       {},
       {"self.bin"}});
  jobs.back().has_arm = jobs.back().is_log = true;
  add({"devices --watch", {"devices", "--watch", "--seconds", "2"}, {}, {}}).has_arm = true;
  add({"pivot",
       {"pivot", "swing.csv", "--swing", "scope", "-o", To("pivot.json")},
       {"pivot", "poses.csv", "-o", To("pivot.json")},
       {"pivot.json"},
       {"pivot", "swing.csv", "--swing", "scope", "-o", "-"}});
  const Words reach{"reach", "knee", "-o", To("reach.csv"), "--picture", To("reach.png")};
  add({"reach",
       reach,
       Also(reach, {"--spacing-mm", "25"}),
       {"reach.csv", "reach.png"},
       {"reach", "knee", "-o", "-"}});
  add({"solve",
       {"solve", "block/moving.json", "-o", To("s.json"), "--vtu", To("s.vtu")},
       {"solve", "block/case.json", "-o", To("s.json"), "--vtu", To("s.vtu")},
       {"s.json", "s.vtu"},
       {"solve", "block/moving.json", "-o", "-"}});
  return jobs;
}

std::vector<FaultedJob> RecordsJobs() {
  std::vector<FaultedJob> jobs;
  const Words source{"--records", "records.sqlite"}, changed{"--records", To("records.sqlite")};
  jobs.push_back({"records export",
                  Also({"records", "export", "-o", To("e.csv"), "--json", To("e.json"), "--xapi",
                        To("x.json")},
                       source),
                  {},
                  {"e.csv", "e.json", "x.json"},
                  Also({"records", "export", "-o", "-"}, source)});
  jobs.push_back({"records backup",
                  Also({"records", "backup", "-o", To("backup.sqlite")}, source),
                  {},
                  {"backup.sqlite"}});
  for (const char* const reader : {"list", "check", "reference"})
    jobs.push_back({std::string("records ") + reader, Also({"records", reader}, source), {}, {}});
  for (const auto& [name, arguments] :
       {std::pair<const char*, Words>{"records import", {"records", "import", "export.json"}},
        {"records trainee", {"records", "trainee", "add", "T-9"}},
        {"records erase", {"records", "erase", "records", "--really", "records"}}}) {
    FaultedJob job{name, Also(arguments, changed), {}, {"records.sqlite"}};
    job.in_place = "records.sqlite";
    job.check = Also({"records", "check"}, changed);
    jobs.push_back(job);
  }
  return jobs;
}

}  // namespace

std::vector<FaultedJob> EveryFaultedJob(const Samples& samples) {
  MakeRecords(samples);
  MakePictures(samples);
  MakeScript(samples);
  MakeAttempt(samples);
  fs::copy_file(fs::path(ARTHRO_PROGRAM).replace_filename("arthroscene-bench"),
                samples.in() / "../bin/arthroscene-bench");
  std::vector<FaultedJob> all;
  for (auto make : {AuthoringJobs, PracticeJobs, MeasuringJobs, RecordsJobs})
    for (FaultedJob& job : make()) all.push_back(std::move(job));
  return all;
}

std::vector<Fault> FaultsOf(const FaultedJob& job) {
  std::vector<Fault> faults = {Fault::kKill,      Fault::kEnd,     Fault::kFullDisk,
                               Fault::kFileLimit, Fault::kCutPipe, Fault::kClockForward,
                               Fault::kClockBack, Fault::kStall};
  if (job.has_child) faults.push_back(Fault::kKilledChild);
  if (job.has_arm) faults.push_back(Fault::kPulledDevice);
  return faults;
}

}  // namespace arthro::test
