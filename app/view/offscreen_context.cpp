#include "app/view/offscreen_context.h"

#include <array>
#include <cstring>
#include <string_view>
#include <vector>

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "simulation/core/error.h"

namespace arthro::app {
namespace {

template <class F>
F Function(const char* name) {
  return reinterpret_cast<F>(eglGetProcAddress(name));
}

bool Has(const char* extensions, std::string_view name) {
  return extensions && std::string_view(extensions).find(name) != std::string_view::npos;
}

// Displays that need no screen, the most reliable first: Mesa without a surface, then each device
// (for proprietary drivers), then EGL's default.
std::vector<EGLDisplay> ScreenlessDisplays() {
  std::vector<EGLDisplay> displays;
  const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const auto get = Function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  if (get && Has(client, "EGL_MESA_platform_surfaceless"))
    displays.push_back(get(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  const auto devices = Function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  if (get && devices && Has(client, "EGL_EXT_platform_device")) {
    std::array<EGLDeviceEXT, 16> list{};
    EGLint count = 0;
    if (devices(static_cast<EGLint>(list.size()), list.data(), &count))
      for (EGLint i = 0; i < count; ++i)
        displays.push_back(
            get(EGL_PLATFORM_DEVICE_EXT, list[static_cast<std::size_t>(i)], nullptr));
  }
  displays.push_back(eglGetDisplay(EGL_DEFAULT_DISPLAY));
  return displays;
}

struct Attempt {
  EGLContext context = EGL_NO_CONTEXT;
  EGLSurface surface = EGL_NO_SURFACE;
};

// Returns a current OpenGL 3.2 core context on an initialised display, or an empty attempt.
Attempt MakeContext(EGLDisplay display) {
  if (!eglBindAPI(EGL_OPENGL_API)) return {};
  const bool surfaceless =
      Has(eglQueryString(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context");
  const EGLint wanted[] = {EGL_SURFACE_TYPE,
                           surfaceless ? EGL_DONT_CARE : EGL_PBUFFER_BIT,
                           EGL_RENDERABLE_TYPE,
                           EGL_OPENGL_BIT,
                           EGL_RED_SIZE,
                           8,
                           EGL_GREEN_SIZE,
                           8,
                           EGL_BLUE_SIZE,
                           8,
                           EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglChooseConfig(display, wanted, &config, 1, &count) || count < 1) return {};
  const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION,
                            3,
                            EGL_CONTEXT_MINOR_VERSION,
                            2,
                            EGL_CONTEXT_OPENGL_PROFILE_MASK,
                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                            EGL_NONE};
  Attempt attempt;
  attempt.context = eglCreateContext(display, config, EGL_NO_CONTEXT, version);
  if (attempt.context == EGL_NO_CONTEXT) return {};
  if (!surfaceless) {
    const EGLint size[] = {EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
    attempt.surface = eglCreatePbufferSurface(display, config, size);
  }
  if (eglMakeCurrent(display, attempt.surface, attempt.surface, attempt.context)) return attempt;
  if (attempt.surface != EGL_NO_SURFACE) eglDestroySurface(display, attempt.surface);
  eglDestroyContext(display, attempt.context);
  return {};
}

std::string DescribeCurrent() {
  // Calls glGetString through EGL, so that this file needs no OpenGL loader.
  using GetString = const unsigned char* (*)(unsigned int);
  const auto get = Function<GetString>("glGetString");
  constexpr unsigned int kRenderer = 0x1F01, kVersion = 0x1F02;
  const auto text = [&](unsigned int name) {
    const auto* value = get ? get(name) : nullptr;
    return std::string(value ? reinterpret_cast<const char*>(value) : "unknown");
  };
  return text(kRenderer) + ", OpenGL " + text(kVersion);
}

}  // namespace

OffscreenContext::OffscreenContext() {
  for (EGLDisplay display : ScreenlessDisplays()) {
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) continue;
    const Attempt attempt = MakeContext(display);
    if (attempt.context == EGL_NO_CONTEXT) {
      eglTerminate(display);
      continue;
    }
    display_ = display;
    context_ = attempt.context;
    surface_ = attempt.surface;
    description_ = DescribeCurrent();
    return;
  }
  throw Error(Code::kDisplay,
              "no picture can be drawn: this machine offers no OpenGL 3.2 through EGL; install "
              "Mesa's software renderer (Debian: libegl-mesa0 and libgl1-mesa-dri)");
}

OffscreenContext::~OffscreenContext() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  if (surface_ != EGL_NO_SURFACE) eglDestroySurface(display_, surface_);
  eglDestroyContext(display_, context_);
  eglTerminate(display_);
}

void OffscreenContext::MakeCurrent() const {
  eglMakeCurrent(display_, surface_, surface_, context_);
}

}  // namespace arthro::app
