// run: repeats a script of the editor without anybody at the window.
#include <cstdio>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>

#include "app/cli/input_files.h"
#include "app/cli/job_files.h"
#include "app/cli/jobs.h"
#include "app/cli/practice/window_flags.h"
#include "app/editor/editor.h"
#include "app/editor/every_step.h"
#include "app/platform/own_display.h"
#include "app/platform/script/script.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/input_file.h"

namespace arthro::app {
namespace {

// A 4K screen, so that a script may ask for any usual size of the window.
constexpr int kOwnWidth = 3840, kOwnHeight = 2160;
constexpr int kJobMinutes = 120;  // panoramas of long clips

void ListCommands() {
  for (const Command& command : AllCommands()) {
    const std::string form =
        command.id + std::string(*command.arguments == '\0' ? "" : " ") + command.arguments;
    std::printf("%-24s %s\n", form.c_str(), command.help);
  }
}

}  // namespace

void AddRunJob(CLI::App& program) {
  const auto options = std::make_shared<EditorOptions>();
  const auto shows = std::make_shared<bool>(false);
  const auto script = std::make_shared<std::string>();
  CLI::App* job = program.add_subcommand(
      "run", "Repeat a script of the editor, such as one that File, Record script wrote.");
  const auto files = JobFiles::Of(*job, false);
  const auto lists = std::make_shared<bool>(false);
  CLI::Option* const input =
      files->Input(job->add_option("SCRIPT", *script, "Script, one action per line."));
  files
      ->Input(job->add_option("--scene", options->scene,
                              "Scene folder, scene.json or .arthro archive to begin in. Default: "
                              "the demo scene."),
              kSceneInput)
      ->type_name("SCENE");
  job->add_flag("--show", *shows, "Show the window. Default: it is hidden.");
  job->add_flag("--list", *lists, "List the commands that `do` takes, and do nothing else.");
  AddLookFlags(*job, *options, "A script begins with the usual look, in English.");
  files->Run([options, shows, script, lists, input] {
    if (*lists) return ListCommands();
    if (input->count() == 0) throw CLI::RequiredError("SCRIPT");
    // A mistake in the script is told before there is a window.
    ParseScript(ReadWholeFile(*script), *script);
    std::optional<OwnDisplay> display;
    if (!HasDisplay()) display.emplace(kOwnWidth, kOwnHeight);
    options->script = *script;
    options->hidden = !*shows;
    options->job_minutes = kJobMinutes;
    options->is_unattended = true;
    RunEditor(*options);
  });
}

}  // namespace arthro::app
