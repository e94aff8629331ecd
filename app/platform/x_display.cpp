#include "app/platform/x_display.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <poll.h>
#include <sys/eventfd.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace arthro::app {
namespace {

// Xlib's handler gets no pointer of ours, hence a variable of the file.
std::function<std::string()>& Rescue() {
  static std::function<std::string()> rescue;
  return rescue;
}

constexpr const char* kNothingMore = "; start the program again on a display that works";

int EndProgram(Display*) {
  static bool is_ending = false;
  if (std::exchange(is_ending, true)) std::_Exit(1);
  // A rescue that waits for something that never comes is cut short.
  std::thread([] {
    std::this_thread::sleep_for(std::chrono::seconds(DisplayRescue::kRescueSeconds));
    std::fprintf(stderr, "arthroscene: the display was lost%s\n", kNothingMore);
    std::_Exit(1);
  }).detach();
  std::string outcome = kNothingMore;
  try {
    if (const auto rescue = std::exchange(Rescue(), {})) outcome = rescue();
  } catch (const std::exception& error) {
    outcome = std::string("; ") + error.what();
  }
  std::fprintf(stderr, "arthroscene: the display was lost%s\n", outcome.c_str());
  std::fflush(nullptr);
  // Xlib does not let the program go on, and destructors would use the display.
  std::_Exit(1);
}

int PassOver(Display*, XErrorEvent*) { return 0; }

// The window that the property of `window` names; 0: none.
::Window NamedBy(Display* display, ::Window window, Atom property) {
  Atom type = 0;
  int format = 0;
  unsigned long count = 0, left = 0;
  unsigned char* bytes = nullptr;
  const int status = XGetWindowProperty(display, window, property, 0, 1, False, XA_WINDOW, &type,
                                        &format, &count, &left, &bytes);
  ::Window named = 0;
  if (status == Success && type == XA_WINDOW && format == 32 && count == 1)
    named = *reinterpret_cast<::Window*>(bytes);
  if (bytes != nullptr) XFree(bytes);
  return named;
}

}  // namespace

std::shared_ptr<void> RemoveStaleWindowManagerMark() {
  XInitThreads();  // before any other call of Xlib; GLFW's threads rely on it
  Display* display = XOpenDisplay(nullptr);
  if (display == nullptr) return nullptr;
  const auto previous = XSetErrorHandler(PassOver);
  const Atom mark = XInternAtom(display, "_NET_SUPPORTING_WM_CHECK", False);
  const ::Window root = DefaultRootWindow(display);
  // No window manager may start between the look and the removal.
  XGrabServer(display);
  if (const ::Window named = NamedBy(display, root, mark);
      named != 0 && NamedBy(display, named, mark) == 0)
    XDeleteProperty(display, root, mark);
  XUngrabServer(display);
  XSync(display, False);
  XSetErrorHandler(previous);
  return {display, [](void* open) { XCloseDisplay(static_cast<Display*>(open)); }};
}

void EndWhenDisplayIsLost() { XSetIOErrorHandler(EndProgram); }

DisplayRescue::DisplayRescue(std::function<std::string()> rescue) { Rescue() = std::move(rescue); }

DisplayRescue::~DisplayRescue() { Rescue() = {}; }

DisplayWatch::DisplayWatch(std::function<void()> lost) {
  Display* display = XOpenDisplay(nullptr);
  stop_ = ::eventfd(0, EFD_CLOEXEC);
  connection_ = display;
  if (display == nullptr || stop_ < 0) return;
  thread_ = std::thread([this, lost = std::move(lost), server = ConnectionNumber(display)] {
    std::array<pollfd, 2> waits{{{server, POLLRDHUP, 0}, {stop_, POLLIN, 0}}};
    while (::poll(waits.data(), waits.size(), -1) < 0)
      if (errno != EINTR) return;
    if (waits[0].revents == 0) return;
    is_lost_ = true;
    lost();
  });
}

DisplayWatch::~DisplayWatch() {
  if (thread_.joinable()) {
    ::eventfd_write(stop_, 1);
    thread_.join();
  }
  if (stop_ >= 0) ::close(stop_);
  // Xlib would end the program instead of closing a connection that is lost.
  if (connection_ != nullptr && !is_lost_) XCloseDisplay(static_cast<Display*>(connection_));
}

}  // namespace arthro::app
