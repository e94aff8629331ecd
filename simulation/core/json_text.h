// JSON text as values: the only JSON parser of the program. A fault is one sentence with its line.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "simulation/core/error.h"

namespace arthro {

// Copies, prints and comparisons of values recurse, so depth is limited before a value is built.
inline constexpr int kDeepestJson = 64;

// Throws Error(code): not JSON, nested deeper than kDeepestJson, a number beyond a double, a key
// that comes twice in one object (JSON lets the last one win; whoever wrote it meant something
// else).
nlohmann::json ParseJson(std::string_view text, Code code, const std::filesystem::path& file = {});

// The same, with the keys in the order of the text.
nlohmann::ordered_json ParseOrderedJson(std::string_view text, Code code,
                                        const std::filesystem::path& file = {});

// Line, from 1, of a key such as "tissues[2].pose.scale" in a text that ParseJson accepts. A key
// that is not there has the line of the innermost value on its path that is.
int LineOfKey(std::string_view text, std::string_view key);

}  // namespace arthro
