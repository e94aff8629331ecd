#include "tests/soak/window_process.h"

#include <fstream>
#include <stdexcept>
#include <string>

#include "tests/support/build_paths.h"

namespace arthro::test {
namespace {

constexpr int kRounds = 20000;  // rounds of all instruments, more than a soak has time for

void WriteScript(const std::filesystem::path& file) {
  std::ofstream out(file);
  out << "wait job\n";
  for (int i = 0; i < kRounds; ++i)
    for (const char* const tool : {"probe", "punch", "shaver"})
      out << "do instrument-" << tool << "\nwait frames 120\nhold C 20\nwait frames 40\n"
          << (i % 4 == 3 ? "do reset-tissues\n" : "");
}

}  // namespace

WindowProcess::WindowProcess(const std::filesystem::path& folder) {
  WriteScript(folder / "soak.script");
  server_ = std::make_unique<XServer>(folder / "xvfb.log");
  if (server_->name().empty()) throw std::runtime_error("Xvfb could not be started");
  static std::vector<std::string> environment;  // putenv keeps the pointers
  environment = {"DISPLAY=" + server_->name(), "HOME=" + folder.string(), "LIBGL_ALWAYS_SOFTWARE=1",
                 "LP_NUM_THREADS=1", "MESA_SHADER_CACHE_DISABLE=1"};
  const std::string scene = ARTHRO_SOURCE_DIR "/resources/demo";
  window_ = std::make_unique<Process>(
      std::vector<std::string>{ARTHRO_PROGRAM, "practise", scene, "--hands", "plant", "--script",
                               (folder / "soak.script").string()},
      environment, folder / "window.err");
  status_ = "/proc/" + std::to_string(window_->number()) + "/status";
}

double WindowProcess::ResidentMb() const {
  std::ifstream status(status_);
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmRSS:")) return 1.024e-3 * std::stod(line.substr(6));
  return 0;
}

bool WindowProcess::HasEnded() {
  if (exit_code_ < 0) exit_code_ = window_->Wait(0);
  return exit_code_ >= 0;
}

}  // namespace arthro::test
