// records show: the report of one attempt, as a page, JSON and a table.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/input_files.h"
#include "app/cli/job_files.h"
#include "app/cli/practice/shipped_presets.h"
#include "app/cli/records/records_job.h"
#include "app/platform/resource_folder.h"
#include "app/records/keeping/kept_attempt.h"
#include "app/report/assessment_file.h"
#include "app/report/draw_pictures.h"
#include "app/report/make_report.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/training/attempt_log.h"
#include "simulation/training/scene_of_attempt.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

struct ShowJob {
  std::shared_ptr<RecordsPlace> place;
  std::string attempt, group;
  fs::path scene, report, json, csv;
  bool leaves_pictures = false;
};

// Scene of the attempt: the one that is given, else the demo where the attempt was made in it;
// nothing, with the reason, where neither is it.
std::optional<LoadedScene> SceneOf(const ShowJob& job, const Records& records,
                                   const AttemptReport& report, std::string& why) {
  const auto head = simulation::AttemptHeadOf(
      simulation::ReadAttempt(records.folder() / report.attempt.log).head);
  const fs::path file = job.scene.empty() ? ResourceFolder() / "demo" : job.scene;
  LoadedScene loaded = LoadScene(file);
  if (simulation::IsOfScene(head, loaded)) return loaded;
  why =
      job.scene.empty()
          ? fmt::format("give the scene \"{}\" with --scene", report.attempt.scene)
          : fmt::format("the attempt was made in the scene \"{}\" as it was then, which {} is not",
                        report.attempt.scene, job.scene.string());
  return std::nullopt;
}

// Sets pictures and the expert, as `assess` does; a report without them is one as well.
void AddFromScene(const ShowJob& job, Records& records, AttemptReport& report) {
  std::string why;
  try {
    const auto loaded = SceneOf(job, records, report, why);
    if (loaded) {
      for (const Exercise& exercise : loaded->scene.exercises)
        if (ExerciseRowOf(exercise).hash == report.exercise.hash)
          SetExpert(report, *loaded, exercise, &records);
      why = SetPictures(report, *loaded, ShippedLooks(loaded->scene));
    }
  } catch (const Error& fault) {
    why = fault.what();
  }
  if (!why.empty())
    fmt::print(stderr, "note: the report has no pictures: {}\n", PrintableLine(why));
}

void Show(const ShowJob& job) {
  Records records(job.place->Connection());
  std::string notice;
  AttemptReport report = ReportFromRecords(records, job.attempt, notice);
  if (!notice.empty()) fmt::print(stderr, "note: {}\n", PrintableLine(notice));
  if (!job.group.empty()) SetGroup(report, records, job.group);
  if (!job.report.empty() && !job.leaves_pictures && !report.frames.empty())
    AddFromScene(job, records, report);
  if (!job.report.empty()) WriteAtomically(job.report, AttemptPage(report), Access::kPrivate);
  if (!job.json.empty()) WriteAtomically(job.json, AttemptJson(report), Access::kPrivate);
  if (!job.csv.empty()) WriteAtomically(job.csv, MetricTable(report), Access::kPrivate);
  if (job.report.empty() && job.json.empty() && job.csv.empty())
    WriteAtomically("-", AttemptJson(report));
}

}  // namespace

void AddShowRecords(CLI::App& records) {
  const auto own = std::make_shared<ShowJob>();
  CLI::App* job = records.add_subcommand(
      "show", "Report an attempt: a page for print, JSON and a table. JSON without a flag.");
  own->place = AddPlace(*job);
  job->add_option("ATTEMPT", own->attempt, "Id of the attempt, as list shows it.")
      ->required()
      ->type_name("ID");
  job->add_option("--reference", own->group,
                  "Reference group of the exercise whose values the report shows.")
      ->type_name("GROUP");
  const auto files = JobFiles::Of(*job);
  files->Input(job->add_option("--scene", own->scene,
                               "Scene of the attempt, for the pictures of the page; the demo scene "
                               "is found without it."),
               kSceneInput);
  job->add_flag("--no-pictures", own->leaves_pictures,
                "Leave pictures of the scope off the page. They need OpenGL, in software too.");
  files->Output(job->add_option("--report", own->report, "Page to write (HTML), for A4."),
                {"a page", FileForm::kTable, kAttemptPageHead});
  files->Output(job->add_option("--json", own->json, "Report as JSON; - is standard output."),
                {"a report", FileForm::kJson, "arthroscene.assessment/"});
  files->Output(job->add_option("--csv", own->csv, "Metrics as a table; - is standard output."),
                {"a table of metrics", FileForm::kTable, kMetricTableHead});
  files->Run([own] { Show(*own); });
}

}  // namespace arthro::app
