// arthroscene check SCENE: loads everything, says what is there and what is wrong, all at once.
#include <cstdio>
#include <memory>
#include <string>
#include <tuple>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/input_files.h"
#include "app/cli/job_files.h"
#include "app/cli/jobs.h"
#include "app/cli/practice/shipped_presets.h"
#include "authoring/alignment/align_report.h"
#include "authoring/alignment/landmark_file.h"
#include "authoring/panorama/ties/tie_file.h"
#include "authoring/project/document_io.h"
#include "authoring/project/footage_record.h"
#include "authoring/project/sharing.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/practice/cut_check.h"
#include "simulation/scene/files/check_report.h"
#include "simulation/scene/files/scene_check.h"
#include "simulation/scene/json/lens_io.h"
#include "simulation/scene/json/rig_io.h"
#include "simulation/scene/json/scene_schema.h"
#include "simulation/scene/solids/solid_io.h"
#include "simulation/scope/window_lens.h"
#include "simulation/training/robot/unseen_targets.h"
#include "simulation/training/score/criteria.h"

namespace arthro::app {
namespace {

void Print(std::FILE* stream, const char* word, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) fmt::print(stream, "{}{}\n", word, PrintableLine(line));
}

void LookAtLens(const LoadedScene& loaded, SceneFindings& findings) {
  if (!loaded.lens) return;
  try {
    const simulation::ScopeOptics optics = simulation::OpticsOf(loaded.scene.scope, loaded.lens);
    findings.found.push_back(
        fmt::format("lens: {}, {:.1f} degrees, which count before the scope's own field of view",
                    ToString(loaded.lens->model), DegreesFromRadians(optics.field_of_view)));
  } catch (const Error& error) {
    findings.errors.push_back(error.sentence());
  }
}

void LookAtPoses(const LoadedScene& loaded, SceneFindings& findings) {
  try {
    for (const simulation::UnseenTarget& unseen : simulation::UnseenTargets(loaded))
      findings.warnings.push_back(simulation::ToString(unseen));
  } catch (const Error& error) {
    findings.errors.push_back(error.sentence());
  }
}

void CheckForSharing(const std::string& scene) {
  const std::vector<std::string> missing =
      authoring::MissingForSharing(authoring::OpenDocument(scene));
  Print(stderr, "missing: ", missing);
  if (missing.empty()) {
    fmt::print("this scene states its title, its author and the rights in each asset\n");
    return;
  }
  throw Error(Code::kBadScene,
              fmt::format("{} thing{} should be stated before this scene is shared; fill in "
                          "\"rights\", or the Rights of the Panorama page",
                          missing.size(), missing.size() == 1 ? "" : "s"),
              scene);
}

void Check(const std::string& scene, const std::string& report, bool is_for_sharing,
           bool tries_poses) {
  const auto presets = ShippedTissuePresets();
  LoadedScene loaded;
  SceneFindings findings = CheckScene(scene, &loaded, [&](const Tissue& tissue) {
    return simulation::IsThinLayer(tissue, presets);
  });
  for (std::string& fault : simulation::CriterionFaults(loaded.scene))
    findings.errors.push_back(std::move(fault));
  if (findings.errors.empty()) simulation::CheckCuts(loaded, findings);
  if (findings.errors.empty()) LookAtLens(loaded, findings);
  if (findings.errors.empty() && tries_poses) LookAtPoses(loaded, findings);
  if (!report.empty()) WriteAtomically(report, JsonFromFindings(findings));
  if (const std::size_t count = findings.errors.size()) {
    // Findings of a scene that was read in part would mislead.
    Print(stderr, "error: ", findings.errors);
    throw Error(Code::kBadScene,
                fmt::format("this scene has {} error{}", count, count == 1 ? "" : "s"), scene);
  }
  if (is_for_sharing) return CheckForSharing(scene);
  if (report == "-") return;  // standard output holds the report
  Print(stdout, "", findings.found);
  Print(stdout, "warning: ", findings.warnings);
  Print(stdout, "hint: ", findings.hints);
  const std::size_t count = findings.warnings.size();
  fmt::print("this scene can be practised on{}\n",
             count == 0 ? "" : fmt::format(", with {} warning{}", count, count == 1 ? "" : "s"));
}

}  // namespace

void AddCheckJob(CLI::App& program) {
  CLI::App* job =
      program.add_subcommand("check", "Load a scene with all its files and say what is wrong.");
  struct Arguments {
    std::string scene, report;
    bool is_for_sharing = false, tries_poses = false;
  };
  const auto own = std::make_shared<Arguments>();
  const auto files = JobFiles::Of(*job);
  files
      ->Input(job->add_option("SCENE", own->scene,
                              "Folder of the scene, its scene.json, or an .arthro archive."),
              kSceneInput)
      ->required();
  files->Output(job->add_option("--report", own->report,
                                "JSON: errors, warnings and hints, and what share of the relief "
                                "is measured; - for standard output."),
                {"a report", FileForm::kJson, "arthroscene.check/"});
  job->add_flag("--for-sharing", own->is_for_sharing,
                "List only what should be stated before the scene is shared: title, author, and "
                "source, licence and consent of each asset. The exit code is 1 if anything is.");
  job->add_flag("--poses", own->tries_poses,
                "Also try poses of the scope, and warn of targets of exercises that none of them "
                "sees. Takes a few seconds.");
  for (const auto& [flag, text, kind] :
       {std::tuple{"--schema", &SceneSchemaText, "scene.json"},
        std::tuple{"--rig-schema", &RigSchemaText, "rig files"},
        std::tuple{"--solid-schema", &SolidSchemaText, "solids"},
        std::tuple{"--lens-schema", &LensSchemaText, "lens files"},
        std::tuple{"--pairs-schema", &authoring::PairsSchemaText, "pairs of landmarks"},
        std::tuple{"--align-schema", &authoring::AlignReportSchemaText, "reports of `align`"},
        std::tuple{"--ties-schema", &authoring::TiesSchemaText, "tie points of a panorama"},
        std::tuple{"--footage-schema", &authoring::FootageSchemaText, "footage records"}})
    job->add_flag_callback(
        flag,
        [text = text] {
          fmt::print("{}", text());
          throw CLI::Success();
        },
        fmt::format("Print the JSON Schema of {}, and do nothing else.", kind));
  files->Run([own] { Check(own->scene, own->report, own->is_for_sharing, own->tries_poses); });
}

}  // namespace arthro::app
