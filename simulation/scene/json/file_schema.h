// The head of a JSON file of ours: an object whose `schema` names what the file is.
#pragma once

#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulation/core/error.h"
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

}  // namespace arthro
