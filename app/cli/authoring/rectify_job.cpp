// arthroscene rectify FOOTAGE --lens lens.json -o DIR [method.md, Command line]: the fisheye taken
// out of frames.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "app/cli/flags/number_flags.h"
#include "app/cli/flags/options_cli.h"
#include "app/cli/input_files.h"
#include "app/cli/job_files.h"
#include "app/cli/job_progress.h"
#include "app/cli/jobs.h"
#include "authoring/footage/footage.h"
#include "authoring/lens/rectifier.h"
#include "simulation/core/error.h"
#include "simulation/core/folders/partial_folder.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/json/lens_io.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

struct RectifyJob {
  std::string footage, lens, output;
  double scale = 1;
  bool overwrites = false;
  authoring::RectifyOptions options;
};

// Frames beside what else is in a folder would be taken for one clip with it.
void RequireEmptyFolder(const fs::path& folder) {
  std::error_code fault;
  if (fs::exists(folder, fault) &&
      !(fs::is_directory(folder, fault) && fs::is_empty(folder, fault)))
    throw Error(Code::kFile,
                "there is something here already; give a new or empty folder, or add frames to it "
                "with --overwrite",
                folder);
}

void Run(const RectifyJob& job) {
  CheckOptions(job.options);
  if (!job.overwrites) RequireEmptyFolder(job.output);
  const Lens lens = ReadLens(job.lens);
  const authoring::Rectifier rectifier(lens, job.options, job.scale);
  authoring::Footage footage = authoring::Footage::Open(job.footage);
  const Progress progress = TerminalProgress();
  PartialFolder folder(job.output);
  cv::Mat raw, rectified;
  int written = 0, passed_over = 0;
  while (footage.Next(raw)) {
    const int total = footage.info().frames;
    progress.Step("rectifying",
                  total > 0 ? std::min(1.0, static_cast<double>(footage.index()) / total) : 0);
    if (raw.empty()) {
      fmt::print(stderr, "warning: {}\n",
                 PrintableLine(footage.NameOf(footage.index()) + ": " + footage.fault()));
      ++passed_over;
      continue;
    }
    rectifier.Rectify(raw, rectified);
    ColourImage picture(rectified.cols, rectified.rows);
    cv::Mat target(rectified.rows, rectified.cols, CV_8UC3, picture.rgb.data());
    rectified.copyTo(target);
    WriteColourImage(folder.beside() / fmt::format("{:06d}.png", footage.index()), picture);
    ++written;
  }
  if (written == 0)
    throw Error(Code::kBadImage, "no frame of this footage could be read; nothing was written",
                job.footage);
  if (!footage.CutShort().empty()) fmt::print(stderr, "warning: {}\n", footage.CutShort());
  folder.PutInPlace();
  const cv::Size size = rectifier.size();
  fmt::print("{}: {} frames of {} x {} px, focal length {:.3f} px{}\n", job.output, written,
             size.width, size.height, rectifier.view().focal_px * job.scale,
             passed_over > 0 ? fmt::format(", {} could not be read", passed_over) : "");
}

}  // namespace

void AddRectifyJob(CLI::App& program) {
  CLI::App* job = program.add_subcommand(
      "rectify", "Rectify footage: write PNG frames as a pinhole camera would see them.");
  const auto own = std::make_shared<RectifyJob>();
  const auto files = JobFiles::Of(*job);
  files
      ->Input(job->add_option("FOOTAGE", own->footage,
                              "Video, folder of pictures, or pattern such as frames/%04d.png."),
              kFootageInput)
      ->required();
  files
      ->Input(
          job->add_option("--lens", own->lens, "lens.json of the camera, at the footage's size."))
      ->required();
  files
      ->OutputFolder(job->add_option("-o,--output", own->output, "Folder to write; new or empty."),
                     {{"[0-9]{6,}[.]png", kPictureFile}})
      ->required();
  AddNumber(*job, "--scale", own->scale, {1.0 / 16, 2.0}, "",
            "Scale of the rectified frames; below 1 pixels are averaged.");
  AddOptions(*job, own->options);
  files->Run([own, files] {
    own->overwrites = files->overwrites();
    Run(*own);
  });
}

}  // namespace arthro::app
