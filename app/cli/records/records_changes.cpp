// records export, import, sync, trainee, backup and erase: what enters and leaves the records.
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/cli/flags/number_flags.h"
#include "app/cli/job_files.h"
#include "app/cli/records/records_job.h"
#include "app/records/attempts/attempts.h"
#include "app/records/attempts/outbox.h"
#include "app/records/attempts/records_file.h"
#include "app/records/exchange/attempt_table.h"
#include "app/records/exchange/backup.h"
#include "app/records/exchange/study.h"
#include "app/records/exchange/xapi.h"
#include "app/records/people/trainees.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

struct ExportJob {
  std::shared_ptr<RecordsPlace> place;
  std::string trainee, home = "https://arthroscene.example";
  fs::path table, forms, json, xapi;
  bool is_study = false;
  int seed = 0;
};

void Export(const ExportJob& job) {
  if (job.table.empty() && job.forms.empty() && job.json.empty() && job.xapi.empty())
    throw Error(Code::kBadArgument, "nothing is to be written; give -o, --forms, --json or --xapi");
  if (job.is_study && job.seed == 0)
    throw Error(Code::kBadArgument,
                "the pseudonyms of a study come from a number that only the study knows; give "
                "--seed with a number that is not 0");
  Records records(job.place->Connection());
  if (!job.trainee.empty()) FindTrainee(records, job.trainee);
  RecordsBundle bundle = ReadBundle(records, job.trainee);
  if (job.is_study) bundle = ForStudy(std::move(bundle), static_cast<std::uint64_t>(job.seed));
  if (!job.table.empty()) WriteAtomically(job.table, AttemptTable(bundle), Access::kPrivate);
  if (!job.forms.empty()) WriteAtomically(job.forms, FormTable(bundle), Access::kPrivate);
  if (!job.json.empty()) WriteAtomically(job.json, RecordsText(bundle), Access::kPrivate);
  if (!job.xapi.empty()) {
    const XapiStatements statements = XapiOf(bundle, job.home);
    WriteAtomically(job.xapi, statements.text, Access::kPrivate);
    if (statements.left_out > 0)
      fmt::print(stderr,
                 "note: {} attempts are left out of --xapi: running, stopped, void or of robots\n",
                 statements.left_out);
  }
}

struct ImportJob {
  std::shared_ptr<RecordsPlace> place;
  fs::path file;
  bool joins_codes = false;
};

// One code of two trainees who were added apart may stand for two persons.
void RefuseTwoTrainees(Records& records, const RecordsBundle& bundle, const fs::path& file) {
  std::vector<std::string> codes;
  for (const TraineeRow& trainee : bundle.trainees)
    if (KnowsTrainee(records, trainee.code) && FindTrainee(records, trainee.code).id != trainee.id)
      codes.push_back(trainee.code);
  if (codes.empty()) return;
  throw Error(Code::kBadArgument,
              fmt::format("{} {} here and in this file for trainees who were added apart; give "
                          "--same-trainees where they are the same persons, or rename one side "
                          "with `arthroscene records trainee rename`",
                          fmt::join(codes, ", "), codes.size() == 1 ? "stands" : "stand"),
              file);
}

void ImportFile(const ImportJob& job) {
  const RecordsBundle bundle = RecordsFromText(ReadWholeFile(job.file), job.file);
  Records records(job.place->Connection());
  if (!job.joins_codes) RefuseTwoTrainees(records, bundle, job.file);
  const Imported imported = Import(records, bundle);
  fmt::print("{} attempts are new, {} were there already\n", imported.fresh, imported.known);
}

struct SyncJob {
  std::shared_ptr<RecordsPlace> place;
};

void Sync(const SyncJob& job) {
  Records records(job.place->Connection());
  const Synced synced = SyncOutbox(records, records.folder());
  fmt::print("{} attempts were moved, {} were there already\n", synced.fresh, synced.known);
  for (const std::string& fault : synced.refused) fmt::print("refused: {}\n", PrintableLine(fault));
  if (!synced.refused.empty())
    throw Error(Code::kBadData,
                fmt::format("{} files of the outbox could not be read, listed above; mend them or "
                            "move them away",
                            synced.refused.size()));
}

