// Runs a program in a process of its own, so that its crash, endless loop or use of memory cannot
// harm this one. Safe to call from a process with threads: nothing is allocated between fork and
// exec.
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
  std::string output;  // end of its output
};

// Waits for the end, for `time_limit` seconds at most; past that, or when `progress` asks to stop,
// the child is killed. It dies with this thread. Throws Error(kCancelled) when stopped, and
// Error(kFile) when the program cannot be started.
ChildResult RunChild(const std::filesystem::path& program,
                     const std::vector<std::string>& arguments, double time_limit,
                     const Progress& progress);

}  // namespace arthro::authoring
