// Tables of the records and their numbered migrations. Texts are in UTC (2026-11-23T20:30:00.000Z),
// numbers in SI units; a missing value is NULL.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "app/records/store/database.h"

namespace arthro::app {

// One step of the schema. Its statements are plain enough for SQLite and PostgreSQL.
struct Migration {
  int schema = 0;  // after it
  std::vector<std::string> statements;
};

std::span<const Migration> EveryMigration();

// Brings a database to the newest schema in one transaction. Records of an SQLite file are copied
// beside it before, as NAME.schema-N.backup; those of a server are the administrator's. Returns
// the copy; empty where nothing was to be done or nothing was there. Throws Error(kBadData) for
// records of a newer schema.
std::filesystem::path Migrate(Database& database, std::span<const Migration> migrations);

// 0 for a database without tables.
int SchemaOf(Database& database);
// Throws Error(kBadData) for records of a newer schema than this program knows.
void RefuseNewer(Database& database);

}  // namespace arthro::app
