// Runs a job that opens a window, on an X server of its own, driven by a text script
// (app/platform/script/script.h).
#pragma once

#include <cstdlib>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/run_program.h"

// A test that needs a window says loudly when it skips.
#define ARTHRO_REQUIRE_XVFB()                                   \
  if (std::system("command -v xvfb-run > /dev/null 2>&1") != 0) \
  GTEST_SKIP() << "SKIPPED: xvfb-run is not on this machine, so no window is tested"

namespace arthro::test {

inline ProgramResult RunWindow(const std::string& arguments, const std::string& script,
                               const std::string& screen = "1280x1024x24") {
  TempFolder folder;
  const auto file = folder / "window.script";
  std::ofstream(file) << script;
  return RunProgram(arguments + " --script " + file.string(),
                    "HOME=" + folder.path().string() +
                        " LIBGL_ALWAYS_SOFTWARE=1 LP_NUM_THREADS=1 xvfb-run -a -s '-screen 0 " +
                        screen + " -noreset'");
}

}  // namespace arthro::test
