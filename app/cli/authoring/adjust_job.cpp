// arthroscene adjust SCENE -o CHANGED: part, size, orientation and side of a scene.
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <tuple>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/flags/number_flags.h"
#include "app/cli/flags/pixel_flags.h"
#include "app/cli/input_files.h"
#include "app/cli/job_files.h"
#include "app/cli/jobs.h"
#include "app/cli/output_check.h"
#include "app/state/scratch_folder.h"
#include "authoring/adjustment/crop_backdrop.h"
#include "authoring/adjustment/mirror_scene.h"
#include "authoring/adjustment/orient_backdrop.h"
#include "authoring/adjustment/scale_backdrop.h"
#include "authoring/project/document_io.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/scene/files/scene_io.h"

namespace arthro::app {
namespace {

struct AdjustJob {
  std::string scene, output, side, between;
  std::optional<double> length_mm;
  std::optional<authoring::PixelBox> crop;
  authoring::Orientation orientation;
  bool mirrors = false;
};

// Pixels on the command line are those of the scene that is read, so the crop comes last but one.
void Run(const AdjustJob& job) {
  CheckOutputs({SceneFile(job.output)}, FilesOfScene(job.scene));
  authoring::Document document = authoring::OpenDocument(job.scene);
  std::string done;
  const auto note = [&](const std::string& words) { done += (done.empty() ? "" : ", ") + words; };
  if (!job.side.empty()) {
    document.scene.side = job.side == "left" ? BodySide::kLeft : BodySide::kRight;
    note(job.side + " knee");
  }
  if (!job.between.empty()) {
    const auto [from, to] =
        PixelsFromWord("--between", job.between, "takes two pixels of the panorama, as x,y:x,y");
    const double factor =
        authoring::ScaleBackdrop(document, {MetresFromMm(*job.length_mm), from, to});
    note(fmt::format("scaled by {:.4g} to a radius of {:.4g} mm", factor,
                     MmFromMetres(document.scene.backdrop.radius)));
  }
  if (job.orientation.up || job.orientation.medial) {
    const double turn = authoring::OrientBackdrop(document, job.orientation);
    note(fmt::format("turned by {:.1f} degrees", DegreesFromRadians(turn)));
  }
  if (job.crop) {
    authoring::CropBackdrop(document, *job.crop);
    note(fmt::format("cropped to {} x {} px", job.crop->width, job.crop->height));
  }
  ScratchFolder scratch;
  if (job.mirrors) {
    authoring::MirrorScene(document, [&](const auto& name) { return scratch.NewFile(name); });
    note("mirrored");
  }
  if (done.empty())
    throw Error(Code::kBadArgument,
                "nothing to change; give --crop, --length-mm, --up, --medial, --side or --mirror");
  authoring::SaveDocument(document, job.output);
  fmt::print("{}: {}\n", job.output, done);
}

}  // namespace

void AddAdjustJob(CLI::App& program) {
  CLI::App* job = program.add_subcommand(
      "adjust", "Crop, scale, turn or mirror a scene: the same backdrop and tissues, placed anew.");
  const auto own = std::make_shared<AdjustJob>();
  const auto files = JobFiles::Of(*job);
  files
      ->Input(job->add_option("SCENE", own->scene,
                              "Folder of the scene, its scene.json, or an .arthro archive."),
              kSceneInput)
      ->required();
  files
      ->OutputScene(job->add_option("-o,--output", own->output,
                                    "Scene to write: a folder, or an .arthro archive."),
                    SceneFile)
      ->required();
  job->add_option("--side", own->side, "Knee that the scene shows.")
      ->check(CLI::IsMember({"left", "right"}));
  AddNumber(*job, "--length-mm", own->length_mm, {0.5, 200.0}, "mm",
            "Known distance between the two pixels of --between.");
  job->add_option("--between", own->between,
                  "Two pixels of the panorama whose distance is --length-mm.")
      ->type_name("X,Y:X,Y");
  for (const auto& [flag, arrow, help] :
       {std::tuple{"--up", &own->orientation.up,
                   "Two pixels of the panorama: from the first to the second is up."},
        std::tuple{"--medial", &own->orientation.medial,
                   "Two pixels of the panorama: from the first to the second is medial. With --up "
                   "the side follows."}})
    job->add_option_function<std::string>(
           flag,
           [own, flag = flag, arrow = arrow](const std::string& word) {
             const auto [from, to] = PixelsFromWord(flag, word, "takes two pixels, as x,y:x,y");
             *arrow = authoring::PanoramaArrow{from, to};
           },
           help)
        ->type_name("X,Y:X,Y");
  job->add_option_function<std::string>(
         "--crop", [own](const std::string& words) { own->crop = BoxFromWords("--crop", words); },
         "Part of the panorama to keep, in its pixels.")
      ->type_name("X,Y,W,H");
  job->add_flag("--mirror", own->mirrors,
                "Mirror backdrop, tissues, cuts, portals and side: the other knee.");
  files->Run([own, job] {
    if ((job->count("--length-mm") > 0) != (job->count("--between") > 0))
      throw CLI::ValidationError("--length-mm", "and --between go together; give both");
    Run(*own);
  });
}

}  // namespace arthro::app
