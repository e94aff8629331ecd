#include "app/records/attempts/attempts.h"

#include <algorithm>
#include <fcntl.h>
#include <sys/file.h>
#include <system_error>
#include <tuple>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "app/records/store/schema.h"
#include "app/records/store/table.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/sha256.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRunning = "outcome = 'running'";
// Behind the source of a limit whose group is still too small.
constexpr std::string_view kStartValue = " (start value)";

// Marks of attempts that run, apart from the logs, of which there are many.
constexpr const char* kMarks = "running";

// The row of an attempt with another trainee; sessions and attempts name trainees by ids, which a
// station without its server makes itself.
std::string KnownTrainee(Records& records, const RecordsBundle& bundle, const std::string& id) {
  const auto own = std::find_if(bundle.trainees.begin(), bundle.trainees.end(),
                                [&](const TraineeRow& row) { return row.id == id; });
  if (own == bundle.trainees.end()) return id;
  const auto known =
      records.database().Ask("SELECT id FROM trainees WHERE code = :code", {own->code});
  return known.empty() ? id : TextOf(known[0][0]);
}

void PutParents(Records& records, const RecordsBundle& bundle, AttemptRecord& attempt) {
  Database& database = records.database();
  for (TraineeRow trainee : bundle.trainees) {
    if (trainee.id != attempt.trainee) continue;
    for (CohortRow cohort : bundle.cohorts) {
      if (cohort.id != trainee.cohort) continue;
      Insert(database, "cohorts", std::vector{cohort});
      const auto known = database.Ask("SELECT id FROM cohorts WHERE name = :name", {cohort.name});
      if (!known.empty()) trainee.cohort = TextOf(known[0][0]);
    }
    Insert(database, "trainees", std::vector{trainee});
  }
  const std::string trainee = KnownTrainee(records, bundle, attempt.trainee);
  for (SessionRow session : bundle.sessions)
    if (session.id == attempt.session) {
      session.trainee = trainee;
      Insert(database, "sessions", std::vector{session});
    }
  for (const ExerciseRow& exercise : bundle.exercises)
    if (exercise.hash == attempt.exercise) Insert(database, "exercises", std::vector{exercise});
  attempt.trainee = trainee;
}

void PutRows(Database& database, const AttemptRecord& attempt) {
  const std::vector<std::pair<std::string, Cell>> owner = {{"attempt", attempt.id}};
  Insert(database, "steps", attempt.steps, owner, true);
  Insert(database, "metrics", attempt.metrics, owner);
  Insert(database, "criteria", attempt.criteria, owner, true);
  Insert(database, "events", attempt.events, owner, true);
}

// Replaces the row `running`; false where there is none.
bool ReplaceRunning(Database& database, const AttemptRecord& attempt) {
  const Cell duration = attempt.duration ? Cell(*attempt.duration) : Cell();
  const Cell sha = attempt.log_sha256.empty() ? Cell() : Cell(attempt.log_sha256);
  const Cell bytes =
      attempt.log_bytes < 0 ? Cell() : Cell(static_cast<std::int64_t>(attempt.log_bytes));
  return database.Do(
             fmt::format("UPDATE attempts SET duration = :duration, outcome = :outcome, "
                         "reason = :reason, metrics_version = :metrics_version, "
                         "log_sha256 = :log_sha256, log_bytes = :log_bytes "
                         "WHERE id = :id AND {}",
                         kRunning),
             {{duration, std::string(simulation::ToString(attempt.outcome)), attempt.reason,
               static_cast<std::int64_t>(attempt.metrics_version), sha, bytes, attempt.id}}) > 0;
}

}  // namespace

void SetResult(AttemptRecord& record, const simulation::AttemptResult& result) {
  record.outcome = result.outcome;
  record.reason = result.reason;
  record.duration = result.duration;
  record.steps.clear();
  record.metrics.clear();
  record.criteria.clear();
  record.events.clear();
  for (const simulation::StepResult& step : result.steps)
    record.steps.push_back({step.id, simulation::ToString(step.outcome), step.began, step.ended});
  for (const simulation::MetricValue& value : result.metrics)
    record.metrics.push_back({std::string(value.metric->id), value.part,
                              std::string(value.metric->unit), value.why_none, value.value, 0});
  for (const simulation::CriterionResult& criterion : result.criteria)
    record.criteria.push_back(
        {criterion.metric, criterion.part,
         criterion.is_start_value ? criterion.source + std::string(kStartValue) : criterion.source,
         criterion.low, criterion.high, criterion.value, criterion.is_met});
  for (const simulation::AttemptEvent& event : result.events)
    record.events.push_back({event.t, simulation::ToString(event.kind), event.step, event.target,
                             event.note, event.value});
}

