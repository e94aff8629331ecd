// Runs a program beside this one, so that its crash, endless loop or hunger for memory is its own.
// Safe to call from a process with threads: between fork and exec nothing is allocated.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "simulation/core/progress.h"

namespace arthro::authoring {

struct ChildResult {
  enum class End { kExited, kSignalled, kTimedOut };
  End end = End::kExited;
  int code = 0;        // exit status, or the signal that ended it
  std::string output;  // the last of what it printed
};

// Waits for the end, `time_limit` seconds at most; past that, or when `progress` says stop, the
// child is killed. It dies with this thread. Throws Error(kCancelled) when stopped, and
// Error(kFile) when the program cannot be started.
ChildResult RunChild(const std::filesystem::path& program,
                     const std::vector<std::string>& arguments, double time_limit,
                     const Progress& progress);

}  // namespace arthro::authoring
