// arthroscene tetrahedralize SURFACE --unit mm -o tissue.vtu: a closed surface becomes a volume
// that can be deformed. The hidden job tetgen-worker is the other half: TetGen in a process of its
// own.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/job_progress.h"
#include "app/cli/jobs.h"
#include "app/cli/options_cli.h"
#include "authoring/tissue/tetgen_worker.h"
#include "authoring/tissue/tetrahedralize.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/scene/mesh_io.h"

namespace arthro::app {
namespace {

struct Arguments {
  std::string surface, unit, output, report;
  authoring::TetrahedralizeOptions options;
};

// Before the long part, so that a slip of the pen costs nothing.
void CheckOutput(const Arguments& arguments) {
  const std::filesystem::path output = arguments.output;
  if (output != "-" && output.extension() != ".vtu")
    throw Error(Code::kBadArgument, "a volume is written as VTK's XML format; name it .vtu",
                output);
  if (arguments.output == "-" && arguments.report == "-")
    throw Error(Code::kBadArgument,
                "mesh and report cannot both go to standard output; give one of them a file");
  if (arguments.report != "-" && arguments.report == arguments.output)
    throw Error(Code::kBadArgument, "the report would overwrite the mesh; give it another name",
                output);
}

void RunJob(const Arguments& arguments) {
  CheckOutput(arguments);
  const Progress progress = TerminalProgress();
  const authoring::SurfaceSource source{
      arguments.surface, arguments.unit, *MetresPerUnit(arguments.unit), {}};
  authoring::TetrahedralizeReport report;
  const SurfaceMesh surface =
      ReadSurface(arguments.surface, source.metres_per_unit, &report.reading);
  const TetMesh mesh =
      authoring::Tetrahedralize(surface, source, arguments.options, &report, progress);
  WriteTetMesh(arguments.output, mesh);
  if (!arguments.report.empty())
    WriteAtomically(arguments.report,
                    authoring::ReportJson(report, source, arguments.options).dump(2) + "\n");

  // What was said goes beside the data when that goes to standard output.
  const bool is_piped = arguments.output == "-" || arguments.report == "-";
  for (const std::string& warning : report.warnings) fmt::print(stderr, "warning: {}\n", warning);
  if (const int repairs = report.repairs.Total() + report.reading.degenerate_triangles)
    fmt::print(stderr, "note: the surface needed {} repair{}; --report lists them\n", repairs,
               repairs == 1 ? "" : "s");
  fmt::print(is_piped ? stderr : stdout,
             "{} elements, {} nodes; volume {:.6g} mm3 (off by {:.1g}); dihedral angles {:.1f} to "
             "{:.1f} degrees; longest edge {:.3g} mm\n",
             report.elements, report.nodes, report.quality.volume * 1e9, report.volume_error,
             DegreesFromRadians(report.quality.min_dihedral),
             DegreesFromRadians(report.quality.max_dihedral),
             MmFromMetres(report.quality.longest_edge));
}

}  // namespace

void AddTetrahedralizeJob(CLI::App& program) {
  CLI::App* job = program.add_subcommand(
      "tetrahedralize", "Fill a closed surface with tetrahedra, so that it can be deformed.");
  const auto arguments = std::make_shared<Arguments>();
  job->add_option("SURFACE", arguments->surface, "Closed surface: .stl, .obj, .ply, .off or .vtp")
      ->required();
  job->add_option("--unit", arguments->unit, "Unit of the file, which itself does not say")
      ->required()
      ->check(CLI::IsMember({"m", "cm", "mm", "um", "in"}));
  job->add_option("-o,--output", arguments->output, "Mesh in metres, .vtu; - is standard output")
      ->required();
  job->add_option("--report", arguments->report, "Counts, quality, repairs and times, as JSON");
  AddOptions(*job, arguments->options);
  job->callback([arguments] { RunJob(*arguments); });

  CLI::App* worker = program.add_subcommand("tetgen-worker", "Started by tetrahedralize.");
  worker->group("");  // not in the help
  const auto folder = std::make_shared<std::string>();
  worker->add_option("FOLDER", *folder, "Folder with the job")->required();
  worker->callback([folder] { std::_Exit(authoring::RunTetgenWorker(*folder)); });
}

}  // namespace arthro::app
