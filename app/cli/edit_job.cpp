// edit and practise: the jobs that open a window.
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "app/cli/jobs.h"
#include "app/editor/editor.h"

namespace arthro::app {
namespace {

// For tests and fault reports; not in the help.
void AddWindowFlags(CLI::App& job, EditorOptions& options) {
  constexpr const char* kHidden = "";  // an empty group is not listed
  job.add_option("--script", options.script, "Text script that drives the window")->group(kHidden);
  job.add_option_function<std::string>(
         "--size",
         [&options](const std::string& size) {
           if (std::sscanf(size.c_str(), "%dx%d", &options.width, &options.height) != 2 ||
               options.width < 1 || options.height < 1)
             throw CLI::ValidationError("--size", "write it as 1280x800");
         },
         "Size of the window, such as 1280x800")
      ->group(kHidden);
  job.add_option("--scale", options.scale, "Content scale instead of the screen's")
      ->check(CLI::Range(1.0, 4.0))
      ->group(kHidden);
  job.add_option("--frames", options.frames, "Quit after so many frames")->group(kHidden);
  job.add_flag("--hidden", options.hidden, "Never show the window")->group(kHidden);
  job.add_flag("--timing", options.timing, "Say when the first picture stood")->group(kHidden);
}

}  // namespace

void AddEditJob(CLI::App& program) {
  const auto options = std::make_shared<EditorOptions>();
  CLI::App* job = program.add_subcommand("edit", "Open the editor");
  job->add_option("scene", options->scene,
                  "Scene folder or scene.json; without one, the demo scene")
      ->type_name("SCENE");
  AddWindowFlags(*job, *options);
  job->callback([options] { RunEditor(*options); });
}

void AddPractiseJob(CLI::App& program) {
  const auto options = std::make_shared<EditorOptions>();
  options->practice = true;
  CLI::App* job = program.add_subcommand("practise", "Practise in a scene");
  job->alias("practice");
  job->add_option("scene", options->scene, "Scene folder or scene.json")
      ->type_name("SCENE")
      ->required();
  AddWindowFlags(*job, *options);
  job->callback([options] { RunEditor(*options); });
}

}  // namespace arthro::app
