// Options to and from JSON, by their one list of fields (options.h). Unknown keys, wrong types and
// values outside the range are refused with the key, what it may be, and the file.
#pragma once

#include <filesystem>
#include <vector>

#include <nlohmann/json.hpp>

#include "simulation/core/option_fields.h"

namespace arthro {
namespace internal {

nlohmann::json JsonFromFields(const std::vector<OptionField>& fields);
void ReadFields(const nlohmann::json& json, const std::filesystem::path& file,
                const std::vector<OptionField>& fields);

}  // namespace internal

template <class Options>
nlohmann::json JsonFromOptions(Options options) {
  return internal::JsonFromFields(internal::ListFields(options));
}

// Fields that `json` does not name keep their value.
template <class Options>
void ReadOptions(const nlohmann::json& json, const std::filesystem::path& file, Options& options) {
  internal::ReadFields(json, file, internal::ListFields(options));
}

// Fields that `json` does not name have the value of `defaults`.
template <class Options>
Options OptionsFromJson(const nlohmann::json& json, const std::filesystem::path& file = {},
                        Options defaults = {}) {
  ReadOptions(json, file, defaults);
  return defaults;
}

}  // namespace arthro
