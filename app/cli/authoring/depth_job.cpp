// arthroscene depth PANORAMA -o depth.tiff: relief from brightness [paper, 3.4].
#include <cstdio>
#include <memory>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/flags/number_flags.h"
#include "app/cli/flags/options_cli.h"
#include "app/cli/job_files.h"
#include "app/cli/job_progress.h"
#include "app/cli/jobs.h"
#include "authoring/depth/depth_filter.h"
#include "authoring/depth/depth_import.h"
#include "authoring/depth/noise/depth_noise.h"
#include "authoring/depth/strokes/depth_strokes_io.h"
#include "authoring/depth/strokes/mend_depth.h"
#include "authoring/project/document_io.h"
#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/core/units.h"
#include "simulation/scene/image_io.h"

namespace arthro::app {
namespace {

struct DepthJob {
  std::string panorama, output, noise, strokes, import;
  double backdrop_mm = 50;
  authoring::DepthOptions options;
  authoring::DepthImportOptions numbers;
};

// The depth map of another program in place of the estimate.
DepthMap Imported(const DepthJob& job, const ColourImage& panorama) {
  return authoring::ReliefFromNumbers(authoring::ReadGreyNumbers(job.import), job.numbers,
                                      MetresFromMm(job.backdrop_mm), panorama.width,
                                      panorama.height, job.import);
}

// Mends the map by the strokes, as the editor would. Masks of an imported map are closed from their
// surround; an estimate has been made around them.
void Mend(const DepthJob& job, const authoring::DepthStrokes& strokes, const ColourImage& panorama,
          DepthMap& depth, DepthMap& sigma) {
  const Projection projection = authoring::GuessProjection(panorama.width, panorama.height);
  const authoring::MendedScene scene{panorama, projection, MetresFromMm(job.backdrop_mm)};
  authoring::MendedDepth mended{std::move(depth), std::move(sigma), {}};
  if (job.import.empty())
    authoring::ReplayStrokes(strokes, scene, mended);
  else
    for (const authoring::DepthStroke& stroke : strokes)
      authoring::ApplyStroke(stroke, scene, mended);
  depth = std::move(mended.relief);
  sigma = std::move(mended.sigma);
}

void Run(const DepthJob& job) {
  authoring::CheckDepthOptions(job.options);
  const ColourImage panorama = ReadColourImage(job.panorama);
  const authoring::DepthStrokes strokes =
      job.strokes.empty()
          ? authoring::DepthStrokes()
          : authoring::StrokesFromText(ReadWholeFile(job.strokes, kMostJsonBytes), job.strokes);
  if (!job.import.empty()) {
    DepthMap depth = Imported(job, panorama), sigma;
    Mend(job, strokes, panorama, depth, sigma);
    WriteDepthMap(job.output, depth);
    if (job.output != "-")
      fmt::print("{}: {} x {} px from {}, {} strokes\n", job.output, depth.width, depth.height,
                 job.import, strokes.size());
    return;
  }
  authoring::DepthReport report;
  DepthMap depth =
      authoring::DepthFromColour(panorama, job.options, &report, TerminalProgress(),
                                 authoring::MarksOf(strokes, panorama.width, panorama.height));
  if (report.imaged_share == 0.0)
    throw Error(Code::kBadImage,
                "this picture is nothing but dark surround; lower --surround-threshold or take "
                "another picture",
                job.panorama);
  DepthMap sigma =
      job.noise.empty() ? DepthMap() : authoring::NoiseOfDepth(depth, job.options.texture_size);
  if (!job.noise.empty() && sigma.empty())
    throw Error(Code::kBadImage,
                job.options.texture_size == 0
                    ? "no noise is stated with --texture-size 0; raise it, or leave out --noise"
                    : "the relief has no structure finer than --texture-size, so it states no "
                      "noise; leave out --noise",
                job.panorama);
  Mend(job, strokes, panorama, depth, sigma);
  if (!sigma.empty()) WriteDepthMap(job.noise, sigma);
  WriteDepthMap(job.output, depth);
  const auto warn = [&](const char* sentence) {
    fmt::print(stderr, "warning: {}: {}\n", job.panorama, sentence);
  };
  if (report.is_flat) warn("it has one grey throughout, so all of it lies at the far relief");
  if (report.is_overexposed)
    warn("too much of it is saturated to be glints; it was taken as near tissue");
  if (job.output == "-") return;  // standard output holds the picture
  const std::string what =
      job.options.estimator == authoring::DepthEstimator::kPaper
          ? fmt::format("greys {:.1f} to {:.1f}", report.low_grey, report.high_grey)
          : fmt::format("relative distances {:.2f} to 1", report.distance_ratio);
  fmt::print("{}: {} x {} px, {:.1f} % imaged, {:.2f} % of it glints, {} became {:g} to {:g} mm\n",
             job.output, depth.width, depth.height, 100.0 * report.imaged_share,
             100.0 * report.highlight_share, what, MmFromMetres(job.options.far_relief),
             MmFromMetres(job.options.near_relief));
}

}  // namespace

void AddDepthJob(CLI::App& program) {
  CLI::App* job = program.add_subcommand(
      "depth", "Estimate the relief of a panorama from its brightness: bright is near.");
  const auto own = std::make_shared<DepthJob>();
  const auto files = JobFiles::Of(*job);
  files->Input(job->add_option("PANORAMA", own->panorama, "Panorama: PNG, JPEG or TIFF."))
      ->required();
  files
      ->Output(job->add_option("-o,--output", own->output,
                               "Depth map to write: 32-bit float TIFF of the same size, in metres; "
                               "- is standard output."),
               kDepthMapFile)
      ->required();
  files->Output(job->add_option("--noise", own->noise,
                                "Also write the noise of the depths, in metres, for "
                                "backdrop.depth_sigma of a scene."),
                kDepthMapFile);
  files->Input(job->add_option("--strokes", own->strokes,
                               "Mend the map by these strokes: a JSON file with \"schema\": "
                               "\"arthroscene.depth-strokes/1\"."));
  CLI::Option* import = files->Input(
      job->add_option("--import", own->import,
                      "Take the depth from this grey picture instead: PNG or TIFF of 8 or 16 bits, "
                      "TIFF or EXR of floating point."));
  import->excludes("--noise");
  AddNumber(*job, "--backdrop-mm", own->backdrop_mm, {1, 2000}, "mm",
            "Distance of the backdrop from the portal, for --import and for strokes that flatten.");
  AddOptions(*job, own->options, own->numbers);
  files->Run([own] { Run(*own); });
}

}  // namespace arthro::app
