// arthroscene pivot POSES.csv -o pivot.json [method.md, Command line]: where the incision lies in a
// device's frame, from presses or, with --swing, from a recorded hand that kept swinging.
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/cli/flags/number_flags.h"
#include "app/cli/flags/options_cli.h"
#include "app/cli/job_files.h"
#include "app/cli/jobs.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/device/trace_io.h"
#include "simulation/scope/pivot_calibration.h"
#include "simulation/scope/pivot_io.h"
#include "simulation/scope/pivot_swing.h"

namespace arthro::app {
namespace {

struct PivotArguments {
  std::filesystem::path poses, output;
  std::string swing;  // role of a trace's hand; empty: poses is a table of presses
  double rod_length_mm = 200.0;
  simulation::PivotOptions options;
};

std::vector<simulation::PivotPress> SwingOf(const PivotArguments& arguments) {
  simulation::PivotSwing swing(MetresFromMm(arguments.rod_length_mm));
  for (const simulation::TraceRow& row : simulation::ReadTrace(arguments.poses))
    if (simulation::ToString(row.device) == arguments.swing)
      swing.Add(row.sample.hip_in_device, row.sample.handle_in_device);
  return {swing.presses().begin(), swing.presses().end()};
}

void RunPivotJob(const PivotArguments& arguments) {
  CheckOptions(arguments.options);
  const auto presses =
      arguments.swing.empty() ? simulation::ReadPresses(arguments.poses) : SwingOf(arguments);
  const auto calibration =
      simulation::CalibratePivot(presses, arguments.options,
                                 arguments.swing.empty() ? simulation::PivotSource::kPresses
                                                         : simulation::PivotSource::kSwing);
  WriteAtomically(arguments.output, simulation::JsonFromPivot(calibration));
  // The record is kept in either case; a pivot that should not be used ends the job with its
  // reason.
  if (calibration.status != simulation::PivotStatus::kOk)
    throw Error(Code::kBadData,
                std::string(simulation::ToString(calibration.status)) + ": " + calibration.reason,
                arguments.poses);
}

}  // namespace

void AddPivotJob(CLI::App& program) {
  auto arguments = std::make_shared<PivotArguments>();
  CLI::App* job = program.add_subcommand(
      "pivot", "Find the incision in a device's frame from presses at several handle positions.");
  const auto files = JobFiles::Of(*job);
  files
      ->Input(job->add_option("POSES", arguments->poses,
                              "Table with the header hip_x,hip_y,hip_z,tip_x,tip_y,tip_z, in "
                              "metres; one press per row."))
      ->required();
  files
      ->Output(job->add_option("-o,--output", arguments->output,
                               "pivot.json to write; - is standard output."),
               {"a pivot", FileForm::kJson, "arthroscene.pivot/"})
      ->required();
  job->add_option("--swing", arguments->swing,
                  "Read POSES as a TRACE.csv in which this hand swings its rod through the "
                  "incision. One pose per millimetre is used; slips are left out.")
      ->check(CLI::IsMember({"scope", "instrument"}));
  AddNumber(*job, "--rod-length-mm", arguments->rod_length_mm, {10.0, 1000.0}, "mm",
            "Length of the rod from hand to tip; with --swing.");
  AddOptions(*job, arguments->options);
  job->footer(
      "status is ok, too_few, too_narrow, inconsistent or outside_rod; all but ok end with exit "
      "code "
      "1, and pivot.json says why. pivot is null where no number can be trusted (too_few, "
      "too_narrow). sigma is the predicted rms error in metres. Swing the rod by 30 degrees or "
      "more; "
      "the paper's two presses will do where the rig's noise is as stated, more presses show it.");
  files->Run([arguments] { RunPivotJob(*arguments); });
}

}  // namespace arthro::app
