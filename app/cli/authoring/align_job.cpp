// arthroscene align SCENE --tissue NAME --pairs pairs.json -o ALIGNED: lays a tissue where pairs of
// landmarks put it, and its surface onto the relief.
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/flags/ball_flag.h"
#include "app/cli/flags/options_cli.h"
#include "app/cli/input_files.h"
#include "app/cli/job_files.h"
#include "app/cli/jobs.h"
#include "app/cli/output_check.h"
#include "authoring/alignment/align_report.h"
#include "authoring/alignment/landmark_file.h"
#include "authoring/alignment/surface_alignment.h"
#include "authoring/project/document_io.h"
#include "authoring/project/estimated_depth.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/scene/files/scene_io.h"

namespace arthro::app {
namespace {

struct AlignJob {
  std::string scene, tissue, pairs, output, report;
  bool takes_surface = false;
  std::optional<Ball> patch;
  authoring::LandmarkOptions options;
  authoring::SurfaceAlignOptions surface_options;
};

std::size_t IndexOf(const Scene& scene, const std::string& name,
                    const std::filesystem::path& file) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < scene.tissues.size(); ++i) {
    if (scene.tissues[i].name == name) return i;
    names.push_back("\"" + scene.tissues[i].name + "\"");
  }
  throw Error(Code::kBadArgument,
              names.empty() ? "this scene has no tissue; import one first"
                            : fmt::format("there is no tissue \"{}\"; this scene has {}", name,
                                          fmt::join(names, ", ")),
              file);
}

void PrintPair(FILE* stream, const authoring::LandmarkPair& pair,
               const authoring::LandmarkResidual& residual, std::size_t number) {
  fmt::print(stream, "{} {}: {:.2f} mm", number, pair.name.empty() ? "unnamed" : pair.name,
             MmFromMetres(residual.distance));
  if (residual.px) fmt::print(stream, ", {:.1f} px", *residual.px);
  fmt::print(stream, "{}\n", residual.is_used ? "" : ", left out");
}

authoring::LandmarkAlignment ByPairs(const AlignJob& job, const authoring::Document& document,
                                     std::size_t index,
                                     const std::vector<authoring::LandmarkPair>& pairs) {
  authoring::LandmarkAlignment alignment = authoring::AlignLandmarks(
      pairs, document.scene.tissues[index].pose, OrEmpty(document.surfaces[index]), job.options);
  for (const std::string& warning : alignment.warnings)
    fmt::print(stderr, "warning: {}\n", PrintableLine(warning));
  return alignment;
}

void Run(const AlignJob& job) {
  if (job.pairs.empty() && !job.takes_surface)
    throw Error(Code::kBadArgument, "nothing to align by; give --pairs, --surface or both");
  // The scene that is read stays as it is.
  CheckOutputs({SceneFile(job.output)}, FilesOfScene(job.scene));
  authoring::Document document = authoring::OpenDocument(job.scene);
  const std::size_t index = IndexOf(document.scene, job.tissue, job.scene);
  Tissue& tissue = document.scene.tissues[index];

  std::vector<authoring::LandmarkPair> pairs;
  std::optional<authoring::LandmarkAlignment> landmarks;
  std::optional<authoring::SurfaceAlignment> surface;
  if (!job.pairs.empty()) {
    pairs = authoring::PairsInScene(authoring::ReadPairs(job.pairs), document,
                                    authoring::UnstatedOrigin(document), job.pairs);
    landmarks = ByPairs(job, document, index, pairs);
    if (landmarks->is_aligned()) tissue.pose = landmarks->portal_from_tissue;
  }
  if (job.takes_surface && (!landmarks || landmarks->is_aligned()))
    surface = authoring::AlignSurface(authoring::MakeReliefTarget(document),
                                      OrEmpty(document.surfaces[index]), tissue.pose, job.patch,
                                      job.surface_options);
  if (!job.report.empty())
    WriteAtomically(job.report, authoring::AlignReportText(job.tissue, pairs, landmarks, surface));
  if (landmarks && !landmarks->is_aligned())
    throw Error(Code::kBadData, landmarks->sentence, job.pairs);
  if (surface && !surface->is_aligned) throw Error(Code::kBadData, surface->sentence, job.scene);
  if (surface) tissue.pose = surface->portal_from_tissue;
  authoring::SaveDocument(document, job.output);

  FILE* const stream = job.report == "-" ? stderr : stdout;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    PrintPair(stream, pairs[i], landmarks->residuals[i], i + 1);
  if (landmarks)
    fmt::print(stream,
               "{}: {} aligned to {:.2f} mm rms; its middle is known to {:.2f} mm, its rotation to "
               "{:.1f} degrees; scale {:.3f}; {} candidates, {} iterations\n",
               job.output, job.tissue, MmFromMetres(landmarks->rms),
               MmFromMetres(landmarks->position_sigma),
               DegreesFromRadians(landmarks->rotation_sigma), tissue.pose.scale,
               landmarks->candidates, landmarks->iterations);
  if (surface)
    fmt::print(stream, "{}: {} laid onto the relief in {} steps. {}\n", job.output, job.tissue,
               surface->steps, surface->sentence);
}

}  // namespace

void AddAlignJob(CLI::App& program) {
  CLI::App* job = program.add_subcommand(
      "align", "Lay a tissue where pairs of landmarks put it, or its surface onto the relief.");
  const auto own = std::make_shared<AlignJob>();
  const auto files = JobFiles::Of(*job);
  files
      ->Input(job->add_option("SCENE", own->scene,
                              "Folder of the scene, its scene.json, or an .arthro archive."),
              kSceneInput)
      ->required();
  job->add_option("--tissue", own->tissue, "Name of the tissue in the scene.")
      ->required()
      ->type_name("NAME");
  files->Input(job->add_option("--pairs", own->pairs,
                               "JSON: points of the model and their partners in the panorama, in a "
                               "picture of the scope, or in the portal frame."));
  job->add_flag("--surface", own->takes_surface,
                "Lay the surface onto the relief, after the pairs where both are given.");
  job->add_option_function<std::string>(
         "--patch",
         [own](const std::string& words) { own->patch = BallFromWords("--patch", words); },
         "Ball in the tissue's own frame, mm, whose part of the surface lies on the relief; the "
         "side that faces the portal if not given.")
      ->type_name("X,Y,Z,R");
  files
      ->OutputScene(job->add_option("-o,--output", own->output,
                                    "Scene to write: a folder, or an .arthro archive."),
                    SceneFile)
      ->required();
  files->Output(job->add_option("--report", own->report,
                                "JSON: pose, its standard error, and the residual of each pair; - "
                                "for standard output."),
                {"a report", FileForm::kJson, "arthroscene.align/"});
  AddOptions(*job, own->options, own->surface_options);
  files->Run([own] { Run(*own); });
}

}  // namespace arthro::app
