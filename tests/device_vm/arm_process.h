// A virtual arm, from the side of who tests: a process of its own that is commanded, and what it
// wrote down. s, on the clock of live devices.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/device_vm/arm_record.h"

namespace arthro::test {

constexpr double Seconds(std::int64_t ns) { return 1e-9 * static_cast<double>(ns); }

class ArmProcess {
 public:
  explicit ArmProcess(const std::string& serial);
  ~ArmProcess();  // unplugs
  ArmProcess(const ArmProcess&) = delete;
  ArmProcess& operator=(const ArmProcess&) = delete;

  // Begins it, and goes on.
  void Begin(const std::string& line);
  // Waits until it and all before it are done.
  void Do(const std::string& line);

  // Records of all events so far.
  std::vector<ArmRecord> Records();
  // When the newest of that kind was; negative: it was not.
  double TimeOf(ArmEvent event);

 private:
  std::filesystem::path log_;
  int process_ = -1, commands_ = -1, answers_ = -1, begun_ = 0, done_ = 0;
};

}  // namespace arthro::test
