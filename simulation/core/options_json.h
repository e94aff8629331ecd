// Options to and from JSON, by their one list of fields (options.h). Unknown keys, wrong types and
// values outside the range are refused with the key, what it may be, and the file.
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulation/core/error.h"
#include "simulation/core/options.h"

namespace arthro {
namespace internal {

inline std::string JoinWords(const auto& words) {
  std::string joined;
  for (const auto& [value, word] : words)
    joined += (joined.empty() ? "" : ", ") + std::string(word);
  return joined;
}

// `factor`: from the unit in memory to the one that is shown.
inline std::string ToString(const Range& range, double factor) {
  return fmt::format("{} {} and {}{}", range.above_min ? "more than" : "between",
                     range.min * factor, range.above_min ? "at most " : "", range.max * factor);
}

struct JsonWriter {
  nlohmann::json& json;

  template <class T, class R>
  void operator()(const char* name, T& field, const R& range, const char* unit, const char*) {
    const Border border = FileBorder(unit);
    const std::string key = std::string(name) + border.suffix;
    if constexpr (std::is_enum_v<T>) {
      for (const auto& [value, word] : range.words)
        if (value == field) json[key] = word;
    } else if constexpr (std::is_same_v<T, double>) {
      json[key] = field * border.factor;
    } else {
      json[key] = field;
    }
  }
};

struct JsonReader {
  const nlohmann::json& json;
  const std::filesystem::path& file;
  std::set<std::string> known = {};

  template <class T, class R>
  void operator()(const char* name, T& field, const R& range, const char* unit, const char*) {
    const Border border = FileBorder(unit);
    const std::string key = std::string(name) + border.suffix;
    known.insert(key);
    const auto entry = json.find(key);
    if (entry == json.end()) return;
    if constexpr (std::is_enum_v<T>) {
      for (const auto& [value, word] : range.words)
        if (*entry == word) return void(field = value);
      Refuse(key, "one of " + JoinWords(range.words));
    } else if constexpr (std::is_same_v<T, bool>) {
      if (!entry->is_boolean()) Refuse(key, "true or false");
      field = entry->template get<bool>();
    } else if constexpr (std::is_arithmetic_v<T>) {
      const bool whole = std::is_same_v<T, double> || entry->is_number_integer();
      if (!entry->is_number() || !whole)
        Refuse(key, std::is_same_v<T, double> ? "a number" : "a whole number");
      const double value = entry->template get<double>() / border.factor;
      if constexpr (std::is_same_v<R, Range>)
        if (!Contains(range, value)) Refuse(key, ToString(range, border.factor));
      field = static_cast<T>(value);
    } else {
      if (!entry->is_string()) Refuse(key, "text");
      field = entry->template get<T>();
    }
  }

  [[noreturn]] void Refuse(const std::string& key, const std::string& wanted) const {
    throw Error(Code::kBadData,
                fmt::format("option \"{}\" is {}; it must be {}", key, json.at(key).dump(), wanted),
                file);
  }
};

struct RangeChecker {
  template <class T, class R>
  void operator()(const char* name, T& field, const R& range, const char* unit, const char*) {
    if constexpr (std::is_arithmetic_v<T> && std::is_same_v<R, Range>) {
      if (Contains(range, static_cast<double>(field))) return;
      const Border border = PersonBorder(unit);
      throw Error(
          Code::kBadArgument,
          fmt::format("option {}{} is {}; it must be {}", name, border.suffix,
                      static_cast<double>(field) * border.factor, ToString(range, border.factor)));
    }
  }
};

}  // namespace internal

template <class Options>
nlohmann::json JsonFromOptions(Options options) {
  nlohmann::json json = nlohmann::json::object();
  internal::JsonWriter writer{json};
  options.Visit(writer);
  return json;
}

// Fields that `json` does not name keep their value.
template <class Options>
void ReadOptions(const nlohmann::json& json, const std::filesystem::path& file, Options& options) {
  if (!json.is_object()) throw Error(Code::kBadData, "options must be a JSON object {…}", file);
  internal::JsonReader reader{json, file};
  options.Visit(reader);
  for (const auto& [key, value] : json.items())
    if (!reader.known.contains(key) && key != "schema")
      throw Error(Code::kBadData,
                  fmt::format("option \"{}\" is not known; see --help for the list", key), file);
}

// Fields that `json` does not name have the value of `defaults`.
template <class Options>
Options OptionsFromJson(const nlohmann::json& json, const std::filesystem::path& file = {},
                        Options defaults = {}) {
  ReadOptions(json, file, defaults);
  return defaults;
}

template <class Options>
void CheckOptions(const Options& options) {
  Options copy = options;
  internal::RangeChecker checker;
  copy.Visit(checker);
}

}  // namespace arthro
