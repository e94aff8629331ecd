// Attempts as a JSON file, arthroscene.records/1: exports, imports and the outbox. The schema is
// resources/schemas/records-1.schema.json.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "app/records/attempts/attempt_record.h"

namespace arthro::app {

std::string RecordsText(const RecordsBundle& bundle);
RecordsBundle RecordsFromText(std::string_view text, const std::filesystem::path& file = {});
std::string RecordsSchema();

}  // namespace arthro::app
