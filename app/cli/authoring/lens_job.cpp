// arthroscene lens GRID_IMAGE... --spacing-mm S -o lens.json [method.md, Command line].
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/flags/number_flags.h"
#include "app/cli/flags/options_cli.h"
#include "app/cli/job_files.h"
#include "app/cli/job_progress.h"
#include "app/cli/jobs.h"
#include "authoring/lens/calibration_report.h"
#include "authoring/lens/grid/lens_from_pictures.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/scene/json/lens_io.h"

namespace arthro::app {
namespace {

struct LensJob {
  std::vector<std::string> pictures;
  std::string output, report;
  double spacing_mm = 0;
  authoring::DetectOptions detect;
  authoring::CalibrateOptions calibrate;
};

void Run(const LensJob& job) {
  CheckOptions(job.detect);
  CheckOptions(job.calibrate);
  const authoring::PicturesLens found = authoring::LensFromPictures(
      std::vector<std::filesystem::path>(job.pictures.begin(), job.pictures.end()),
      MetresFromMm(job.spacing_mm), job.detect, job.calibrate, TerminalProgress());
  const authoring::LensCalibration& calibration = found.calibration;
  const std::string table = authoring::TableOf(calibration, job.pictures);
  std::fputs(table.c_str(), job.output == "-" || job.report == "-" ? stderr : stdout);
  if (!job.report.empty())
    WriteAtomically(job.report, authoring::JsonOf(calibration, job.pictures));
  if (!found.refusal.empty())
    throw Error(Code::kBadImage, "no lens was written: " + found.refusal,
                job.pictures.size() == 1 ? job.pictures.front() : std::string());
  WriteLens(job.output, calibration.lens);
  if (calibration.verdict == authoring::LensVerdict::kDoubtful)
    for (const std::string& sentence : calibration.sentences)
      fmt::print(stderr, "warning: {}\n", PrintableLine(sentence));
}

}  // namespace

void AddLensJob(CLI::App& program) {
  CLI::App* job = program.add_subcommand(
      "lens", "Calibrate the scope's lens from pictures of a line grid, chessboard or dot grid.");
  const auto own = std::make_shared<LensJob>();
  const auto files = JobFiles::Of(*job);
  files
      ->Input(job->add_option("GRID_IMAGE", own->pictures,
                              "Raw pictures of the flat target. Six are best: tilted to all sides, "
                              "and filling the window."))
      ->required();
  AddNumberOption(*job, "--spacing-mm", {{1e-3, 1e4}, "mm"},
                  "Distance from line to line, corner to corner or dot to dot.",
                  [own](double spacing) { own->spacing_mm = spacing; })
      ->required();
  files
      ->Output(
          job->add_option("-o,--output", own->output, "lens.json to write; - is standard output."),
          {"a lens file", FileForm::kJson, "arthroscene.lens/"})
      ->required();
  files->Output(
      job->add_option("--report", own->report,
                      "Report as JSON, also when the lens is refused; - is standard output."),
      {"a report", FileForm::kJson, "arthroscene.lens_report/"});
  AddOptions(*job, own->calibrate, own->detect);
  job->footer(
      "The table gives each model's residual, on the points and on pictures held out of the fit, "
      "and "
      "an estimate of the error at the rim. The verdict is good, doubtful (written, with the "
      "reason) "
      "or refused (nothing written, exit code 1).");
  files->Run([own] { Run(*own); });
}

}  // namespace arthro::app
