// Minutes and seconds as a clock shows them.
#pragma once

#include <string>

#include <fmt/format.h>

namespace arthro::app {

// 75.9 s is 01:15.
inline std::string ClockWords(double seconds) {
  const int whole = static_cast<int>(seconds);
  return fmt::format("{:02}:{:02}", whole / 60, whole % 60);
}

}  // namespace arthro::app
