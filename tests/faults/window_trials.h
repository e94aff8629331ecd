// Disturbs the editor and the practice, each in a window of its own X server, and looks at what
// they leave: the scene opens and holds the edits but those of the last seconds, log and film can
// be read, a hand on the device gets no force, and the next start leaves nothing behind.
#pragma once

#include <functional>

#include "tests/faults/trial.h"
#include "tests/hostile/samples.h"

namespace arthro::test {

struct WindowLimits {
  double most_lost = 2;          // s; edits older than this must not be lost
  double longest_force_ms = 25;  // from a fault to the last force
};

class WindowTrials {
 public:
  static constexpr const char* kEdit = "edit";
  static constexpr const char* kPractise = "practise";
  static bool IsPossible();  // Xvfb is installed
  static std::vector<Fault> FaultsOf(const std::string& window);

  WindowTrials(const Samples& samples, const MappedFaultPage& page, const WindowLimits& limits);

  Trial Edit(Fault fault, double moment, double strength);
  Trial Practise(Fault fault, double moment, double strength);

 private:
  struct Window {
    std::vector<std::string> arguments;
    std::function<bool()> begins;
    bool has_arm = false;
  };
  // Folder of the recovery copies.
  std::filesystem::path Copies() const { return state_ / "recovery"; }
  ChildCommand CommandOf(const std::vector<std::string>& arguments,
                         const std::string& display) const;
  ChildRun Disturb(const Window& window, Disturbance& disturbance, Trial& trial) const;
  void LookAtEdits(const Disturbance& disturbance, Trial& trial) const;
  void LookAtForces(const Disturbance& disturbance, Trial& trial) const;
  void LookAtNextStart(const std::vector<std::string>& arguments, Trial& trial) const;

  const Samples& samples_;
  const MappedFaultPage& page_;
  WindowLimits limits_;
  std::filesystem::path shots_, state_;
};

}  // namespace arthro::test
