// arthroscene tetrahedralize SURFACE --unit mm -o tissue.vtu: a closed surface becomes a volume
// that can be deformed. The hidden job tetgen-worker is the other half: TetGen in a process of its
// own.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/flags/ball_flag.h"
#include "app/cli/flags/number_flags.h"
#include "app/cli/flags/options_cli.h"
#include "app/cli/job_files.h"
#include "app/cli/job_progress.h"
#include "app/cli/jobs.h"
#include "authoring/tissue/tetrahedra/mesh_budget.h"
#include "authoring/tissue/tetrahedra/tetgen_worker.h"
#include "authoring/tissue/tetrahedra/tetrahedralize.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/scene/mesh/mesh_io.h"

namespace arthro::app {
namespace {

struct MeshArguments {
  std::string surface, unit, output, report, budget;
  int elements = 0;  // 0: no budget, as many as the options ask for
  std::vector<Ball> held;
  authoring::TetrahedralizeOptions options;
};

CLI::Option* AddBalls(CLI::App& job, const std::string& flag, std::vector<Ball>& balls,
                      const std::string& help) {
  return job
      .add_option_function<std::vector<std::string>>(
          flag,
          [flag, &balls](const std::vector<std::string>& all) {
            for (const std::string& words : all) balls.push_back(BallFromWords(flag, words));
          },
          help)
      ->type_name("X,Y,Z,R")
      ->expected(1)
      ->take_all();
}

// Before the long part, so that a slip of the pen costs nothing.
void CheckOutput(const MeshArguments& arguments) {
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

TetMesh Fill(const MeshArguments& arguments, const SurfaceMesh& surface,
             const authoring::SurfaceSource& source, authoring::TetrahedralizeReport& report,
             const Progress& progress) {
  const authoring::TetrahedralizeOptions& options = arguments.options;
  if (arguments.elements == 0)
    return authoring::Tetrahedralize(surface, source, options, &report, progress);
  authoring::MeshWish wish;
  wish.elements = arguments.elements;
  wish.fixed = arguments.held;
  wish.probed = options.fine_at;
  wish.time_limit = options.time_limit;
  wish.begun = options.begun;
  wish.memory_limit = options.memory_limit;
  return authoring::TetrahedralizeToBudget(surface, source, wish, &report, progress);
}

void RunJob(MeshArguments arguments) {
  arguments.options.begun = std::chrono::steady_clock::now();
  CheckOutput(arguments);
  const Progress progress = TerminalProgress();
  const authoring::SurfaceSource source{
      arguments.surface, arguments.unit, *MetresPerUnit(arguments.unit), {}};
  authoring::TetrahedralizeReport report;
  const SurfaceMesh surface =
      ReadSurface(arguments.surface, source.metres_per_unit, &report.reading);
  const TetMesh mesh = Fill(arguments, surface, source, report, progress);
  WriteTetMesh(arguments.output, mesh);
  if (!arguments.report.empty())
    WriteAtomically(arguments.report, authoring::ReportText(report, source, arguments.options));

  // Messages go to standard error when the data goes to standard output.
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

// Sizes by their count of elements: curved ones on a coarser surface. What that decides itself
// cannot be asked for beside it.
void AddBudget(CLI::App& job, MeshArguments& arguments) {
  constexpr const char* kGroup = "Budget";
  std::vector<std::string> names;
  std::string help =
      "About so many quadratic elements, for a tissue that is deformed at display "
      "rate:";
  for (const authoring::MeshBudget& budget : authoring::MeshBudgets()) {
    names.push_back(budget.name);
    help += fmt::format(" {}, {};", budget.name, budget.elements);
  }
  help.back() = '.';
  CLI::Option* budget = job.add_option_function<std::string>(
                               "--budget",
                               [&arguments](const std::string& name) {
                                 for (const authoring::MeshBudget& b : authoring::MeshBudgets())
                                   if (b.name == name) arguments.elements = b.elements;
                               },
                               help)
                            ->check(CLI::IsMember(names))
                            ->group(kGroup);
  CLI::Option* elements =
      AddNumberOption(job, "--elements",
                      {{authoring::kFewestElements, authoring::kMostBudgetElements}, "", true},
                      "Number of quadratic elements.",
                      [&arguments](double count) { arguments.elements = static_cast<int>(count); })
          ->group(kGroup);
  elements->excludes(budget);
  AddBalls(job, "--held-at", arguments.held,
           "Ball where the tissue will be held, in the surface's own frame, mm; may be repeated. A "
           "mesh to a budget is coarser there.")
      ->group(kGroup);
  for (CLI::Option* size : {budget, elements})
    for (const char* other :
         {"--order", "--max-edge-mm", "--fine-edge-mm", "--min-dihedral-deg", "--radius-edge",
          "--keep-surface", "--thickness-mm", "--max-triangles", "--fill-holes", "--drop-below"})
      size->excludes(job.get_option(other));
}

}  // namespace

void AddTetrahedralizeJob(CLI::App& program) {
  CLI::App* job = program.add_subcommand(
      "tetrahedralize", "Fill a closed surface with tetrahedra, so that it can be deformed.");
  const auto arguments = std::make_shared<MeshArguments>();
  const auto files = JobFiles::Of(*job);
  files
      ->Input(job->add_option("SURFACE", arguments->surface,
                              "Closed surface: .stl, .obj, .ply, .off or .vtp."))
      ->required();
  job->add_option("--unit", arguments->unit, "Unit of length in the file.")
      ->required()
      ->check(CLI::IsMember({"m", "cm", "mm", "um", "in"}));
  files
      ->Output(job->add_option("-o,--output", arguments->output,
                               "Mesh to write, .vtu, in metres; - is standard output."),
               kVolumeFile)
      ->required();
  files->Output(job->add_option("--report", arguments->report,
                                "Report as JSON: counts, quality, repairs and times."),
                {"a report", FileForm::kJson, "arthroscene.tetrahedralize/"});
  AddOptions(*job, arguments->options);
  AddBalls(*job, "--fine-at", arguments->options.fine_at,
           "Ball where the mesh is finer, in the surface's own frame, mm; may be repeated. The "
           "edge length there is --fine-edge-mm or follows from the budget.")
      ->group("Options");
  AddBudget(*job, *arguments);
  files->Run([arguments] { RunJob(*arguments); });

  CLI::App* worker = program.add_subcommand("tetgen-worker", "Started by tetrahedralize.");
  worker->group("");  // not in the help
  const auto folder = std::make_shared<std::string>();
  worker->add_option("FOLDER", *folder, "Folder with the job.")->required();
  worker->callback([folder] { std::_Exit(authoring::RunTetgenWorker(*folder)); });
}

}  // namespace arthro::app
