// OpenGL context without window and display: a surfaceless EGL context, in software when the
// machine has no graphics card. Pictures drawn in it have the same bytes in every run.
#pragma once

#include <string>

namespace arthro::app {

class OffscreenContext {
 public:
  // Makes the context, current in this thread. Throws Error(kDisplay) when the machine has no EGL,
  // or one without OpenGL 3.2 core.
  OffscreenContext();
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  void MakeCurrent() const;
  // Name of the renderer, such as "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5", for reports.
  const std::string& description() const { return description_; }

 private:
  // Handles of EGL; void* as in <EGL/egl.h>, which would bring X11's macros to every includer.
  void* display_ = nullptr;
  void* context_ = nullptr;
  void* surface_ = nullptr;  // only when the driver needs one
  std::string description_;
};

}  // namespace arthro::app
