// The head of a JSON file of ours: an object whose `schema` names what the file is.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulation/core/error.h"
#include "simulation/core/json_text.h"
#include "simulation/scene/json/field_json.h"
#include "simulation/scene/json/json_object_reader.h"

namespace arthro {

// `what`: the file in words, such as "tie points", for its message. Throws Error(kBadData).
inline void RequireObject(const nlohmann::json& json, const char* what,
                          const std::filesystem::path& file) {
  if (!json.is_object())
    throw Error(Code::kBadData, fmt::format("{} must be a JSON object {{…}}; mend the file", what),
                file);
}

// A missing schema is a fault of the reader; another one throws Error(kBadData).
inline void RequireSchema(JsonObjectReader& reader, const char* schema,
                          const std::filesystem::path& file) {
  std::string stated;
  reader.Text("schema", stated, JsonObjectReader::kRequired);
  if (stated != schema && !stated.empty())
    throw Error(Code::kBadData,
                fmt::format("its schema is \"{}\"; this program reads \"{}\"", stated, schema),
                file);
}

// A struct by its one list of fields (core/options.h). `check`: further faults and keys of the
// same file, given the reader and the value. Throws Error(kBadData) with the first fault.
template <class T, class Check>
T FromJsonFile(std::string_view text, const char* schema, const char* what,
               const std::filesystem::path& file, const Check& check) {
  const nlohmann::json json = ParseJson(text, Code::kBadData, file);
  RequireObject(json, what, file);
  std::vector<JsonFault> faults;
  JsonObjectReader reader(json, "", faults);
  RequireSchema(reader, schema, file);
  T value;
  value.Visit(FieldReader(reader));
  if (faults.empty()) check(reader, value);
  reader.RefuseOtherKeys(true);
  if (!faults.empty()) throw Error(Code::kBadData, faults.front().sentence, file);
  return value;
}

template <class T>
T FromJsonFile(std::string_view text, const char* schema, const char* what,
               const std::filesystem::path& file) {
  return FromJsonFile<T>(text, schema, what, file, [](JsonObjectReader&, T&) {});
}

}  // namespace arthro
