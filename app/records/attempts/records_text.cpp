#include "app/records/attempts/records_text.h"

#include "app/records/store/json_file.h"

namespace arthro::app {
namespace {

constexpr const char* kSchema = "arthroscene.records/1";

}  // namespace

std::string RecordsText(const RecordsBundle& bundle) { return JsonFileText(bundle, kSchema); }

RecordsBundle RecordsFromText(std::string_view text, const std::filesystem::path& file) {
  return FromJsonFile<RecordsBundle>(text, kSchema, "records", file);
}

std::string RecordsSchema() {
  return JsonFileSchema<RecordsBundle>(
      kSchema, "Records of attempts",
      "Attempts at exercises with all that they refer to. SI units; times in UTC.");
}

}  // namespace arthro::app
