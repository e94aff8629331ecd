// Attempts as a JSON file, arthroscene.records/1: exports, imports and the outbox. The schema is
// resources/schemas/records-1.schema.json.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/records/attempts/attempt_record.h"
#include "app/records/store/records.h"

namespace arthro::app {

std::string RecordsText(const RecordsBundle& bundle);
RecordsBundle RecordsFromText(std::string_view text, const std::filesystem::path& file = {});
std::string RecordsSchema();

// Everything about the attempts of one trainee, or of all with an empty code.
RecordsBundle ReadBundle(Records& records, const std::string& trainee_code = "");
// One attempt with all that it refers to. Throws Error where it is not there.
RecordsBundle ReadBundleOf(Records& records, const std::string& attempt);

struct Imported {
  int fresh = 0, known = 0;
};
// Each attempt in a transaction of its own; one that is there already is passed over.
Imported Import(Records& records, const RecordsBundle& bundle);

}  // namespace arthro::app
