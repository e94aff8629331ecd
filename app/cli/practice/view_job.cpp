// arthroscene view SCENE [method.md, Command line]: one picture through the arthroscope, with no
// window.
#include <filesystem>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/flags/options_cli.h"
#include "app/cli/input_files.h"
#include "app/cli/job_files.h"
#include "app/cli/jobs.h"
#include "app/cli/practice/shipped_presets.h"
#include "app/view/still_picture.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/image_io.h"

namespace arthro::app {
namespace {

struct ViewArguments {
  std::filesystem::path scene, output;
  double latitude_deg = 0.0, longitude_deg = 0.0, roll_deg = 0.0, insertion_mm = 10.0;
  std::optional<double> view_angle_deg, head_roll_deg, field_of_view_deg;
  std::optional<double> relight;
  int size = 512;
  bool plain = false, no_camera = false, no_flecks = false;
  std::string disturb;
  int disturb_seed = 0;
  double disturb_time = 0;
  std::optional<int> relief_steps, relief_cell;
};

void RunViewJob(const ViewArguments& arguments) {
  const simulation::RodPose pose{
      RadiansFromDegrees(arguments.latitude_deg), RadiansFromDegrees(arguments.longitude_deg),
      RadiansFromDegrees(arguments.roll_deg), MetresFromMm(arguments.insertion_mm)};
  std::optional<double> head_roll;
  if (arguments.head_roll_deg) head_roll = RadiansFromDegrees(*arguments.head_roll_deg);
  Disturbances disturbances;
  if (!arguments.disturb.empty()) disturbances = simulation::ParseDisturbances(arguments.disturb);
  disturbances.seed = arguments.disturb_seed;
  disturbances.time = arguments.disturb_time;
  CheckDisturbances(disturbances);
  LoadedScene loaded = LoadScene(arguments.scene);
  if (arguments.relight) loaded.scene.backdrop.relight = *arguments.relight;
  const ScopeSpec& scope = loaded.scene.scope;
  const double view_angle =
      arguments.view_angle_deg ? RadiansFromDegrees(*arguments.view_angle_deg) : scope.view_angle;
  std::optional<double> field_of_view;
  if (arguments.field_of_view_deg) field_of_view = RadiansFromDegrees(*arguments.field_of_view_deg);
  const simulation::ScopeOptics optics = simulation::OpticsOf(scope, loaded.lens, field_of_view);

  StillPictures pictures(loaded, ShippedLooks(loaded.scene));
  Picture picture = PictureFromPose(arguments.plain ? pose : pictures.Hold(pose), view_angle,
                                    optics.field_of_view, head_roll);
  picture.lens = optics.lens;
  if (!arguments.no_camera) picture.camera = optics.camera;
  picture.plain = arguments.plain;
  picture.disturbances = disturbances;
  if (!arguments.no_flecks) picture.flecks = FlecksIn(loaded.scene.backdrop);
  picture.relief = arguments.plain || arguments.relief_steps ? ReliefSearch{} : kUsualRelief;
  if (arguments.relief_steps) picture.relief.steps = *arguments.relief_steps;
  if (arguments.relief_cell) picture.relief.cell = *arguments.relief_cell;
  const ColourImage image = pictures.Draw(picture, arguments.size);
  WriteColourImage(arguments.output, image);
  if (!pictures.view().notice().empty())
    fmt::print(stderr, "arthroscene: {}\n", pictures.view().notice());
}

}  // namespace

void AddViewJob(CLI::App& program) {
  auto arguments = std::make_shared<ViewArguments>();
  CLI::App* job = program.add_subcommand("view", "Draw one picture through the arthroscope.");
  const auto files = JobFiles::Of(*job);
  files
      ->Input(job->add_option("SCENE", arguments->scene,
                              "Scene folder, scene.json or .arthro archive."),
              kSceneInput)
      ->required();
  AddNumber(*job, "--latitude-deg", arguments->latitude_deg, {-90.0, 90.0}, "degrees",
            "Latitude of the rod; up is positive.");
  AddNumber(*job, "--longitude-deg", arguments->longitude_deg, {-180.0, 180.0}, "degrees",
            "Longitude of the rod; right is positive.");
  AddNumber(*job, "--roll-deg", arguments->roll_deg, kAnyAngle, "degrees",
            "Roll of the rod, from up towards right.");
  AddNumber(*job, "--insertion-mm", arguments->insertion_mm, {-1000.0, 1000.0}, "mm",
            "Depth of the tip beyond the portal; less than the backdrop's radius.");
  AddNumber(*job, "--view-angle-deg", arguments->view_angle_deg, {0.0, 90.0}, "degrees",
            "Angle between rod and view. Default: the scene's own.");
  AddNumber(*job, "--head-roll-deg", arguments->head_roll_deg, kAnyAngle, "degrees",
            "Roll of the camera head. Default: the roll of the rod.");
  AddNumber(*job, "--field-of-view-deg", arguments->field_of_view_deg,
            ShownRange<ScopeSpec>("field_of_view"), "degrees",
            "Full angle of the round window. Default: the scene's own.");
  AddNumber(*job, "--size", arguments->size, {StillPictures::kMinSize, StillPictures::kMaxSize},
            "px", "Width and height of the picture.");
  job->add_flag(
      "--plain", arguments->plain,
      "Draw backdrop colours only: no light, camera, soft rim, mark, tissues or instrument. The "
      "scope is drawn where it is put, also inside a surface.");
  job->add_flag("--no-camera", arguments->no_camera,
                "Leave out the camera: its exposure, colour fringes, sharpness and grain.");
  job->add_flag("--no-flecks", arguments->no_flecks,
                "Leave out the flecks that drift in the fluid of the scene.");
  AddNumber(*job, "--relief-steps", arguments->relief_steps, {0, 4096}, "",
            "Largest number of samples per ray of the relief. 0: all colours lie on the bare "
            "sphere. Default: 64, or 0 with --plain.");
  AddNumber(*job, "--relight", arguments->relight, ShownRange<Backdrop>("relight"), "",
            FindField<Backdrop>("relight").help + " Default: the scene's own.");
  job->add_option("--disturb", arguments->disturb,
                  "Disturbances of the picture, each with a strength from 0 to 1, as in "
                  "haze=0.5,bubbles=0.3: " +
                      simulation::DisturbanceHelp());
  AddNumber(*job, "--disturb-seed", arguments->disturb_seed, kAnyWholeNumber, "",
            "Seed of bubbles, flakes and swirls.");
  AddNumber(*job, "--disturb-time", arguments->disturb_time, {-86400.0, 86400.0}, "s",
            "Time at which drifting disturbances are drawn.");
  AddNumber(*job, "--relief-cell", arguments->relief_cell, {1, 64}, "px",
            "Side of the cells of pixels that share one relief search. 1: every pixel searches. "
            "Default: 8, or 1 with --relief-steps or --plain.");
  files
      ->Output(
          job->add_option("-o,--output", arguments->output,
                          "Picture to write; the ending gives the format: .png, .tif and others."),
          kPictureFile)
      ->required();
  job->footer(
      "No display is needed. The window's centre is the picture's; outside it is black. A ray at "
      "angle t from the view's axis lands sin(t/2) / sin(fov/4) window radii from the centre.");
  files->Run([arguments] { RunViewJob(*arguments); });
}

}  // namespace arthro::app
