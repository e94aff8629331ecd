// Numbers as the tables of benchmarks print them.
#pragma once

#include <cmath>
#include <string>

#include <fmt/format.h>

namespace arthro::app {

inline constexpr double kMilli = 1e3;  // ms per s, mm per m, mJ per J

// "-" for what was not measured.
inline std::string TableNumber(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "-";
}

}  // namespace arthro::app
