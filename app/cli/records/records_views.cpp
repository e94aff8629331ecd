// records list, reference and check: what the records hold, as text and as files.
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/job_files.h"
#include "app/cli/records/records_job.h"
#include "app/records/attempts/attempts.h"
#include "app/records/attempts/records_file.h"
#include "app/records/attempts/standings.h"
#include "app/records/exchange/backup.h"
#include "app/records/exchange/rating_form.h"
#include "app/records/people/reference_groups.h"
#include "app/records/people/trainees.h"
#include "app/report/assessment_file.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

struct ListJob {
  std::shared_ptr<RecordsPlace> place;
  std::string trainee, cohort;
  fs::path names, json;
};

// Lines CODE,NAME of a file that the instructor keeps.
std::map<std::string, std::string> ReadNames(const fs::path& file) {
  std::map<std::string, std::string> names;
  if (file.empty()) return names;
  std::ifstream lines(file);
  if (!lines) throw Error(Code::kFile, "could not be opened; check the name", file);
  for (std::string line; std::getline(lines, line);)
    if (const auto comma = line.find(','); comma != line.npos)
      names[line.substr(0, comma)] = line.substr(comma + 1);
  return names;
}

nlohmann::ordered_json JsonOf(const Standing& own) {
  nlohmann::ordered_json json{{"trainee", own.trainee},
                              {"cohort", own.cohort},
                              {"exercise", own.exercise_id},
                              {"version", own.version},
                              {"hash", own.exercise},
                              {"title", own.title},
                              {"tries", own.tries},
                              {"passes", own.passes},
                              {"best_time", nullptr},
                              {"last_started", own.last_started},
                              {"last_outcome", own.last_outcome},
                              {"gate_opened", own.is_gate_opened}};
  if (own.best_time) json["best_time"] = *own.best_time;
  return json;
}

void ListAttempts(Records& records, const std::string& trainee) {
  FindTrainee(records, trainee);
  fmt::print("{:36}  {:24}  {:8}  {:8}  {:>9}\n", "attempt", "begin", "mode", "outcome", "time, s");
  for (const AttemptRecord& own : AttemptsOf(records, trainee))
    fmt::print("{:36}  {:24}  {:8}  {:8}  {:>9}\n", own.id, own.started, ToString(own.mode),
               simulation::ToString(own.outcome),
               own.duration ? fmt::format("{:.2f}", *own.duration) : "");
}

void List(const ListJob& job) {
  Records records(job.place->Connection());
  const auto names = ReadNames(job.names);
  const auto standings = job.trainee.empty() ? CohortStandings(records, job.cohort)
                                             : StandingsOf(records, job.trainee);
  if (!job.json.empty()) {
    nlohmann::ordered_json json{{"schema", "arthroscene.standings/1"},
                                {"standings", nlohmann::json::array()}};
    for (const Standing& own : standings) json["standings"].push_back(JsonOf(own));
    WriteAtomically(job.json, json.dump(2) + "\n", Access::kPrivate);
    if (job.json == "-") return;
  }
  // Attempts of robots have no standing.
  if (standings.empty() && !job.trainee.empty() && !AttemptsOf(records, job.trainee).empty())
    return ListAttempts(records, job.trainee);
  if (standings.empty()) {
    if (job.trainee.empty())
      fmt::print(
          "No attempt of a person is recorded; --trainee CODE also lists those of robots.\n");
    else
      fmt::print("No attempt of trainee {} is recorded.\n", job.trainee);
    return;
  }
  fmt::print("{:12}  {:24}  {:>5}  {:>6}  {:>7}  {:8}  {:6}\n", "trainee", "exercise", "tries",
             "passed", "best, s", "last", "opened");
  for (const Standing& own : standings) {
    const auto name = names.find(own.trainee);
    fmt::print("{:12}  {:24}  {:>5}  {:>6}  {:>7}  {:8}  {:6}{}\n", own.trainee,
               fmt::format("{} v{}", own.exercise_id, own.version), own.tries, own.passes,
               own.best_time ? fmt::format("{:.1f}", *own.best_time) : "", own.last_outcome,
               own.is_gate_opened ? "yes" : "", name == names.end() ? "" : "  " + name->second);
  }
  if (!job.trainee.empty()) {
    fmt::print("\n");
    ListAttempts(records, job.trainee);
  }
}

struct ReferenceJob {
  std::shared_ptr<RecordsPlace> place;
  std::string name, exercise;
  ReferenceRule rule;
  bool counts_all = false;
};

