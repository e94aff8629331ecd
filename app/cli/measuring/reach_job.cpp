// arthroscene reach SCENE [method.md, Reach]: what scope and instrument reach through their
// portals, and at which angle the rods meet, as a table and as a picture.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/cli/flags/number_flags.h"
#include "app/cli/input_files.h"
#include "app/cli/job_files.h"
#include "app/cli/jobs.h"
#include "app/steps/portals/spacing_targets.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/csv_field.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/practice/reach/named_portals.h"
#include "simulation/practice/reach/portal_reach.h"
#include "simulation/practice/reach/reach_picture.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/image_io.h"

namespace arthro::app {
namespace {

using simulation::ReachShares;

struct ReachArguments {
  std::filesystem::path scene, output, picture;
  std::optional<double> view_angle_deg, spacing_mm;
  std::vector<std::string> targets;
  std::string portals, knee = "right";
};

std::string Row(const std::string& target, const ReachShares& shares) {
  return fmt::format("{},{:.4f},{:.4f},{:.4f},{:.4f},{:.1f}\n", CsvField(target), shares.seen,
                     shares.touched, shares.both, shares.good,
                     DegreesFromRadians(shares.median_angle));
}

void RunReachJob(const ReachArguments& arguments) {
  LoadedScene loaded = LoadScene(arguments.scene);
  if (arguments.view_angle_deg)
    loaded.scene.scope.view_angle = RadiansFromDegrees(*arguments.view_angle_deg);
  if (arguments.spacing_mm)
    loaded.scene.portals.incision_spacing = MetresFromMm(*arguments.spacing_mm);
  if (!arguments.portals.empty())
    loaded.scene.portals.incision_spacing = simulation::SpacingOf(
        *simulation::FindNamedPortals(arguments.portals), arguments.knee == "left");
  const PlacedTargets placed =
      PlaceTargets(loaded, SpacingTargetsOf(loaded.scene, arguments.targets));
  const simulation::ScopeReach scope = simulation::ScopeReachOf(loaded, {}, placed.points);
  const simulation::PortalReach reach =
      simulation::ReachWith(scope, loaded, loaded.scene.portals.incision_spacing);
  if (!arguments.picture.empty())
    WriteColourImage(arguments.picture,
                     simulation::DrawReach(OrEmpty(loaded.panorama), scope, reach));
  std::string table =
      "target,seen,touched,both,good,median_angle_deg\n" + Row("relief", reach.relief);
  for (std::size_t i = 0; i < reach.tissues.size(); ++i)
    table += Row(loaded.scene.tissues[i].name, reach.tissues[i]);
  WriteAtomically(arguments.output, table);
  if (arguments.targets.empty()) return;
  const double spacing = simulation::SuggestedSpacing(scope, loaded, placed.targets);
  fmt::print(arguments.output == "-" ? stderr : stdout,
             "suggested incision spacing for {}: {:.0f} mm\n", fmt::join(arguments.targets, ", "),
             MmFromMetres(spacing));
}

}  // namespace

void AddReachJob(CLI::App& program) {
  auto arguments = std::make_shared<ReachArguments>();
  CLI::App* job = program.add_subcommand(
      "reach",
      "List what scope and instrument reach through their portals, and how the rods meet.");
  const auto files = JobFiles::Of(*job);
  files
      ->Input(job->add_option("SCENE", arguments->scene,
                              "Folder of the scene, its scene.json, or an .arthro archive."),
              kSceneInput)
      ->required();
  AddNumber(*job, "--view-angle-deg", arguments->view_angle_deg, {0.0, 120.0}, "degrees",
            "Angle between rod and view. Default: the scene's own.");
  AddNumber(*job, "--spacing-mm", arguments->spacing_mm, {-1000.0, 1000.0}, "mm",
            "Incision spacing. Default: the scene's own.");
  std::vector<std::string> named;
  for (const simulation::NamedPortals& portals : simulation::EveryNamedPortals())
    named.emplace_back(portals.word);
  job->add_option("--portals", arguments->portals,
                  "Portals by name, scope first, in place of a spacing.")
      ->check(CLI::IsMember(named))
      ->excludes("--spacing-mm");
  job->add_option("--knee", arguments->knee, "Side of the knee for --portals. Default: right.")
      ->check(CLI::IsMember({"right", "left"}));
  job->add_option("--suggest", arguments->targets,
                  "Print the incision spacing that suits a target best: relief, a tissue, or a "
                  "target of an exercise as EXERCISE: TARGET. More than one suit the same; give "
                  "the flag for each.")
      ->type_name("TARGET")
      ->allow_extra_args(false);
  files
      ->Output(
          job->add_option("-o,--output", arguments->output,
                          "Table to write; - is standard output."),
          {"a table of reach", FileForm::kTable, "target,seen,touched,both,good,median_angle_deg"})
      ->required();
  files->Output(job->add_option("--picture", arguments->picture,
                                "Picture to write: the panorama with what is reached in colours."),
                kPictureFile);
  job->footer(
      "Columns, with shares from 0 to 1: seen is the share that the scope brings to the middle of "
      "its picture from 5 to 25 mm. The tip of the instrument touches the share in touched. Both "
      "have both. The rods meet there at 45 to 75 degrees for the share in good; their median "
      "angle comes last.");
  files->Run([arguments] { RunReachJob(*arguments); });
}

}  // namespace arthro::app
