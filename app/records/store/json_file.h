// Files of one struct in JSON by its one list of fields (core/options.h): text, value and schema.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/core/json_text.h"
#include "simulation/scene/json/field_json.h"
#include "simulation/scene/json/field_schema.h"
#include "simulation/scene/json/file_schema.h"

namespace arthro::app {

// `schema`: such as "arthroscene.form/1".
template <class T>
std::string JsonFileText(T value, const char* schema) {
  nlohmann::ordered_json json;
  json["schema"] = schema;
  value.Visit(FieldWriter(json));
  return json.dump(2) + "\n";
}

// `what`: the file in words, for its messages. Throws Error(kBadData) with the first fault.
template <class T>
T FromJsonFile(std::string_view text, const char* schema, const char* what,
               const std::filesystem::path& file) {
  const nlohmann::json json = ParseJson(text, Code::kBadData, file);
  RequireObject(json, what, file);
  std::vector<JsonFault> faults;
  JsonObjectReader reader(json, "", faults);
  RequireSchema(reader, schema, file);
  T value;
  value.Visit(FieldReader(reader));
  reader.RefuseOtherKeys(true);
  if (!faults.empty()) throw Error(Code::kBadData, faults[0].sentence, file);
  return value;
}

template <class T>
std::string JsonFileSchema(const char* schema, const char* title, const char* description) {
  return FileSchema(schema, title, description, SchemaOfFields(T())).dump(2) + "\n";
}

}  // namespace arthro::app
