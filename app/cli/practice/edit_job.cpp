// edit and practise: the jobs that open a window.
#include <cstdio>
#include <memory>
#include <string>
#include <tuple>

#include <CLI/CLI.hpp>

#include "app/cli/flags/number_flags.h"
#include "app/cli/flags/options_cli.h"
#include "app/cli/input_files.h"
#include "app/cli/job_files.h"
#include "app/cli/jobs.h"
#include "app/cli/practice/lesson_flags.h"
#include "app/cli/practice/window_flags.h"
#include "app/editor/editor.h"
#include "app/recording/live_film.h"
#include "app/recording/unfinished_film.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

// For tests and fault reports; not in the help.
void AddWindowFlags(CLI::App& job, EditorOptions& options) {
  constexpr const char* kHidden = "";  // an empty group is not listed
  job.add_option("--script", options.script, "Text script that drives the window.")->group(kHidden);
  job.add_option_function<std::string>(
         "--size",
         [&options](const std::string& size) {
           std::tie(options.width, options.height) = SizeFromWord("--size", size, {1, 16384});
         },
         "Size of the window, such as 1280x800.")
      ->group(kHidden);
  AddNumber(job, "--scale", options.scale, {1.0, 4.0}, "", "Content scale instead of the screen's")
      ->group(kHidden);
  AddNumberOption(job, "--frames", {{1, kAnyWholeNumber.max}, "", true},
                  "Quit after so many frames",
                  [&options](double frames) { options.frames = static_cast<int>(frames); })
      ->group(kHidden);
  job.add_option("--recent", options.recent, "File of the recent scenes.")->group(kHidden);
  job.add_option("--recovery", options.recovery, "Folder of the copies of unsaved work.")
      ->group(kHidden);
  job.add_flag("--hidden", options.hidden, "Never show the window.")->group(kHidden);
  job.add_flag("--timing", options.timing, "Print the time of the first picture.")->group(kHidden);
}

// Devices of both hands.
struct HandFlags {
  std::string rig, hands, log;
  bool is_zero_force = false;
};

void AddHandFlags(CLI::App& job, HandFlags& flags, JobFiles& files) {
  files.Input(job.add_option("--rig", flags.rig,
                             "Rig file: the devices that hold the scope and the instrument."));
  files
      .Input(job.add_option(
          "--hands", flags.hands,
          "Hands without a device. TRACE.csv or a device log plays recorded hands; plant is a "
          "simulated device. With --rig they have the mounts of that rig."))
      ->type_name("TRACE|plant");
  files.Output(job.add_option("--log", flags.log,
                              "Log of all samples and forces of the devices; replay plays it."),
               kLogFile);
  job.add_flag("--zero-force", flags.is_zero_force,
               "Show forces, but send none to the devices; key 0 ends it.");
}

struct ScreenFlags {
  std::string layout{ToString(FrameShape::kSquare)}, film, head{"scope"};
};

void AddScreenFlags(CLI::App& job, ScreenFlags& flags, EditorOptions& options, JobFiles& files) {
  files.OutputFilm(
      job.add_option("--record", flags.film,
                     "Record the scope's picture from the beginning: .mp4, .mkv or .avi, or single "
                     "pictures in an empty or new FOLDER/ or as FOLDER/frame-%04d.png."));
  job.add_option(
         "--layout", flags.layout,
         "Shape of films and of the trainee's screen: square, or 4:3 or 16:9 with black beside it.")
      ->capture_default_str();
  job.add_option("--head", flags.head,
                 "Camera head: turning with the scope, or held upright while the scope turns in "
                 "it. Keys T and U change it.")
      ->type_name("scope|upright")
      ->capture_default_str();
  job.add_option_function<std::string>(
         "--trainee-screen",
         [&options](const std::string& monitor) {
           options.trainee_screen = 0;
           // CLI11 gives "true" or nothing where there is no value.
           if (monitor.empty() || monitor == "true") return;
           options.trainee_screen =
               static_cast<int>(NumberFromWord("--trainee-screen", monitor, {{1, 64}, "", true}));
         },
         "Show the scope's picture alone on monitor N, counted from 1. Without N: on a monitor "
         "without the window.")
      ->type_name("[N]")
      ->expected(0, 1);
}

void AddRecordsFlag(CLI::App& job, EditorOptions& options) {
  job.add_option("--records", options.records,
                 "Records that attempts at exercises are kept in: a file, or "
                 "postgresql://USER@HOST/NAME. Without it: those of this user.")
      ->type_name("PLACE");
}

// A rig or trace that cannot be used is told before there is a window.
void Open(EditorOptions options, const HandFlags& flags, const JobFiles& files,
          const ScreenFlags& screens = {}) {
  for (const std::string& sentence : FinishFilmsEverywhere(screens.film)) {
    std::fprintf(stderr, "arthroscene: %s\n", sentence.c_str());
    options.notice = sentence;
  }
  CheckLesson(options);
  if (options.lesson && !screens.film.empty())
    throw Error(Code::kBadArgument,
                "--record films a practice from its beginning, and an exercise begins later; press "
                "F2 in the attempt");
  options.frame_shape = FrameShapeOf(screens.layout);
  options.head = simulation::CameraHeadFromString(screens.head);
  if (!screens.film.empty()) {
    options.film = screens.film;
    CheckFilm(*options.film, {.shape = options.frame_shape});
  }
  options.hands = simulation::ReadHands(flags.rig, flags.hands);
  if (!options.hands.notice.empty())
    std::fprintf(stderr, "warning: %s\n", options.hands.notice.c_str());
  options.hands.log = flags.log;
  files.EmptyLog(flags.log);
  options.hands.is_zero_force = flags.is_zero_force;
  RunEditor(options);
}

}  // namespace

void AddEditJob(CLI::App& program) {
  program.require_subcommand(0, 1);
  program.callback([&program] {
    if (program.get_subcommands().empty()) RunEditor({});
  });
  const auto options = std::make_shared<EditorOptions>();
  CLI::App* job = program.add_subcommand("edit", "Open the editor.");
  const auto files = JobFiles::Of(*job);
  files
      ->Input(
          job->add_option("scene", options->scene,
                          "Scene folder, scene.json or .arthro archive. Default: the start page."),
          kSceneInput)
      ->type_name("SCENE");
  const auto hands = std::make_shared<HandFlags>();
  AddHandFlags(*job, *hands, *files);
  AddRecordsFlag(*job, *options);
  AddLookFlags(*job, *options);
  AddWindowFlags(*job, *options);
  files->Run([options, hands, files] { Open(*options, *hands, *files); });
}

void AddPractiseJob(CLI::App& program) {
  const auto options = std::make_shared<EditorOptions>();
  options->practice = true;
  CLI::App* job = program.add_subcommand("practise", "Practise in a scene, or an exercise of it.");
  job->alias("practice");
  const auto files = JobFiles::Of(*job);
  files
      ->Input(
          job->add_option("scene", options->scene, "Scene folder, scene.json or .arthro archive."),
          kSceneInput)
      ->type_name("SCENE")
      ->required();
  const auto hands = std::make_shared<HandFlags>();
  AddHandFlags(*job, *hands, *files);
  const auto screens = std::make_shared<ScreenFlags>();
  AddScreenFlags(*job, *screens, *options, *files);
  AddLessonFlags(*job, *options);
  AddRecordsFlag(*job, *options);
  AddLookFlags(*job, *options);
  AddWindowFlags(*job, *options);
  AddOptions(*job, options->session);
  files->Run([options, hands, screens, files] { Open(*options, *hands, *files, *screens); });
}

}  // namespace arthro::app
