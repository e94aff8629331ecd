// Options of a session as names and numbers, as a log records them: an option that a later program
// adds or drops does not disturb the others.
#pragma once

#include <array>

#include "simulation/device/log/log_record.h"
#include "simulation/practice/session_options.h"

namespace arthro::simulation {

struct OptionNumbers {
  static constexpr int kMost = 64;
  std::array<LoggedOption, kMost> option;  // in the order of SessionOptions::Visit
  int count = 0;
};

// Allocates nothing.
OptionNumbers NumbersOf(SessionOptions options) noexcept;

// Returns false where there is no option of that name; `options` are then unchanged.
bool SetOption(const LoggedOption& option, SessionOptions& options) noexcept;

}  // namespace arthro::simulation
