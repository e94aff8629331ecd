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

template <class T>
std::string JsonFileSchema(const char* schema, const char* title, const char* description) {
  return FileSchema(schema, title, description, SchemaOfFields(T())).dump(2) + "\n";
}

}  // namespace arthro::app
