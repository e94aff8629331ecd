// arthroscene view SCENE (design §5): one picture through the arthroscope, with no window.
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/job_files.h"
#include "app/cli/jobs.h"
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

double Radians(const char* flag, double degrees) {
  if (!std::isfinite(degrees))
    throw Error(Code::kBadArgument,
                fmt::format("{} {} is no angle; give a number of degrees", flag, degrees));
  return RadiansFromDegrees(degrees);
}

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
  const simulation::RodPose pose{Radians("--latitude-deg", arguments.latitude_deg),
                                 Radians("--longitude-deg", arguments.longitude_deg),
                                 Radians("--roll-deg", arguments.roll_deg),
                                 MetresFromMm(arguments.insertion_mm)};
  std::optional<double> head_roll;
  if (arguments.head_roll_deg) head_roll = Radians("--head-roll-deg", *arguments.head_roll_deg);
  Disturbances disturbances;
  if (!arguments.disturb.empty()) disturbances = ParseDisturbances(arguments.disturb);
  disturbances.seed = arguments.disturb_seed;
  disturbances.time = arguments.disturb_time;
  CheckDisturbances(disturbances);
  LoadedScene loaded = LoadScene(arguments.scene);
  if (arguments.relight && !std::isfinite(*arguments.relight))
    throw Error(Code::kBadArgument, "--relight is no number; give one from 0 to 1");
  if (arguments.relight) loaded.scene.backdrop.relight = *arguments.relight;
  const ScopeSpec& scope = loaded.scene.scope;
  const double view_angle = arguments.view_angle_deg
                                ? Radians("--view-angle-deg", *arguments.view_angle_deg)
                                : scope.view_angle;
  std::optional<double> field_of_view;
  if (arguments.field_of_view_deg)
    field_of_view = Radians("--field-of-view-deg", *arguments.field_of_view_deg);
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
      ->Input(job->add_option("SCENE", arguments->scene, "Scene folder or scene.json"),
              InputKind::kScene)
      ->required();
  job->add_option("--latitude-deg", arguments->latitude_deg, "Rod's direction, up")
      ->check(CLI::Range(-90.0, 90.0))
      ->capture_default_str();
  job->add_option("--longitude-deg", arguments->longitude_deg, "Rod's direction, right")
      ->check(CLI::Range(-180.0, 180.0))
      ->capture_default_str();
  job->add_option("--roll-deg", arguments->roll_deg, "Turn of the rod, from up towards right")
      ->capture_default_str();
  job->add_option("--insertion-mm", arguments->insertion_mm,
                  "Depth of the tip beyond the portal, less than the backdrop's radius")
      ->capture_default_str();
  job->add_option("--view-angle-deg", arguments->view_angle_deg,
                  "Angle between rod and view; the scene's own where not given")
      ->check(CLI::Range(0.0, 90.0));
  job->add_option("--head-roll-deg", arguments->head_roll_deg,
                  "Turn of the camera head on its own; with the rod where not given");
  job->add_option("--field-of-view-deg", arguments->field_of_view_deg,
                  "Full angle of the round window; the scene's own where not given")
      ->check(CLI::Range(10.0, 170.0));
  job->add_option("--size", arguments->size, "Width and height of the picture, px")
      ->check(CLI::Range(StillPictures::kMinSize, StillPictures::kMaxSize))
      ->capture_default_str();
  job->add_flag("--plain", arguments->plain,
                "Backdrop colours only: no light, soft rim, mark, tissues or instrument");
  job->add_option(
         "--relief-steps", arguments->relief_steps,
         "Places along a ray, at most, that are held against the depth map, so that what is "
         "near hides what is far and moves before it: 128 for a fine picture; 0: all colours "
         "lie on the bare sphere; where not given 64, and 0 with --plain")
      ->check(CLI::Range(0, 4096));
  job->add_option("--relight", arguments->relight,
                  "How far the light of the footage is evened out and the scope's own lamp put in "
                  "its place: 0 before, 1 after; the scene's own where not given")
      ->check(CLI::Range(0.0, 1.0));
  job->add_option("--disturb", arguments->disturb,
                  "What disturbs the picture, each with a strength from 0 to 1, as in "
                  "haze=0.5,bubbles=0.3: " +
                      DisturbanceWords());
  job->add_option("--disturb-seed", arguments->disturb_seed,
                  "Another seed gives other bubbles, flakes and swirls")
      ->capture_default_str();
  job->add_option("--disturb-time", arguments->disturb_time, "Moment of what drifts and swirls, s")
      ->capture_default_str();
  job->add_option(
         "--relief-cell", arguments->relief_cell,
         "Cells of so many pixels share one search, and each pixel closes in from there; "
         "1: every pixel searches. Where not given 8, and 1 with --relief-steps or --plain")
      ->check(CLI::Range(1, 64));
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
