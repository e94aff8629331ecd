// Bytes deflated by zlib behind their size, and back.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace arthro::simulation {

std::string Deflated(std::string_view raw);
// Returns nothing for bytes that are none of Deflated.
std::optional<std::string> Inflated(std::string_view bytes);

}  // namespace arthro::simulation