simulation::AttemptResult ResultOf(const AttemptRecord& record) {
  simulation::AttemptResult result;
  result.outcome = record.outcome;
  result.reason = record.reason;
  result.duration = record.duration.value_or(0);
  for (const StepRow& row : record.steps)
    if (const auto outcome = simulation::StepOutcomeFromString(row.outcome))
      result.steps.push_back({row.step, *outcome, row.began, row.ended});
  for (const CriterionRow& row : record.criteria) {
    const bool is_start = row.source.ends_with(kStartValue);
    result.criteria.push_back(
        {row.metric, row.part, row.low, row.high, row.value, row.passed,
         row.source.substr(0, row.source.size() - (is_start ? kStartValue.size() : 0)), is_start});
  }
  for (const MetricRow& row : record.metrics)
    for (const simulation::Metric& metric : simulation::EveryMetric())
      if (metric.id == row.name)
        result.metrics.push_back({&metric, row.part, row.value, row.why_none});
  for (const EventRow& row : record.events)
    if (const auto kind = simulation::EventKindFromString(row.kind))
      result.events.push_back(
          {row.t, *kind, row.step, row.target, row.value.value_or(0), row.note});
  return result;
}

SessionRow StartSession(Records& records, const std::string& trainee_code,
                        const std::string& program, const std::string& rig) {
  const auto trainee =
      records.database().Ask("SELECT id FROM trainees WHERE code = :code", {trainee_code});
  if (trainee.empty())
    throw Error(Code::kBadArgument,
                fmt::format("no trainee has the code {}; add it with `arthroscene records trainee "
                            "add {}`, or check its spelling",
                            trainee_code, trainee_code));
  SessionRow session{
      records.NewId(), TextOf(trainee[0][0]), records.station(), records.Now(), {}, program, rig};
  records.database().Write([&] { Insert(records.database(), "sessions", std::vector{session}); });
  return session;
}

void EndSession(Records& records, const std::string& session) {
  records.database().Write([&] {
    records.database().Do("UPDATE sessions SET ended = :ended WHERE id = :id",
                          {{records.Now(), session}});
  });
}

AttemptMark::AttemptMark(const fs::path& folder, const std::string& attempt)
    : file_(folder / MarkNameOf(attempt)) {
  std::error_code ignored;
  for (const fs::path& own : {file_, folder / LogNameOf(attempt)})
    fs::create_directories(own.parent_path(), ignored);
  lock_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (lock_ >= 0 && ::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    ::close(lock_);
    lock_ = -1;
  }
}

AttemptMark::~AttemptMark() {
  if (lock_ < 0) return;
  std::error_code ignored;
  fs::remove(file_, ignored);
  ::close(lock_);
}

void AttemptMark::Leave() {
  if (lock_ >= 0) ::close(std::exchange(lock_, -1));
}

AttemptMark::AttemptMark(AttemptMark&& other) noexcept
    : file_(std::move(other.file_)), lock_(std::exchange(other.lock_, -1)) {}

AttemptMark& AttemptMark::operator=(AttemptMark&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(lock_, other.lock_);
  return *this;
}

std::string LogNameOf(const std::string& attempt) { return "attempts/" + attempt + ".attempt"; }

std::string MarkNameOf(const std::string& attempt) { return std::string(kMarks) + "/" + attempt; }

StartedAttempt StartAttempt(Records& records, const SessionRow& session,
                            const ExerciseRow& exercise, const std::string& scene, AttemptMode mode,
                            int metrics_version) {
  StartedAttempt running;
  AttemptRecord& record = running.record;
  record.id = records.NewId();
  record.session = session.id;
  record.trainee = session.trainee;
  record.exercise = exercise.hash;
  record.scene = scene;
  record.mode = mode;
  record.metrics_version = metrics_version;
  record.log = LogNameOf(record.id);
  // Held before the row is there, so that no other program takes the attempt for one that was cut
  // short.
  running.mark = AttemptMark(records.folder(), record.id);
  Database& database = records.database();
  database.Write([&] {
    record.started = records.Now();
    const auto last = database.Ask("SELECT max(started) FROM attempts WHERE trainee = :trainee",
                                   {record.trainee});
    if (!last.empty() && TextOf(last[0][0]) >= record.started) {
      const std::string clock = record.started;
      record.started = UtcText(MillisecondsOf(TextOf(last[0][0])).value_or(0) + 1);
      if (record.started.substr(0, 19) != clock.substr(0, 19))
        database.Do(
            "INSERT INTO audit (id, made, who, action, subject) VALUES (:id, :made, :who, "
            ":action, :subject)",
            {{records.NewId(), clock, records.station(),
              std::string("begin of an attempt set behind the last one, since the clock "
                          "was set back"),
              record.id}});
    }
    Insert(database, "exercises", std::vector{exercise});
    Insert(database, "attempts", std::vector{record});
  });
  return running;
}

