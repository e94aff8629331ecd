// Times in UTC as text with milliseconds, 2026-11-23T20:30:00.000Z, and as ms since 1970.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace arthro::app {

std::string UtcText(std::int64_t ms);
// Returns nothing for a text of another form.
std::optional<std::int64_t> MillisecondsOf(const std::string& utc);
std::string UtcNow();

}  // namespace arthro::app
