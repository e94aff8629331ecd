// arthroscene centres SCENE [method.md, Command line]: the pixels at the centre of the view as the
// scope is rotated about its axis at several depths of insertion, the paper's validation figure
// [paper, 3.3, Fig. 7] as numbers and as a picture.
#include <filesystem>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/flags/number_flags.h"
#include "app/cli/input_files.h"
#include "app/cli/job_files.h"
#include "app/cli/jobs.h"
#include "app/steps/portals/centres_figure.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/image_io.h"

namespace arthro::app {
namespace {

struct CentresArguments {
  std::filesystem::path scene, output, picture;
  bool on_grid = false;
  std::optional<double> view_angle_deg;
  CentresChoice choice;
};

void RunCentresJob(CentresArguments arguments) {
  const Scene scene = ReadScene(arguments.scene);
  const Backdrop& backdrop = scene.backdrop;
  arguments.choice.view_angle = arguments.view_angle_deg
                                    ? RadiansFromDegrees(*arguments.view_angle_deg)
                                    : scene.scope.view_angle;
  const CentresFigure figure = CentresOf(backdrop, arguments.choice, arguments.scene);
  if (!arguments.picture.empty()) {
    const std::filesystem::path folder = std::filesystem::is_directory(arguments.scene)
                                             ? arguments.scene
                                             : arguments.scene.parent_path();
    ColourImage picture = ReadColourImage(folder / backdrop.panorama);
    if (arguments.on_grid) picture = GridOf(picture.width, picture.height);
    DrawCentres(picture, figure.rod, figure.lines);
    WriteColourImage(arguments.picture, picture);
  }
  WriteAtomically(arguments.output, figure.table);
  if (figure.without_pixel > 0)
    fmt::print(stderr,
               "arthroscene: {} of {} centres lie at a right angle to the picture's axis or behind "
               "it, where a gnomonic panorama has no pixel; their u_px and v_px are left empty\n",
               figure.without_pixel,
               arguments.choice.insertion_mm.size() * arguments.choice.roll_steps);
}

}  // namespace

void AddCentresJob(CLI::App& program) {
  auto arguments = std::make_shared<CentresArguments>();
  CLI::App* job = program.add_subcommand("centres",
                                         "List the panorama pixels at the centre of the view while "
                                         "the scope is rotated at several depths.");
  const auto files = JobFiles::Of(*job);
  files
      ->Input(
          job->add_option("SCENE", arguments->scene,
                          "Scene folder or scene.json. Its pictures are read only with --picture."),
          kSceneInput)
      ->required();
  AddNumber(*job, "--view-angle-deg", arguments->view_angle_deg, {0.0, 90.0}, "degrees",
            "Angle between rod and view. Default: the scene's own.");
  AddNumbers(*job, "--insertion-mm", arguments->choice.insertion_mm, {-1000.0, 1000.0}, "mm",
             "Depths of the tip beyond the portal, from 0 to the backdrop's radius. Commas "
             "separate depths; decimals have a point, so 1,5 is two depths and 1.5 is one.");
  AddNumber(*job, "--latitude-deg", arguments->choice.latitude_deg, {-90.0, 90.0}, "degrees",
            "Latitude of the rod; up is positive.");
  AddNumber(*job, "--longitude-deg", arguments->choice.longitude_deg, {-180.0, 180.0}, "degrees",
            "Longitude of the rod; right is positive.");
  AddNumber(*job, "--roll-steps", arguments->choice.roll_steps, {1, 1000000}, "",
            "Number of rolls in a full turn, beginning at 0 degrees.");
  files
      ->Output(job->add_option("-o,--output", arguments->output,
                               "Table to write; - is standard output."),
               {"a table of centres", FileForm::kTable, "insertion,roll_deg,u_px,v_px"})
      ->required();
  files->Output(job->add_option("--picture", arguments->picture,
                                "Picture to write: the centres on the panorama, one line per "
                                "depth, and a cross where the rod points."),
                kPictureFile);
  job->add_flag("--on-grid", arguments->on_grid, "Draw a regular grid instead of the panorama.");
  job->footer(
      "Columns: insertion (m), roll_deg, u_px, v_px (origin at the centre of the top-left pixel). "
      "u "
      "and v are empty where the panorama has no pixel, which is said on stderr; pixels beyond the "
      "panorama's edge are numbers all the same.");
  files->Run([arguments] { RunCentresJob(*arguments); });
}

}  // namespace arthro::app
