// arthroscene relief FOOTAGE --lens lens.json -o relief.tiff: measures the surface from a clip.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/flags/number_flags.h"
#include "app/cli/flags/options_cli.h"
#include "app/cli/flags/pixel_flags.h"
#include "app/cli/input_files.h"
#include "app/cli/job_files.h"
#include "app/cli/job_progress.h"
#include "app/cli/jobs.h"
#include "app/state/footage/measured_backdrop.h"
#include "authoring/panorama/report_io.h"
#include "authoring/project/document_io.h"
#include "authoring/relief/make/make_relief.h"
#include "authoring/relief/relief_io.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/json/lens_io.h"

namespace arthro::app {
namespace {

struct ReliefJob {
  std::string lens, output, sigma, confidence, origin, panorama, scene, poses, report;
  std::vector<double> lengths_mm, instruments_mm;
  std::vector<std::string> between, across;
  bool is_partial = false;
  authoring::ReliefRequest request;
};

authoring::KnownLength LengthOf(double millimetres, const std::string& between) {
  const auto [from, to] =
      PixelsFromWord("--between", between, "takes two pixels of the relief, as x,y:x,y");
  return {MetresFromMm(millimetres), from, to};
}

authoring::KnownInstrument InstrumentOf(double millimetres, const std::string& across) {
  constexpr const char* kForm = "takes a frame and two of its pixels, as frame:x,y:x,y";
  const auto colon = across.find(':');
  if (colon == std::string::npos) throw CLI::ValidationError("--across", kForm);
  const double frame =
      NumberFromWord("--across", std::string_view(across).substr(0, colon), {{0.0, 1e6}, "", true});
  const auto [from, to] = PixelsFromWord("--across", across.substr(colon + 1), kForm);
  return {MetresFromMm(millimetres), static_cast<int>(frame), from, to};
}

// Lengths and the words that place them come in pairs.
void ReadLengths(ReliefJob& job) {
  if (job.lengths_mm.size() != job.between.size())
    throw CLI::ValidationError("--length-mm",
                               "needs one --between each, and --between one --length-mm");
  if (job.instruments_mm.size() != job.across.size())
    throw CLI::ValidationError("--instrument-mm",
                               "needs one --across each, and --across one --instrument-mm");
  for (std::size_t i = 0; i < job.between.size(); ++i)
    job.request.lengths.push_back(LengthOf(job.lengths_mm[i], job.between[i]));
  for (std::size_t i = 0; i < job.across.size(); ++i)
    job.request.instruments.push_back(InstrumentOf(job.instruments_mm[i], job.across[i]));
}

void Run(ReliefJob job) {
  if (!job.panorama.empty()) authoring::CheckPanoramaName(job.panorama);
  if (!job.lens.empty()) job.request.lens = ReadLens(job.lens);
  job.request.draws_panorama = !job.panorama.empty() || !job.scene.empty();
  const Progress progress = TerminalProgress();
  const authoring::ReliefResult result = authoring::MakeRelief(job.request, progress);
  const authoring::ReliefReport& report = result.report;

  // The relief last: where it is, everything else is.
  progress.Step("writing", 0.99);
  const bool is_written = report.verdict.is_measured() || job.is_partial;
  if (!job.report.empty()) WriteAtomically(job.report, authoring::JsonFromReliefReport(report));
  if (is_written && !job.poses.empty())
    WriteAtomically(job.poses, authoring::JsonFromPoses(report));
  if (is_written && !result.relief.empty()) {
    if (!job.sigma.empty()) WriteDepthMap(job.sigma, result.sigma);
    if (!job.confidence.empty()) WriteDepthMap(job.confidence, result.confidence);
    if (!job.origin.empty()) WriteOriginMap(job.origin, result.origin);
    if (!job.panorama.empty()) authoring::WritePanorama(job.panorama, result.picture);
    if (!job.scene.empty()) {
      authoring::Document document =
          DocumentFromRelief(result, job.request.lens, job.request.options.view_angle);
      document.scene.title = std::filesystem::path(job.output).stem().string();
      authoring::SaveDocument(document, job.scene);
    }
    WriteDepthMap(job.output, result.relief);
  }
  progress.Step("done", 1.0);
  for (const std::string& warning : report.warnings)
    fmt::print(stderr, "warning: {}\n", PrintableLine(warning));
  if (!report.verdict.is_measured())
    throw Error(Code::kBadImage,
                fmt::format("no relief was measured ({}: {} {:.2f}, limit {:.2f}): {}",
                            report.verdict.kind, report.verdict.test, report.verdict.value,
                            report.verdict.limit, report.verdict.sentence),
                job.request.footage);
  for (const std::string& file :
       {job.output, job.sigma, job.confidence, job.origin, job.panorama, job.poses, job.report})
    if (file == "-") return;  // standard output holds one of them
  int posed = 0;
  for (const authoring::PosedFrame& frame : report.frames) posed += frame.is_posed;
  fmt::print(
      "{}: {} x {} cells, {} of {} frames posed; {:.0f} % measured, {:.0f} % from brightness, "
      "{:.0f} % interpolated; the sphere's radius is {:.2f} mm, scale {}\n",
      job.output, result.relief.width, result.relief.height, posed, report.frames.size(),
      100 * report.measured_share, 100 * report.brightness_share, 100 * report.interpolated_share,
      MmFromMetres(report.radius), report.scale_source);
}

}  // namespace

void AddReliefJob(CLI::App& program) {
  CLI::App* job = program.add_subcommand(
      "relief", "Measure the relief of the tissue from the motion of the scope in a clip.");
  const auto own = std::make_shared<ReliefJob>();
  const auto files = JobFiles::Of(*job);
  files
      ->Input(job->add_option("FOOTAGE", own->request.footage,
                              "A video, a folder of pictures, or a pattern such as "
                              "frames/%04d.png."),
              kFootageInput)
      ->required();
  files->Input(job->add_option("--lens", own->lens,
                               "Lens file of `arthroscene lens`; without it the focal length is "
                               "found from the clip, less exactly."));
  files
      ->Output(job->add_option("-o,--output", own->output,
                               "32-bit float TIFF in metres over directions from the portal, NaN "
                               "at unobserved directions; - for standard output."),
               kDepthMapFile)
      ->required();
  files->Output(job->add_option("--sigma", own->sigma,
                                "32-bit float TIFF in metres: standard error of each cell."),
                kDepthMapFile);
  files->Output(job->add_option("--confidence", own->confidence,
                                "32-bit float TIFF: probability that a cell is within 1 mm."),
                kDepthMapFile);
  files->Output(job->add_option("--origin", own->origin,
                                "8-bit PNG: 0 not seen, 1 measured, 2 from brightness, 3 "
                                "interpolated."),
                kPictureFile);
  files->Output(job->add_option("--panorama", own->panorama,
                                "Panorama over the relief: PNG with what was seen as alpha, or "
                                "JPEG."),
                kPictureFile);
  files->OutputScene(job->add_option("--scene", own->scene,
                                     "Also write a scene with panorama and relief into this "
                                     "folder."),
                     SceneFile);
  files->Output(job->add_option("--poses", own->poses, "JSON: camera poses in the portal frame."),
                {"camera poses", FileForm::kJson, "arthroscene.poses/"});
  files->Output(
      job->add_option("--report", own->report,
                      "JSON: pose of each frame or why it has none, portal, scale, coverage."),
      {"a report", FileForm::kJson, "arthroscene.relief/"});
  AddNumbers(*job, "--length-mm", own->lengths_mm, {0.01, 1000.0}, "mm",
             "Known distance between the two pixels of --between; may be given more than once.")
      ->allow_extra_args(false);
  job->add_option("--between", own->between,
                  "Two pixels of the relief whose distance is --length-mm.")
      ->type_name("X,Y:X,Y")
      ->allow_extra_args(false);
  AddNumbers(*job, "--instrument-mm", own->instruments_mm, {0.1, 50.0}, "mm",
             "Diameter of an instrument that touches the tissue; may be given more than once.")
      ->allow_extra_args(false);
  job->add_option("--across", own->across,
                  "A frame, counted from 0, and a pixel on each edge of the instrument.")
      ->type_name("FRAME:X,Y:X,Y")
      ->allow_extra_args(false);
  job->add_flag("--partial", own->is_partial,
                "Write what was measured even where the clip does not determine the relief.");
  AddOptions(*job, own->request.options);
  files->Run([own] {
    ReadLengths(*own);
    Run(*own);
  });
}

}  // namespace arthro::app
