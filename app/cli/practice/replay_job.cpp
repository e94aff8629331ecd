// arthroscene replay SCENE TRACE -o forces.csv [--report r.json] [--pictures DIR] [--video FILE]
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/flags/number_flags.h"
#include "app/cli/flags/options_cli.h"
#include "app/cli/input_files.h"
#include "app/cli/job_files.h"
#include "app/cli/job_progress.h"
#include "app/cli/jobs.h"
#include "app/cli/practice/replay_pictures.h"
#include "app/cli/practice/shipped_presets.h"
#include "app/recording/unfinished_film.h"
#include "app/recording/video_file.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/folders/partial_folder.h"
#include "simulation/device/log/log_replay.h"
#include "simulation/practice/replay/replay.h"
#include "simulation/scene/files/scene_io.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

struct ReplayJob {
  fs::path scene, trace, forces, report;
  simulation::SessionOptions options;
  fs::path pictures, video;
  ReplayPictures::Form of_pictures, of_video{.size = 720};
  std::string layout{ToString(FrameShape::kSquare)}, head, disturb;
  int disturb_seed = 0;
  bool no_flecks = false;
};

void Run(const ReplayJob& job) {
  CheckOptions(job.options);
  if (!job.video.empty())
    for (const std::string& sentence : FinishFilmsIn(job.video.parent_path(), job.video))
      fmt::print(stderr, "arthroscene: {}\n", sentence);
  const FrameShape shape = FrameShapeOf(job.layout);
  ReplayPictures::Wish wish;
  if (!job.head.empty()) wish.head = simulation::CameraHeadFromString(job.head);
  if (!job.disturb.empty()) wish.disturbances = simulation::ParseDisturbances(job.disturb);
  wish.has_flecks = !job.no_flecks;
  if (wish.disturbances) wish.disturbances->seed = job.disturb_seed;
  const VideoSize video_size = {FrameWidth(shape, job.of_video.size), job.of_video.size};
  if (!job.video.empty()) CheckVideo(job.video, video_size, job.of_video.rate);
  std::string notice;
  const simulation::Recording recording = simulation::ReadRecording(job.trace, notice);
  if (!notice.empty()) fmt::print(stderr, "warning: {}\n", notice);
  const LoadedScene loaded = LoadScene(job.scene);
  const bool tells_head = std::ranges::any_of(
      recording.wishes, [](const auto& timed) { return timed.wish.is_complete; });
  if (!tells_head && !wish.head) wish.head = simulation::CameraHead{.is_upright = true};

  const Progress progress = TerminalProgress();
  std::optional<PartialFolder> folder;
  std::optional<ReplayPictures> pictures;
  std::optional<VideoFile> video;
  if (!job.pictures.empty() || !job.video.empty())
    pictures.emplace(loaded, recording.rows.front().sample.t, recording.rows.back().sample.t, wish,
                     ShippedLooks(loaded.scene));
  const auto add = [&](ReplayPictures::Form form, ReplayPictures::Take take) {
    form.shape = shape;
    pictures->AddRow(form, std::move(take));
  };
  if (!job.pictures.empty())
    add(job.of_pictures, IntoFolder(folder.emplace(job.pictures).beside()));
  if (!job.video.empty()) {
    video.emplace(job.video, video_size, job.of_video.rate);
    add(job.of_video, [&](const ColourImage& picture) { video->Add(picture); });
  }
  simulation::ReplayWatch watch;
  if (pictures)
    watch = [&](double t, const auto& snapshot, const auto* world) {
      pictures->Watch(t, snapshot, world);
    };
  simulation::ReplayReport report;
  const auto forces = simulation::Replay(loaded, recording, job.options, progress, &report,
                                         ShippedTissuePresets(), watch);
  for (const std::string& message : report.messages)
    fmt::print(stderr, "note: {}\n", PrintableLine(message));
  if (video) video->Finish();
  if (folder) folder->PutInPlace();
  WriteAtomically(job.forces, simulation::ForcesText(forces, loaded.scene));
  if (!job.report.empty())
    WriteAtomically(job.report, simulation::ReportText(report, loaded.scene));
}

}  // namespace

void AddReplayJob(CLI::App& program) {
  auto job = std::make_shared<ReplayJob>();
  CLI::App* command = program.add_subcommand(
      "replay", "Play recorded hands in a scene on a fixed clock, and write the forces.");
  const auto files = JobFiles::Of(*command);
  files
      ->Input(
          command->add_option("SCENE", job->scene, "Scene folder, scene.json or .arthro archive."),
          kSceneInput)
      ->required();
  files
      ->Input(
          command->add_option("TRACE", job->trace, "Recorded devices: TRACE.csv or a device log."))
      ->required();
  files
      ->Output(command->add_option("-o,--output", job->forces,
                                   "forces.csv to write; - is standard output."),
               kForcesFile)
      ->required();
  files->Output(command->add_option("--report", job->report,
                                    "Report as JSON: peaks, contacts, faults, times."),
                kReplayReportFile);
  files->OutputFolder(
      command->add_option(
          "--pictures", job->pictures,
          "Folder for the scope's pictures: frame_00000.png, frame_00001.png, and so on."),
      {{"frame_[0-9]{5,}[.]png", kPictureFile}});
  AddNumber(*command, "--size", job->of_pictures.size,
            {StillPictures::kMinSize, StillPictures::kMaxSize}, "px", "Height of a picture.");
  AddNumber(*command, "--rate", job->of_pictures.rate, {0.1, 1000.0}, "per second",
            "Pictures per second.");
  files->Output(command->add_option(
                    "--video", job->video,
                    "Film of the scope's picture: .mp4 or .mkv (H.264), or .avi (Motion JPEG)."),
                kFilmFile);
  AddNumber(*command, "--video-size", job->of_video.size, {kMinVideoSize, kMaxVideoSize}, "px",
            "Height of the film; an even number.");
  AddNumber(*command, "--fps", job->of_video.rate, {kMinVideoRate, kMaxVideoRate}, "per second",
            "Pictures of the film per second.");
  command
      ->add_option("--layout", job->layout,
                   "Shape of pictures and film: square, or 4:3 or 16:9 with the round picture in "
                   "the middle.")
      ->capture_default_str();
  command
      ->add_option("--head", job->head,
                   "Camera head: held upright while the scope turns in it, or turning with the "
                   "scope. Default: as it was recorded; upright for a TRACE.csv.")
      ->type_name("upright|scope");
  command->add_option("--disturb", job->disturb,
                      "Disturbances of pictures and film in place of the recorded ones, as the job "
                      "`view` takes them: " +
                          simulation::DisturbanceHelp());
  command->add_flag("--no-flecks", job->no_flecks,
                    "Leave out the flecks that drift in the fluid of the scene.");
  AddNumber(*command, "--disturb-seed", job->disturb_seed, kAnyWholeNumber, "",
            "Seed of bubbles, flakes and swirls.");
  AddOptions(*command, job->options);
  files->Run([job] { Run(*job); });
}

}  // namespace arthro::app