struct TraineeJob {
  std::shared_ptr<RecordsPlace> place;
  std::string action, code, new_code, cohort, hand, exercise, reason, who = UserWords();
  int experience = -1;
};

void ListTrainees(Records& records) {
  fmt::print("{:16}  {:16}  {:6}  {:>10}  {}\n", "code", "cohort", "hand", "experience", "created");
  const auto cohorts = CohortsOf(records);
  for (const TraineeRow& own : TraineesOf(records)) {
    std::string cohort;
    for (const CohortRow& row : cohorts)
      if (row.id == own.cohort) cohort = row.name;
    fmt::print("{:16}  {:16}  {:6}  {:>10}  {}\n", own.code, cohort, own.hand,
               own.experience < 0 ? "" : std::to_string(own.experience), own.created);
  }
}

void Trainee(const TraineeJob& job) {
  Records records(job.place->Connection());
  if (job.action == "list") return ListTrainees(records);
  if (job.action == "add") {
    TraineeRow trainee;
    trainee.code = job.code.empty() ? FreeCode(records) : job.code;
    trainee.cohort = job.cohort;
    trainee.hand = job.hand;
    trainee.experience = job.experience;
    fmt::print("{}\n", AddTrainee(records, trainee).code);
    return;
  }
  if (job.code.empty())
    throw Error(Code::kBadArgument,
                fmt::format("{} is about one trainee; give the code", job.action));
  if (job.action == "rename") {
    RenameTrainee(records, job.code, job.new_code, job.who);
  } else {
    OpenGate(records, job.code, FindExercise(records, job.exercise).hash, job.who, job.reason);
    fmt::print("the gate of {} is open for {}\n", job.exercise, job.code);
  }
}

struct BackupJob {
  std::shared_ptr<RecordsPlace> place;
  fs::path output;
};

struct EraseJob {
  std::shared_ptr<RecordsPlace> place;
  std::string code, again, who = UserWords();
};

void Erase(const EraseJob& job) {
  Records records(job.place->Connection());
  FindTrainee(records, job.code);
  if (job.again != job.code)
    throw Error(Code::kBadArgument,
                fmt::format("this erases {} attempts of {} for ever; repeat the code with --really "
                            "{} to do it",
                            AttemptsOf(records, job.code).size(), job.code, job.code));
  const Erased erased = EraseTrainee(records, job.code, job.who);
  fmt::print("{} is erased: {} attempts, {} forms, {} files\n", job.code, erased.attempts,
             erased.forms, erased.files);
  if (!erased.groups.empty()) fmt::print("computed again: {}\n", fmt::join(erased.groups, ", "));
  for (const std::string& file : erased.elsewhere)
    fmt::print("still to be deleted on another station: {}\n", PrintableLine(file));
  fmt::print("Backups keep {} until they are deleted.\n", job.code);
}

}  // namespace

void AddExportRecords(CLI::App& records) {
  const auto own = std::make_shared<ExportJob>();
  CLI::App* job = records.add_subcommand(
      "export", "Write attempts as a table, as JSON or as xAPI statements; forms as a table.");
  own->place = AddPlace(*job);
  const auto files = JobFiles::Of(*job);
  files->Output(job->add_option("-o,--output", own->table,
                                "Table with one row per attempt; - is standard output."),
                {"a table of attempts", FileForm::kTable, kAttemptTableHead});
  files->Output(job->add_option("--forms", own->forms, "Table with one row per rated item."),
                {"a table of forms", FileForm::kTable, kFormTableHead});
  files->Output(job->add_option("--json", own->json, "Everything as JSON, which import reads."),
                {"an export", FileForm::kJson, "arthroscene.records/"});
  files->Output(
      job->add_option("--xapi", own->xapi, "Statements of the Experience API, without a score."),
      {"a list of statements", FileForm::kTable, "["});
  job->add_option("--xapi-home", own->home,
                  "Address below which trainees and exercises are named in the statements.")
      ->type_name("ADDRESS")
      ->capture_default_str();
  job->add_option("--trainee", own->trainee, "Code of one trainee.")->type_name("CODE");
  job->add_flag("--study", own->is_study,
                "Replace codes, cohorts, raters and ids, count times from the first attempt, leave "
                "out free text, stations and files.");
  AddNumber(*job, "--seed", own->seed, {0, 2147483647}, "",
            "Start of the pseudonyms of a study; the same number gives the same ones.");
  files->Run([own] { Export(*own); });
}

