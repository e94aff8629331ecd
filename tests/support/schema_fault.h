// Validates a JSON text against a JSON Schema of resources/schemas by a validator that is not ours.
#pragma once

#include <filesystem>
#include <rapidjson/document.h>
#include <rapidjson/schema.h>
#include <rapidjson/stringbuffer.h>
#include <string>

#include "simulation/core/atomic_file.h"
#include "tests/support/build_paths.h"

namespace arthro::test {

// "" for a valid text, otherwise the place and the rule. `schema` is a name such as "relief-1".
inline std::string SchemaFault(const std::string& schema, const std::string& json) {
  rapidjson::Document schema_text, text;
  schema_text.Parse(ReadWholeFile(std::filesystem::path(ARTHRO_SOURCE_DIR) / "resources/schemas" /
                                  (schema + ".schema.json"))
                        .c_str());
  if (schema_text.HasParseError()) return "the schema is not JSON";
  const rapidjson::SchemaDocument rules(schema_text);
  text.Parse(json.c_str());
  if (text.HasParseError()) return "not JSON";
  rapidjson::SchemaValidator validator(rules);
  if (text.Accept(validator)) return "";
  rapidjson::StringBuffer place;
  validator.GetInvalidDocumentPointer().StringifyUriFragment(place);
  return std::string(place.GetString()) + " " + validator.GetInvalidSchemaKeyword();
}

}  // namespace arthro::test
