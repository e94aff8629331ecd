// Duties that Xlib and GLFW 3.3 leave to the program: a window manager's mark that outlived it, and
// an X server that goes away while the window is open.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>

namespace arthro::app {

// GLFW 3.3.8 aborts where the root window's _NET_SUPPORTING_WM_CHECK names a window that is gone or
// lacks the property itself, which a killed window manager leaves behind [EWMH 1.5, Root Window
// Properties]. Removes such a mark. Call before glfwInit; does nothing where there is no display.
// The connection that it returns must stay open until glfwInit has its own: an X server whose last
// client leaves starts anew, and refuses connections meanwhile.
std::shared_ptr<void> RemoveStaleWindowManagerMark();

// From here on a lost X server ends the program with one sentence and exit code 1.
void EndWhenDisplayIsLost();

// While it lives, `rescue` is run before that end, in the thread that found the display lost. It
// may use neither the window nor OpenGL, and is given kRescueSeconds. What it returns ends the
// sentence:
// "; the unsaved work is offered at the next start". One at a time.
class DisplayRescue {
 public:
  static constexpr int kRescueSeconds = 20;

  explicit DisplayRescue(std::function<std::string()> rescue);
  ~DisplayRescue();
  DisplayRescue(const DisplayRescue&) = delete;
  DisplayRescue& operator=(const DisplayRescue&) = delete;
};

// Calls `lost` in a thread of its own at the moment at which the X server hangs up. The thread of
// the window learns it with its next request, which may be many frames later. Does nothing where
// there is no display.
class DisplayWatch {
 public:
  explicit DisplayWatch(std::function<void()> lost);
  ~DisplayWatch();
  DisplayWatch(const DisplayWatch&) = delete;
  DisplayWatch& operator=(const DisplayWatch&) = delete;

 private:
  void* connection_ = nullptr;  // its own, on which nothing is asked
  int stop_ = -1;               // eventfd
  std::atomic<bool> is_lost_{false};
  std::thread thread_;
};

}  // namespace arthro::app
