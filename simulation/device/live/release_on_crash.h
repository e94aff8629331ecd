// Tells devices to let go before a signal ends the program. While this lives, every signal whose
// default action ends a process makes the devices' writers send zero force. Then the signal acts as
// it did before: the process ends, with a core file where the signal leaves one.
// Faults (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGSYS) are always handled, stack
// overflow included in threads that have a CrashStack. Other signals are left alone where the
// program ignores or handles them. exit() releases too, which Xlib calls when it loses its display.
// SIGKILL, SIGSTOP and a fault of the writer itself are left to the firmware's watchdog.
#pragma once

#include <memory>
#include <vector>

#include "simulation/core/crash_stack.h"
#include "simulation/device/releasable.h"

namespace arthro::simulation {

class ReleaseOnCrash {
 public:
  // Only one may exist at a time, since a signal handler can access only data of the process. The
  // thread that makes it gets a CrashStack.
  explicit ReleaseOnCrash(std::vector<std::shared_ptr<Releasable>> devices);
  ~ReleaseOnCrash();
  ReleaseOnCrash(const ReleaseOnCrash&) = delete;
  ReleaseOnCrash& operator=(const ReleaseOnCrash&) = delete;

  static constexpr int kMost = 4;  // devices: two roles, pedals, and one spare

 private:
  CrashStack stack_;
  std::vector<std::shared_ptr<Releasable>> devices_;
};

}  // namespace arthro::simulation
