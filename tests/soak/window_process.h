// A practice in a window of its own X server beside the soak, driven by a script, and the memory
// that it holds.
#pragma once

#include <filesystem>
#include <memory>

#include "tests/support/own_display.h"

namespace arthro::test {

class WindowProcess {
 public:
  explicit WindowProcess(const std::filesystem::path& folder);
  double ResidentMb() const;  // 0: it does not run
  bool HasEnded();
  int exit_code() const { return exit_code_; }

 private:
  std::filesystem::path status_;
  std::unique_ptr<XServer> server_;
  std::unique_ptr<Process> window_;
  int exit_code_ = -1;
};

}  // namespace arthro::test
