#include "app/records/store/schema.h"

#include <algorithm>

#include <fmt/format.h>

#include "simulation/core/error.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kFirstSchema = {
    "CREATE TABLE meta (key TEXT NOT NULL PRIMARY KEY, value TEXT NOT NULL)",
    "CREATE TABLE cohorts (id TEXT NOT NULL PRIMARY KEY, name TEXT NOT NULL UNIQUE)",
    R"(CREATE TABLE trainees (id TEXT NOT NULL PRIMARY KEY, code TEXT NOT NULL UNIQUE,
    cohort TEXT REFERENCES cohorts (id), hand TEXT NOT NULL, experience BIGINT,
    created TEXT NOT NULL))",
    R"(CREATE TABLE sessions (id TEXT NOT NULL PRIMARY KEY,
    trainee TEXT NOT NULL REFERENCES trainees (id), station TEXT NOT NULL,
    started TEXT NOT NULL, ended TEXT, program TEXT NOT NULL, rig TEXT NOT NULL))",
    R"(CREATE TABLE exercises (hash TEXT NOT NULL PRIMARY KEY, id TEXT NOT NULL,
    version BIGINT NOT NULL, title TEXT NOT NULL, json TEXT NOT NULL))",
    R"(CREATE TABLE attempts (id TEXT NOT NULL PRIMARY KEY,
    session TEXT NOT NULL REFERENCES sessions (id),
    trainee TEXT NOT NULL REFERENCES trainees (id),
    exercise TEXT NOT NULL REFERENCES exercises (hash), scene TEXT NOT NULL,
    mode TEXT NOT NULL CHECK (mode IN ('practice', 'test', 'robot')), started TEXT NOT NULL,
    duration DOUBLE PRECISION, outcome TEXT NOT NULL
    CHECK (outcome IN ('running', 'passed', 'failed', 'stopped', 'void')),
    reason TEXT NOT NULL, metrics_version BIGINT NOT NULL, log TEXT NOT NULL, log_sha256 TEXT,
    log_bytes BIGINT))",
    R"(CREATE TABLE steps (attempt TEXT NOT NULL REFERENCES attempts (id), seq BIGINT NOT NULL,
    step TEXT NOT NULL, began DOUBLE PRECISION NOT NULL, ended DOUBLE PRECISION,
    outcome TEXT NOT NULL, PRIMARY KEY (attempt, seq)))",
    R"(CREATE TABLE metrics (attempt TEXT NOT NULL REFERENCES attempts (id), name TEXT NOT NULL,
    part TEXT NOT NULL, value DOUBLE PRECISION, unit TEXT NOT NULL, n BIGINT NOT NULL,
    why_none TEXT NOT NULL, PRIMARY KEY (attempt, name, part)))",
    R"(CREATE TABLE criteria (attempt TEXT NOT NULL REFERENCES attempts (id), seq BIGINT NOT NULL,
    metric TEXT NOT NULL, part TEXT NOT NULL, low DOUBLE PRECISION, high DOUBLE PRECISION,
    value DOUBLE PRECISION, passed BIGINT NOT NULL, source TEXT NOT NULL,
    PRIMARY KEY (attempt, seq)))",
    R"(CREATE TABLE events (attempt TEXT NOT NULL REFERENCES attempts (id), seq BIGINT NOT NULL,
    t DOUBLE PRECISION NOT NULL, kind TEXT NOT NULL, step TEXT NOT NULL, target TEXT NOT NULL,
    value DOUBLE PRECISION, note TEXT NOT NULL, PRIMARY KEY (attempt, seq)))",
    R"(CREATE TABLE forms (id TEXT NOT NULL PRIMARY KEY,
    attempt TEXT NOT NULL REFERENCES attempts (id), form TEXT NOT NULL,
    form_version BIGINT NOT NULL, rater TEXT NOT NULL, blinded BIGINT NOT NULL,
    made TEXT NOT NULL, comment TEXT NOT NULL))",
    R"(CREATE TABLE form_items (form TEXT NOT NULL REFERENCES forms (id), item TEXT NOT NULL,
    score BIGINT, PRIMARY KEY (form, item)))",
    R"(CREATE TABLE reference_groups (id TEXT NOT NULL PRIMARY KEY, name TEXT NOT NULL,
    exercise TEXT NOT NULL REFERENCES exercises (hash), metrics_version BIGINT NOT NULL,
    rule TEXT NOT NULL, made TEXT NOT NULL))",
    R"(CREATE TABLE reference_values (grp TEXT NOT NULL REFERENCES reference_groups (id),
    metric TEXT NOT NULL, part TEXT NOT NULL, n BIGINT NOT NULL, mean DOUBLE PRECISION,
    sd DOUBLE PRECISION, median DOUBLE PRECISION, q1 DOUBLE PRECISION, q3 DOUBLE PRECISION,
    PRIMARY KEY (grp, metric, part)))",
    R"(CREATE TABLE gates (trainee TEXT NOT NULL REFERENCES trainees (id),
    exercise TEXT NOT NULL REFERENCES exercises (hash), opened TEXT NOT NULL,
    by_whom TEXT NOT NULL, PRIMARY KEY (trainee, exercise)))",
    R"(CREATE TABLE audit (id TEXT NOT NULL PRIMARY KEY, made TEXT NOT NULL, who TEXT NOT NULL,
    action TEXT NOT NULL, subject TEXT NOT NULL))",
    // The start page and the cohort's page group by trainee and exercise; this index holds all that
    // they read.
    R"(CREATE INDEX attempts_of_trainees
    ON attempts (trainee, exercise, started, mode, outcome, duration))",
    "CREATE INDEX attempts_of_sessions ON attempts (session)",
    "CREATE INDEX sessions_of_trainees ON sessions (trainee)",
    "CREATE INDEX forms_of_attempts ON forms (attempt)",
};