bool PutAttempt(Records& records, const RecordsBundle& bundle, const AttemptRecord& attempt) {
  Database& database = records.database();
  bool is_new = false;
  database.Write([&] {
    RefuseNewer(database);  // another program may have migrated the records meanwhile
    AttemptRecord own = attempt;
    PutParents(records, bundle, own);
    is_new = Insert(database, "attempts", std::vector{own}) > 0 ||
             (own.outcome != AttemptOutcome::kRunning && ReplaceRunning(database, own));
    if (is_new) PutRows(database, own);
    for (const FormRow& form : bundle.forms)
      if (form.attempt == own.id && Insert(database, "forms", std::vector{form}) > 0)
        Insert(database, "form_items", form.items, {{"form", form.id}});
  });
  return is_new;
}

bool FinishAttempt(Records& records, const AttemptRecord& record) {
  return PutAttempt(records, {}, record);
}

std::optional<AttemptRecord> ReadAttempt(Records& records, const std::string& id) {
  Database& database = records.database();
  auto found = Select<AttemptRecord>(database, "attempts", "WHERE id = :id", {id});
  if (found.empty()) return std::nullopt;
  AttemptRecord& record = found[0];
  record.steps = Select<StepRow>(database, "steps", "WHERE attempt = :id ORDER BY seq", {id});
  record.metrics =
      Select<MetricRow>(database, "metrics", "WHERE attempt = :id ORDER BY name, part", {id});
  record.criteria =
      Select<CriterionRow>(database, "criteria", "WHERE attempt = :id ORDER BY seq", {id});
  record.events = Select<EventRow>(database, "events", "WHERE attempt = :id ORDER BY seq", {id});
  return record;
}

std::vector<AttemptRecord> AttemptsOf(Records& records, const std::string& trainee_code,
                                      const std::string& exercise_hash) {
  std::string where;
  Row values;
  if (!trainee_code.empty()) {
    where = "WHERE trainee = (SELECT id FROM trainees WHERE code = :code) ";
    values.emplace_back(trainee_code);
  }
  if (!exercise_hash.empty()) {
    where += where.empty() ? "WHERE exercise = :hash " : "AND exercise = :hash ";
    values.emplace_back(exercise_hash);
  }
  return Select<AttemptRecord>(records.database(), "attempts", where + "ORDER BY started, id",
                               values);
}

ExerciseRow FindExercise(Records& records, const std::string& id) {
  const auto found = Select<ExerciseRow>(records.database(), "exercises",
                                         "WHERE id = :id ORDER BY version DESC, hash", {id});
  if (found.empty())
    throw Error(
        Code::kBadArgument,
        fmt::format("the records hold no exercise {}; it is there after its first attempt", id));
  return found[0];
}

void SetLogSum(const fs::path& folder, AttemptRecord& record) {
  try {
    const std::string bytes = ReadWholeFile(folder / record.log);
    record.log_sha256 = Sha256(bytes);
    record.log_bytes = static_cast<int>(bytes.size());
  } catch (const Error&) {
    record.log_sha256.clear();
    record.log_bytes = -1;
  }
}

std::vector<std::string> RecoverAttempts(Records& records, const AssessLog& assess) {
  // The marks of this folder name the attempts, so that no others are read.
  std::vector<AttemptRecord> cut_short;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(records.folder() / kMarks, ignored)) {
    const auto found = Select<AttemptRecord>(
        records.database(), "attempts",
        fmt::format("WHERE id = :id AND {} AND session IN (SELECT id FROM sessions WHERE station = "
                    ":station)",
                    kRunning),
        {entry.path().filename().string(), records.station()});
    cut_short.insert(cut_short.end(), found.begin(), found.end());
  }
  std::ranges::sort(cut_short, {}, [](const AttemptRecord& record) {
    return std::tie(record.started, record.id);
  });
  std::vector<std::string> sentences;
  for (AttemptRecord& record : cut_short) {
    const AttemptMark mark(records.folder(), record.id);
    if (!mark.is_held()) continue;  // its program lives
    const auto result = assess ? assess(record) : std::nullopt;
    if (result) SetResult(record, *result);
    record.outcome = AttemptOutcome::kStopped;
    record.reason = result
                        ? "The program ended during the attempt; what its log holds was assessed."
                        : "The program ended during the attempt; its log could not be read.";
    SetLogSum(records.folder(), record);
    if (FinishAttempt(records, record))
      sentences.push_back(
          fmt::format("the attempt {} of {} was cut short; {}", record.id, record.started,
                      result ? "it was assessed from its log" : "its log could not be read"));
  }
  return sentences;
}

}  // namespace arthro::app
