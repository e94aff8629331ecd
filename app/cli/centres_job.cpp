// arthroscene centres SCENE (design §5): the pixels at the centre of the view as the scope is
// rotated about its axis at several depths of insertion, the paper's validation figure [paper 3.3,
// Fig. 7] as numbers and as a picture.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/centres_picture.h"
#include "app/cli/jobs.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/scene_io.h"
#include "simulation/scope/arthroscope.h"

namespace arthro::app {
namespace {

struct CentresArguments {
  std::filesystem::path scene, output, picture;
  bool on_grid = false;
  std::optional<double> view_angle_deg;
  std::vector<double> insertion_mm = {5.0, 10.0, 15.0};
  double latitude_deg = 0.0, longitude_deg = 0.0;
  int roll_steps = 72;
};

void RunCentresJob(const CentresArguments& arguments) {
  const Scene scene = ReadScene(arguments.scene);
  const Backdrop& backdrop = scene.backdrop;
  const double view_angle = arguments.view_angle_deg ? RadiansFromDegrees(*arguments.view_angle_deg)
                                                     : scene.scope.view_angle;
  if (!std::isfinite(view_angle + arguments.latitude_deg + arguments.longitude_deg))
    throw Error(Code::kBadArgument, "an angle is not a number; give it in degrees");
  for (const double mm : arguments.insertion_mm)
    if (!(mm >= 0.0) || MetresFromMm(mm) > backdrop.radius * (1.0 + 1e-12))
      throw Error(
          Code::kBadArgument,
          fmt::format("--insertion-mm {} is not between 0 and the backdrop's radius of {:g} "
                      "mm; beyond it the tip would be behind the picture",
                      mm, MmFromMetres(backdrop.radius)),
          arguments.scene);

  // Before the work: what cannot be drawn on is said at once.
  ColourImage picture;
  if (!arguments.picture.empty()) {
    const std::filesystem::path folder = std::filesystem::is_directory(arguments.scene)
                                             ? arguments.scene
                                             : arguments.scene.parent_path();
    picture = ReadColourImage(folder / backdrop.panorama);
    if (arguments.on_grid)
      picture = GridPicture(picture.width, picture.height, std::max(2, picture.width / 32));
  }
  const auto pixel_of = [&](const simulation::RodPose& pose, double angle) {
    return PixelFromDirection(backdrop.projection,
                              simulation::CentreDirection(pose, angle, backdrop.radius));
  };
  std::vector<CentresLine> lines;
  std::string table = "insertion,roll_deg,u_px,v_px\n";
  int without_pixel = 0;
  for (const double mm : arguments.insertion_mm) {
    CentresLine& line = lines.emplace_back(CentresLine{fmt::format("{:g} mm", mm), {}});
    for (int step = 0; step < arguments.roll_steps; ++step) {
      const double roll_deg = 360.0 * step / arguments.roll_steps;
      const simulation::RodPose pose{RadiansFromDegrees(arguments.latitude_deg),
                                     RadiansFromDegrees(arguments.longitude_deg),
                                     RadiansFromDegrees(roll_deg), MetresFromMm(mm)};
      const auto pixel = pixel_of(pose, view_angle);
      line.pixel.push_back(pixel);
      table += fmt::format("{:.10g},{:.10g},", pose.depth, roll_deg);
      table += pixel ? fmt::format("{:.10g},{:.10g}\n", pixel->x, pixel->y) : ",\n";
      without_pixel += pixel ? 0 : 1;
    }
  }
  if (!arguments.picture.empty()) {
    const simulation::RodPose rod{RadiansFromDegrees(arguments.latitude_deg),
                                  RadiansFromDegrees(arguments.longitude_deg), 0, 0};
    DrawCentres(picture, pixel_of(rod, 0.0), lines);
    WriteColourImage(arguments.picture, picture);
  }
  WriteAtomically(arguments.output, table);
  if (without_pixel > 0)
    fmt::print(stderr,
               "arthroscene: {} of {} centres lie at a right angle to the picture's axis or behind "
               "it, where a gnomonic panorama has no pixel; their u_px and v_px are left empty\n",
               without_pixel, arguments.insertion_mm.size() * arguments.roll_steps);
}

}  // namespace

void AddCentresJob(CLI::App& program) {
  auto arguments = std::make_shared<CentresArguments>();
  CLI::App* job = program.add_subcommand(
      "centres",
      "Panorama pixels at the centre of the view while the scope is rotated at several depths");
  job->add_option("SCENE", arguments->scene,
                  "Scene folder or scene.json; its pictures are not read without --picture")
      ->required();
  job->add_option("--view-angle-deg", arguments->view_angle_deg,
                  "Angle between rod and view; the scene's own where not given")
      ->check(CLI::Range(0.0, 90.0));
  job->add_option(
         "--insertion-mm", arguments->insertion_mm,
         "Depths of the tip beyond the portal, comma-separated, 0 to the backdrop's radius")
      ->delimiter(',')
      ->capture_default_str();
  job->add_option("--latitude-deg", arguments->latitude_deg, "Rod's direction, up")
      ->check(CLI::Range(-90.0, 90.0))
      ->capture_default_str();
  job->add_option("--longitude-deg", arguments->longitude_deg, "Rod's direction, right")
      ->check(CLI::Range(-180.0, 180.0))
      ->capture_default_str();
  job->add_option("--roll-steps", arguments->roll_steps, "Rolls in a full turn, from 0 degrees on")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  job->add_option("-o,--output", arguments->output, "Table to write; - is standard output")
      ->required();
  job->add_option("--picture", arguments->picture,
                  "Picture to write: the centres on the panorama, a line each depth, a cross where "
                  "the rod points");
  job->add_flag("--on-grid", arguments->on_grid,
                "The picture has a regular grid of the panorama's size in its place");
  job->footer(
      "Columns: insertion (m), roll_deg, u_px, v_px (origin at the centre of the top-left pixel). "
      "u "
      "and v are empty where the panorama has no pixel, which is said on stderr; pixels beyond the "
      "panorama's edge are numbers all the same.");
  job->callback([arguments] { RunCentresJob(*arguments); });
}

}  // namespace arthro::app
