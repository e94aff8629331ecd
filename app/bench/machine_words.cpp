#include "app/bench/machine_words.h"

#include <fstream>
#include <thread>

#include <fmt/format.h>

namespace arthro::app {

std::string MachineWords() {
  std::string processor = "unknown processor";
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) {
      processor = line.substr(line.find(':') + 2);
      break;
    }
  return fmt::format("{}, {} cores, {}, gcc {}", processor, std::thread::hardware_concurrency(),
                     ARTHRO_BUILD_TYPE, __VERSION__);
}

}  // namespace arthro::app
