// An OpenGL context with no window and no display: a surfaceless EGL context, in software where the
// machine has no graphics card. Pictures made in it have the same bytes run to run.
#pragma once

#include <string>

namespace arthro::app {

class OffscreenContext {
 public:
  // Makes the context and makes it current in this thread. Throws Error(kDisplay) where the machine
  // has no EGL or one that cannot give OpenGL 3.2 core.
  OffscreenContext();
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  void MakeCurrent() const;
  // What draws, e.g. "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5": for benchmarks and reports.
  const std::string& description() const { return description_; }

 private:
  // EGL's handles; void* as in <EGL/egl.h>, which would bring X11's macros to every includer.
  void* display_ = nullptr;
  void* context_ = nullptr;
  void* surface_ = nullptr;  // only where the driver cannot do without one
  std::string description_;
};

}  // namespace arthro::app
