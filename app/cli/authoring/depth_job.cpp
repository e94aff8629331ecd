// arthroscene depth PANORAMA -o depth.tiff: relief from brightness [paper, 3.4].
#include <cstdio>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/job_files.h"
#include "app/cli/job_progress.h"
#include "app/cli/jobs.h"
#include "app/cli/options_cli.h"
#include "authoring/depth/depth_filter.h"
#include "authoring/depth/depth_noise.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/scene/image_io.h"

namespace arthro::app {
namespace {

struct DepthJob {
  std::string panorama, output, noise;
  authoring::DepthOptions options;
};

void Run(const DepthJob& job) {
  authoring::CheckDepthOptions(job.options);
  const ColourImage panorama = ReadColourImage(job.panorama);
  authoring::DepthReport report;
  const DepthMap depth =
      authoring::DepthFromColour(panorama, job.options, &report, TerminalProgress());
  if (report.imaged_share == 0.0)
    throw Error(Code::kBadImage,
                "this picture is nothing but dark surround; lower --surround-threshold or take "
                "another picture",
                job.panorama);
  const DepthMap sigma =
      job.noise.empty() ? DepthMap() : authoring::NoiseOfDepth(depth, job.options.texture_size);
  if (!job.noise.empty() && sigma.empty())
    throw Error(Code::kBadImage,
                job.options.texture_size == 0
                    ? "no noise is stated with --texture-size 0; raise it, or leave out --noise"
                    : "the relief has no structure finer than --texture-size, so it states no "
                      "noise; leave out --noise",
                job.panorama);
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
  AddOptions(*job, own->options);
  files->Run([own] { Run(*own); });
}

}  // namespace arthro::app
