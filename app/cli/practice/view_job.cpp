// arthroscene view SCENE [method.md, Command line]: one picture through the arthroscope, with no
// window.
#include <filesystem>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/input_files.h"
#include "app/cli/job_files.h"
#include "app/cli/jobs.h"
#include "app/cli/number_flags.h"
#include "app/view/still_picture.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/scene_io.h"

namespace arthro::app {
namespace {

struct ViewArguments {
  std::filesystem::path scene, output;
  double latitude_deg = 0.0, longitude_deg = 0.0, roll_deg = 0.0, insertion_mm = 10.0;
  std::optional<double> view_angle_deg, head_roll_deg, field_of_view_deg;
  std::optional<double> relight;
  int size = 512;
  bool plain = false;
  std::string disturb;
  int disturb_seed = 0;
  double disturb_time = 0;
  std::optional<int> relief_steps, relief_cell;
};

// "haze (blood in …), …" for the help, by the one list of them.
std::string DisturbanceWords() {
  struct Words {
    std::string all;
    void operator()(const char* name, double&, const Range&, const char*, const char* help) {
      all += fmt::format("{}{} ({})", all.empty() ? "" : "; ", name,
                         std::string_view(help).substr(0, std::string_view(help).size() - 1));
    }
  } words;
  Disturbances().Visit(words);
  return words.all;
}

void RunViewJob(const ViewArguments& arguments) {
  const simulation::RodPose pose{
      RadiansFromDegrees(arguments.latitude_deg), RadiansFromDegrees(arguments.longitude_deg),
      RadiansFromDegrees(arguments.roll_deg), MetresFromMm(arguments.insertion_mm)};
  std::optional<double> head_roll;
  if (arguments.head_roll_deg) head_roll = RadiansFromDegrees(*arguments.head_roll_deg);
  Disturbances disturbances;
  if (!arguments.disturb.empty()) disturbances = ParseDisturbances(arguments.disturb);
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

  StillPictures pictures(loaded);
  Picture picture = PictureFromPose(pose, view_angle, optics.field_of_view, head_roll);
  picture.lens = optics.lens;
  picture.plain = arguments.plain;
  picture.disturbances = disturbances;
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
  CLI::App* job = program.add_subcommand("view", "One picture through the arthroscope");
  const auto files = JobFiles::Of(*job);
  files
      ->Input(job->add_option("SCENE", arguments->scene, "Scene folder or scene.json"), kSceneInput)
      ->required();
  AddNumber(*job, "--latitude-deg", arguments->latitude_deg, {-90.0, 90.0}, "degrees",
            "Rod's direction, up");
  AddNumber(*job, "--longitude-deg", arguments->longitude_deg, {-180.0, 180.0}, "degrees",
            "Rod's direction, right");
  AddNumber(*job, "--roll-deg", arguments->roll_deg, kAnyAngle, "degrees",
            "Turn of the rod, from up towards right");
  AddNumber(*job, "--insertion-mm", arguments->insertion_mm, {-1000.0, 1000.0}, "mm",
            "Depth of the tip beyond the portal, less than the backdrop's radius");
  AddNumber(*job, "--view-angle-deg", arguments->view_angle_deg, {0.0, 90.0}, "degrees",
            "Angle between rod and view; the scene's own where not given");
  AddNumber(*job, "--head-roll-deg", arguments->head_roll_deg, kAnyAngle, "degrees",
            "Turn of the camera head on its own; with the rod where not given");
  AddNumber(*job, "--field-of-view-deg", arguments->field_of_view_deg, {10.0, 170.0}, "degrees",
            "Full angle of the round window; the scene's own where not given");
  AddNumber(*job, "--size", arguments->size, {StillPictures::kMinSize, StillPictures::kMaxSize},
            "px", "Width and height of the picture");
  job->add_flag("--plain", arguments->plain,
                "Backdrop colours only: no light, soft rim, mark, tissues or instrument");
  AddNumber(*job, "--relief-steps", arguments->relief_steps, {0, 4096}, "",
            "Places along a ray, at most, that are held against the depth map, so that what is "
            "near hides what is far and moves before it: 128 for a fine picture; 0: all colours "
            "lie on the bare sphere; where not given 64, and 0 with --plain");
  AddNumber(*job, "--relight", arguments->relight, {0.0, 1.0}, "",
            "How far the light of the footage is evened out and the scope's own lamp put in "
            "its place: 0 before, 1 after; the scene's own where not given");
  job->add_option("--disturb", arguments->disturb,
                  "What disturbs the picture, each with a strength from 0 to 1, as in "
                  "haze=0.5,bubbles=0.3: " +
                      DisturbanceWords());
  AddNumber(*job, "--disturb-seed", arguments->disturb_seed, kAnyWholeNumber, "",
            "Another seed gives other bubbles, flakes and swirls");
  AddNumber(*job, "--disturb-time", arguments->disturb_time, {-86400.0, 86400.0}, "s",
            "Moment of what drifts and swirls");
  AddNumber(*job, "--relief-cell", arguments->relief_cell, {1, 64}, "px",
            "Cells of so many pixels share one search, and each pixel closes in from there; "
            "1: every pixel searches. Where not given 8, and 1 with --relief-steps or --plain");
  files
      ->Output(job->add_option("-o,--output", arguments->output,
                               "Picture to write, by its ending: .png, .tif…"),
               kPictureFile)
      ->required();
  job->footer(
      "No display is needed. The window's centre is the picture's; outside it is black. A ray at "
      "angle t from the view's axis lands sin(t/2) / sin(fov/4) window radii from the centre.");
  files->Run([arguments] { RunViewJob(*arguments); });
}

}  // namespace arthro::app