const Migration kMigrations[] = {{1, kFirstSchema}};

// Beside the file, under a name that is free.
fs::path Copy(Database& database, int schema) {
  const fs::path file = database.words();
  fs::path copy;
  for (int i = 1; copy.empty() || fs::exists(copy); ++i)
    copy = fmt::format("{}.schema-{}{}.backup", file.string(), schema,
                       i == 1 ? "" : fmt::format("-{}", i));
  database.Do("VACUUM INTO :file", {{copy.string()}});
  std::error_code ignored;
  fs::permissions(copy, fs::perms::owner_read | fs::perms::owner_write, ignored);
  return copy;
}

}  // namespace

std::span<const Migration> EveryMigration() { return kMigrations; }

int SchemaOf(Database& database) {
  const bool is_file = database.kind() == DatabaseKind::kSqlite;
  const auto tables = database.Ask(
      is_file ? "SELECT CAST(count(*) AS BIGINT) FROM sqlite_master WHERE name = 'meta'"
              : R"(SELECT CAST(count(*) AS BIGINT) FROM pg_tables WHERE tablename = 'meta' AND
    schemaname = current_schema())");
  if (WholeOf(tables.at(0).at(0)) == 0) return 0;
  const auto rows = database.Ask("SELECT value FROM meta WHERE key = 'schema'");
  return rows.empty() ? 0 : static_cast<int>(NumberOf(rows[0][0]));
}

namespace {

void RefuseAbove(int newest, int schema, const Database& database) {
  if (schema > newest)
    throw Error(Code::kBadData,
                fmt::format("the records at {} have schema {}, and this program knows schemas up "
                            "to {}; update the program",
                            database.words(), schema, newest));
}

}  // namespace

void RefuseNewer(Database& database) {
  RefuseAbove(EveryMigration().back().schema, SchemaOf(database), database);
}

fs::path Migrate(Database& database, std::span<const Migration> migrations) {
  const int newest = migrations.back().schema;
  const int before = SchemaOf(database);
  RefuseAbove(newest, before, database);
  if (before == newest) return {};
  fs::path copy;
  if (before > 0 && database.kind() == DatabaseKind::kSqlite) copy = Copy(database, before);
  database.Write([&] {
    // Another program may have come first.
    if (database.kind() == DatabaseKind::kPostgresql)
      database.Ask("SELECT CAST(pg_advisory_xact_lock(4150) AS TEXT)");
    const int schema = SchemaOf(database);
    RefuseAbove(newest, schema, database);
    for (const Migration& migration : migrations) {
      if (migration.schema <= schema) continue;
      for (const std::string& statement : migration.statements) database.Do(statement);
      database.Do("DELETE FROM meta WHERE key = 'schema'");
      database.Do("INSERT INTO meta (key, value) VALUES ('schema', :schema)",
                  {{std::to_string(migration.schema)}});
    }
  });
  return copy;
}

}  // namespace arthro::app
