// Attempts between a JSON file (records_text.h) and the database: exports and imports.
#pragma once

#include <string>

#include "app/records/attempts/attempt_record.h"
#include "app/records/attempts/records_text.h"
#include "app/records/store/records.h"

namespace arthro::app {

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
