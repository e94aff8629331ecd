// arthroscene phantom --seed N -o DIR: a digital knee with its ground truth, as a scene.
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/flags/options_cli.h"
#include "app/cli/job_files.h"
#include "app/cli/job_progress.h"
#include "app/cli/jobs.h"
#include "authoring/phantom/clip/phantom_footage.h"
#include "authoring/phantom/phantom_io.h"

namespace arthro::app {

void AddPhantomJob(CLI::App& program) {
  struct Request {
    authoring::PhantomOptions options;
    authoring::PhantomFootageOptions footage;
    std::string folder;
  };
  CLI::App* job = program.add_subcommand(
      "phantom", "Make a digital knee whose shape and tissue poses are known exactly.");
  const auto request = std::make_shared<Request>();
  AddOptions(*job, request->options, request->footage);
  const auto files = JobFiles::Of(*job, false);
  files
      ->OutputFolder(
          job->add_option("-o,--output", request->folder,
                          "Folder to write; new, empty, or an earlier phantom, which is replaced."))
      ->required();
  files->Run([request] {
    authoring::RequirePhantomFolder(request->folder);
    const Progress progress = TerminalProgress();
    const authoring::Phantom phantom = authoring::MakePhantom(request->options, progress);
    authoring::WritePhantomWithFootage(request->folder, phantom, request->footage, progress);
  });
}

}  // namespace arthro::app
