// JSON text as values. What is wrong with it is told in one sentence with its line.
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "simulation/core/error.h"

namespace arthro {

// Throws Error(code): no JSON, a number that is larger than any, a key that comes twice in one
// object (JSON lets the last one win; whoever wrote it meant something else).
nlohmann::json ParseJson(const std::string& text, Code code, const std::filesystem::path& file);

}  // namespace arthro
