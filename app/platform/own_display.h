// A display without a monitor, for windows that nobody is to see: Xvfb, started for this program
// and ended with it.
#pragma once

#include <sys/types.h>

namespace arthro::app {

class OwnDisplay {
 public:
  // Starts Xvfb and points DISPLAY at it, before any thread is started. Throws Error(kDisplay)
  // where it is not installed or does not start.
  OwnDisplay(int width, int height);
  ~OwnDisplay();
  OwnDisplay(const OwnDisplay&) = delete;
  OwnDisplay& operator=(const OwnDisplay&) = delete;

 private:
  pid_t process_ = -1;
};

// DISPLAY or WAYLAND_DISPLAY names one.
bool HasDisplay();

}  // namespace arthro::app
