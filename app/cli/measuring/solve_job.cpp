// arthroscene solve CASE.json -o result.json [method.md, Command line]: a deformable body's
// equilibrium or its motion, on its own.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/job_files.h"
#include "app/cli/job_progress.h"
#include "app/cli/jobs.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "simulation/tissue/cases/case_io.h"
#include "simulation/tissue/cases/case_run.h"

namespace arthro::app {
namespace {

struct SolveArguments {
  std::filesystem::path tissue_case;
  std::string output, vtu;
};

// Before the long part, so that a slip of the pen costs nothing.
void CheckOutput(const SolveArguments& arguments) {
  if (!arguments.vtu.empty() && arguments.vtu != "-" &&
      std::filesystem::path(arguments.vtu).extension() != ".vtu")
    throw Error(Code::kBadArgument, "a volume is written as VTK's XML format; name it .vtu",
                arguments.vtu);
  if (arguments.vtu == "-" && arguments.output == "-")
    throw Error(Code::kBadArgument,
                "result and mesh cannot both go to standard output; give one of them a file");
}

void RunSolveJob(const SolveArguments& arguments, const JobFiles& files) {
  CheckOutput(arguments);
  const Progress progress = TerminalProgress();
  simulation::TissueCase tissue_case = simulation::ReadCase(arguments.tissue_case);
  files.RefuseToOverwrite({tissue_case.mesh_file});
  for (const std::string& message : tissue_case.messages)
    fmt::print(stderr, "note: {}\n", PrintableLine(message));
  const simulation::CaseResult result = simulation::RunCase(tissue_case, progress);
  WriteAtomically(arguments.output, simulation::JsonFromResult(result));
  if (!arguments.vtu.empty()) {
    tissue_case.mesh.rest_positions = result.x;
    WriteTetMesh(arguments.vtu, tissue_case.mesh);
  }
  // The record is kept in either case, so that what was reached can be looked at.
  if (result.inverted_elements > 0)
    throw Error(Code::kBadData,
                fmt::format("{} of {} elements are turned inside out, so the result is not a "
                            "possible shape; reduce the loads and displacements, or "
                            "refine the mesh where it is pressed",
                            result.inverted_elements, tissue_case.mesh.ElementCount()),
                arguments.tissue_case);
  if (!result.converged)
    throw Error(Code::kBadData,
                fmt::format("did not converge: the residual is {:.2g}, asked was {:.2g}; load it "
                            "less, or refine the mesh where it is pressed",
                            result.residual, tissue_case.tolerance),
                arguments.tissue_case);
}

}  // namespace

void AddSolveJob(CLI::App& program) {
  const auto arguments = std::make_shared<SolveArguments>();
  CLI::App* job = program.add_subcommand(
      "solve", "Deform a body of tetrahedra: its equilibrium, or its motion, under given loads.");
  const auto files = JobFiles::Of(*job);
  files
      ->Input(job->add_option("CASE", arguments->tissue_case,
                              "CASE.json: mesh, material, supports, displacements and loads."))
      ->required();
  files
      ->Output(job->add_option("-o,--output", arguments->output,
                               "result.json to write; - is standard output."),
               {"a result", FileForm::kJson, "arthroscene.solve/"})
      ->required();
  files->Output(
      job->add_option("--vtu", arguments->vtu, "Deformed mesh to write, .vtu, in metres."),
      kVolumeFile);
  job->footer(
      "CASE.json, in SI units:\n"
      "  {\"mesh\": \"x.vtu\", \"order\": 1|2,\n"
      "   \"material\": {\"model\": \"corotated\"|\"stable_neo_hookean\", \"young_modulus\": E,\n"
      "     \"poisson_ratio\": nu, \"density\": rho, \"fibre_stiffness\": k, \"fibre_axis\": "
      "\"circumferential_z\"},\n"
      "   \"fixed\": [{\"set\": NAME, \"axes\": \"xyz\"}], \"displaced\": [{\"set\": NAME, "
      "\"displacement\": [x, y, z]}],\n"
      "   \"loads\": [{\"set\": NAME, \"total_force\": [x, y, z]}], \"body_force\": [x, y, z],\n"
      "   \"mode\": \"static\"|\"dynamic\", \"dt\": s, \"steps\": N, \"tolerance\": 1e-8}\n"
      "A set is a 0/1 point array of the mesh. Loads and displacements of a dynamic case are there "
      "from\n"
      "the first step on; it is implicit Euler, which damps: a mode of angular frequency w loses "
      "the factor\n"
      "1/sqrt(1 + (w dt)^2) a step. A result that does not converge to the tolerance, or that has "
      "elements\n"
      "inside out, is written with \"converged\": false and ends with exit code 1.");
  files->Run([arguments, files] { RunSolveJob(*arguments, *files); });
}

}  // namespace arthro::app
