// A program that dies of its own fault lets go of its devices first: while this lives, SIGSEGV,
// SIGBUS, SIGFPE, SIGILL and SIGABRT (std::terminate with it) make who writes to them say zero,
// then do what they did before; so does exit, which Xlib calls where it loses its screen. Where the
// writer itself is what died the firmware's watchdog is left, as it is when the system goes down.
#pragma once

#include <memory>
#include <vector>

#include "simulation/device/releasable.h"

namespace arthro::simulation {

class ReleaseOnCrash {
 public:
  // One at a time, since a signal handler can reach nothing but what is the process's own.
  explicit ReleaseOnCrash(std::vector<std::shared_ptr<Releasable>> devices);
  ~ReleaseOnCrash();
  ReleaseOnCrash(const ReleaseOnCrash&) = delete;
  ReleaseOnCrash& operator=(const ReleaseOnCrash&) = delete;

  static constexpr int kMost = 4;  // two roles and pedals, and one to spare

 private:
  std::vector<std::shared_ptr<Releasable>> devices_;
};

}  // namespace arthro::simulation