void AddImportRecords(CLI::App& records) {
  const auto own = std::make_shared<ImportJob>();
  CLI::App* job = records.add_subcommand(
      "import", "Take attempts of an export; those that are there already are passed over.");
  own->place = AddPlace(*job);
  const auto files = JobFiles::Of(*job, false);
  files->Input(job->add_option("FILE", own->file, "Export as JSON."))->required();
  job->add_flag("--same-trainees", own->joins_codes,
                "A code stands for the same person here and in the file, though it was added on "
                "both sides.");
  files->Run([own] { ImportFile(*own); });
}

void AddSyncRecords(CLI::App& records) {
  const auto own = std::make_shared<SyncJob>();
  CLI::App* job = records.add_subcommand(
      "sync", "Move the attempts of this station's outbox into the records.");
  own->place = AddPlace(*job);
  job->callback([own] { Sync(*own); });
}

void AddTraineeRecords(CLI::App& records) {
  const auto own = std::make_shared<TraineeJob>();
  CLI::App* job = records.add_subcommand(
      "trainee", "List, add or rename trainees; open the gate of an exercise for one.");
  own->place = AddPlace(*job);
  job->add_option("ACTION", own->action, "What to do.")
      ->required()
      ->check(CLI::IsMember({"list", "add", "rename", "open-gate"}));
  job->add_option("CODE", own->code, "Code of the trainee; add makes one where it is left out.")
      ->type_name("CODE");
  job->add_option("--new-code", own->new_code, "Code that rename gives.")->type_name("CODE");
  job->add_option("--cohort", own->cohort, "Cohort of a new trainee.")->type_name("NAME");
  job->add_option("--hand", own->hand, "Dominant hand of a new trainee.")
      ->check(CLI::IsMember({"left", "right"}));
  AddNumber(*job, "--experience", own->experience, {-1, 1000000}, "",
            "Arthroscopies that a new trainee has done; -1 for not stated.");
  job->add_option("--exercise", own->exercise, "Exercise whose gate is opened.")->type_name("ID");
  job->add_option("--reason", own->reason, "Reason, which the audit keeps.")->type_name("WORDS");
  job->add_option("--who", own->who, "Who does it, for the audit.")
      ->type_name("WORDS")
      ->capture_default_str();
  job->callback([own] { Trainee(*own); });
}

void AddBackupRecords(CLI::App& records) {
  const auto own = std::make_shared<BackupJob>();
  CLI::App* job = records.add_subcommand(
      "backup", "Copy the database as of one moment. For a server it names pg_dump.");
  own->place = AddPlace(*job);
  const auto files = JobFiles::Of(*job);
  files
      ->Output(job->add_option("-o,--output", own->output, "File to write."),
               {"a backup", FileForm::kUnique})
      ->required();
  files->Run([own, files = files.get()] {
    Records source(own->place->Connection());
    Backup(source, own->output, files->overwrites());
  });
}

void AddEraseRecords(CLI::App& records) {
  const auto own = std::make_shared<EraseJob>();
  CLI::App* job =
      records.add_subcommand("erase", "Erase a trainee: rows and files. The audit keeps a hash.");
  own->place = AddPlace(*job);
  job->add_option("CODE", own->code, "Code of the trainee.")->required()->type_name("CODE");
  job->add_option("--really", own->again, "The code again.")->type_name("CODE");
  job->add_option("--who", own->who, "Who does it, for the audit.")
      ->type_name("WORDS")
      ->capture_default_str();
  job->callback([own] { Erase(*own); });
}

}  // namespace arthro::app
