// arthroscene rectify FOOTAGE --lens lens.json -o DIR (design §5): the fisheye taken out of frames.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/job_progress.h"
#include "app/cli/jobs.h"
#include "app/cli/number_flags.h"
#include "app/cli/options_cli.h"
#include "authoring/footage/footage.h"
#include "authoring/lens/rectifier.h"
#include "simulation/core/error.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/lens_io.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

struct RectifyJob {
  std::string footage, lens, output;
  double scale = 1;
  authoring::RectifyOptions options;
};

// A folder that appears whole or not at all: filled beside its place, then renamed to it.
class NewFolder {
 public:
  explicit NewFolder(const fs::path& target) : target_(fs::absolute(target).lexically_normal()) {
    if (!target_.has_filename()) target_ = target_.parent_path();
    std::error_code fault;
    if (fs::exists(target_, fault) &&
        !(fs::is_directory(target_, fault) && fs::is_empty(target_, fault)))
      throw Error(Code::kFile, "there is something here already; give a new or empty folder",
                  target);
    partial_ = target_;
    partial_ += ".partial";
    fs::remove_all(partial_, fault);
    if (!fs::create_directories(partial_, fault))
      throw Error(Code::kFile, "no folder can be made beside it; check the path and your rights",
                  target);
  }
  ~NewFolder() {
    std::error_code ignored;
    if (!partial_.empty()) fs::remove_all(partial_, ignored);
  }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

  const fs::path& partial() const { return partial_; }
  void Finish() {
    std::error_code fault;
    fs::remove(target_, fault);  // an empty folder; a full one stays, and the rename fails
    fs::rename(partial_, target_, fault);
    if (fault) throw Error(Code::kFile, "the finished folder cannot be put in place", target_);
    partial_.clear();
  }

 private:
  fs::path target_, partial_;
};

void Run(const RectifyJob& job) {
  CheckOptions(job.options);
  const Lens lens = ReadLens(job.lens);
  const authoring::Rectifier rectifier(lens, job.options, job.scale);
  authoring::Footage footage = authoring::Footage::Open(job.footage);
  const Progress progress = TerminalProgress();
  NewFolder folder(job.output);
  cv::Mat raw, rectified;
  int written = 0, passed_over = 0;
  while (footage.Next(raw)) {
    const int total = footage.info().frames;
    progress.Step("rectifying",
                  total > 0 ? std::min(1.0, static_cast<double>(footage.index()) / total) : 0);
    if (raw.empty()) {
      fmt::print(stderr, "warning: {}: {}\n", footage.NameOf(footage.index()), footage.fault());
      ++passed_over;
      continue;
    }
    rectifier.Rectify(raw, rectified);
    ColourImage picture(rectified.cols, rectified.rows);
    cv::Mat target(rectified.rows, rectified.cols, CV_8UC3, picture.rgb.data());
    rectified.copyTo(target);
    WriteColourImage(folder.partial() / fmt::format("{:06d}.png", footage.index()), picture);
    ++written;
  }
  if (written == 0)
    throw Error(Code::kBadImage, "no frame of this footage could be read; nothing was written",
                job.footage);
  if (!footage.CutShort().empty()) fmt::print(stderr, "warning: {}\n", footage.CutShort());
  folder.Finish();
  const cv::Size size = rectifier.size();
  fmt::print("{}: {} frames of {} x {} px, focal length {:.3f} px{}\n", job.output, written,
             size.width, size.height, rectifier.view().focal_px * job.scale,
             passed_over > 0 ? fmt::format(", {} could not be read", passed_over) : "");
}

}  // namespace

void AddRectifyJob(CLI::App& program) {
  CLI::App* job = program.add_subcommand(
      "rectify", "Take the fisheye out of footage: PNG frames as a pinhole camera would see them.");
  const auto own = std::make_shared<RectifyJob>();
  job->add_option("FOOTAGE", own->footage, "Video, folder of pictures or pattern (frames/%04d.png)")
      ->required();
  job->add_option("--lens", own->lens, "lens.json of the camera, at the footage's size")
      ->required();
  job->add_option("-o,--output", own->output, "Folder to write; new or empty")->required();
  AddNumber(*job, "--scale", own->scale, {1.0 / 16, 2.0}, "",
            "Of the rectified frames; below 1 pixels are averaged");
  AddOptions(*job, own->options);
  job->callback([own] { Run(*own); });
}

}  // namespace arthro::app