void Reference(const ReferenceJob& job) {
  Records records(job.place->Connection());
  std::vector<ReferenceGroup> groups;
  if (job.name.empty()) {
    groups = ReferenceGroupsOf(records);
    if (groups.empty()) fmt::print("There is no reference group.\n");
  } else {
    if (job.exercise.empty() || job.rule.trainees.empty())
      throw Error(Code::kBadArgument,
                  "a reference group is made of an exercise and trainees; give --exercise and "
                  "--trainees");
    ReferenceRule rule = job.rule;
    rule.is_last_only = !job.counts_all;
    groups.push_back(
        MakeReferenceGroup(records, job.name, FindExercise(records, job.exercise).hash, rule));
  }
  for (const ReferenceGroup& group : groups) {
    fmt::print("{}, {}, metrics of version {}\n", group.name, group.made, group.metrics_version);
    fmt::print("  {:20} {:12} {:>4} {:>12} {:>12} {:>12}\n", "metric", "part", "n", "mean", "sd",
               "median");
    const auto number = [](const std::optional<double>& value) {
      return value ? fmt::format("{:.5g}", *value) : std::string("-");
    };
    for (const ReferenceValueRow& row : group.values)
      fmt::print("  {:20} {:12} {:>4} {:>12} {:>12} {:>12}\n", row.metric, row.part, row.n,
                 number(row.mean), number(row.sd), number(row.median));
  }
}

struct CheckJob {
  std::shared_ptr<RecordsPlace> place;
  bool prints_schema = false, prints_form_schema = false, prints_assessment_schema = false;
};

void Check(const CheckJob& job) {
  if (job.prints_schema) return WriteAtomically("-", RecordsSchema());
  if (job.prints_form_schema) return WriteAtomically("-", FormSchema());
  if (job.prints_assessment_schema) return WriteAtomically("-", AssessmentSchema());
  Records records(job.place->Connection());
  const RecordsCheck check = CheckRecords(records);
  fmt::print("{}: schema {}, {} trainees, {} attempts, {} of them running, {} in the outbox\n",
             records.database().words(), check.schema, check.trainees, check.attempts,
             check.running, check.outbox);
  for (const std::string& fault : check.faults) fmt::print("fault: {}\n", PrintableLine(fault));
  if (!check.faults.empty())
    throw Error(Code::kBadData,
                fmt::format("the records have {} faults, listed above; restore a backup, or bring "
                            "the files back",
                            check.faults.size()));
}

}  // namespace

void AddListRecords(CLI::App& records) {
  const auto own = std::make_shared<ListJob>();
  CLI::App* job =
      records.add_subcommand("list", "List tries, passes and best times by trainee and exercise.");
  own->place = AddPlace(*job);
  job->add_option("--trainee", own->trainee, "Code of a trainee: also lists the attempts.")
      ->type_name("CODE");
  job->add_option("--cohort", own->cohort, "Name of a cohort.")->type_name("NAME");
  const auto files = JobFiles::Of(*job);
  files->Input(job->add_option("--names", own->names,
                               "File of lines CODE,NAME, which the instructor keeps: shows the "
                               "names beside the codes."));
  files->Output(job->add_option("--json", own->json,
                                "The same as JSON; - is standard output, instead of the table."),
                {"a list of standings", FileForm::kJson, "arthroscene.standings/"});
  files->Run([own] { List(*own); });
}

void AddReferenceRecords(CLI::App& records) {
  const auto own = std::make_shared<ReferenceJob>();
  CLI::App* job = records.add_subcommand(
      "reference", "Compute a reference group, such as experts; list all without a name.");
  own->place = AddPlace(*job);
  job->add_option("NAME", own->name, "Name of the group.")->type_name("WORDS");
  job->add_option("--exercise", own->exercise, "Id of the exercise.")->type_name("ID");
  job->add_option("--trainees", own->rule.trainees, "Codes of those who belong to it.")
      ->delimiter(',')
      ->type_name("CODE,…");
  job->add_option("--mode", own->rule.mode, "Mode of the attempts that count.")
      ->check(CLI::IsMember({"test", "practice", "robot"}))
      ->capture_default_str();
  job->add_option("--rig", own->rule.rig, "Rig of the attempts that count, as it was recorded.")
      ->type_name("WORDS");
  job->add_flag("--all-attempts", own->counts_all,
                "Count every attempt of each trainee instead of the last one.");
  job->callback([own] { Reference(*own); });
}

void AddCheckRecords(CLI::App& records) {
  const auto own = std::make_shared<CheckJob>();
  CLI::App* job = records.add_subcommand(
      "check", "Read the whole database and look for the files of its attempts.");
  own->place = AddPlace(*job);
  job->add_flag("--schema", own->prints_schema, "Print the JSON Schema of exports instead.");
  job->add_flag("--form-schema", own->prints_form_schema,
                "Print the JSON Schema of forms instead.");
  job->add_flag("--assessment-schema", own->prints_assessment_schema,
                "Print the JSON Schema of reports of attempts instead.");
  job->callback([own] { Check(*own); });
}

}  // namespace arthro::app
