#include "app/platform/picture_window.h"

#include <algorithm>
#include <vector>

#define GLFW_INCLUDE_NONE
#include <GL/gl.h>
#include <GL/glext.h>
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include "app/platform/window.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

constexpr int kWidth = 960, kHeight = 720;  // px, where it is not over a whole monitor

// GL functions that <GL/gl.h> does not declare, of the current context.
struct Calls {
  PFNGLGENFRAMEBUFFERSPROC gen_framebuffers;
  PFNGLDELETEFRAMEBUFFERSPROC delete_framebuffers;
  PFNGLBINDFRAMEBUFFERPROC bind_framebuffer;
  PFNGLFRAMEBUFFERTEXTURE2DPROC attach;
  PFNGLBLITFRAMEBUFFERPROC blit;
  PFNGLFENCESYNCPROC fence;
  PFNGLWAITSYNCPROC wait;
  PFNGLDELETESYNCPROC delete_sync;
};

template <class F>
void Load(F& function, const char* name) {
  function = reinterpret_cast<F>(glfwGetProcAddress(name));
}

const Calls& Gl() {
  static const Calls calls = [] {
    Calls c;
    Load(c.gen_framebuffers, "glGenFramebuffers");
    Load(c.delete_framebuffers, "glDeleteFramebuffers");
    Load(c.bind_framebuffer, "glBindFramebuffer");
    Load(c.attach, "glFramebufferTexture2D");
    Load(c.blit, "glBlitFramebuffer");
    Load(c.fence, "glFenceSync");
    Load(c.wait, "glWaitSync");
    Load(c.delete_sync, "glDeleteSync");
    return c;
  }();
  return calls;
}

// Monitor of the window's middle; the first one where it lies on none.
int MonitorOf(GLFWwindow* window, const std::vector<GLFWmonitor*>& monitors) {
  int x = 0, y = 0, width = 0, height = 0;
  glfwGetWindowPos(window, &x, &y);
  glfwGetWindowSize(window, &width, &height);
  x += width / 2, y += height / 2;
  for (std::size_t i = 0; i < monitors.size(); ++i) {
    int left = 0, top = 0;
    glfwGetMonitorPos(monitors[i], &left, &top);
    const GLFWvidmode* mode = glfwGetVideoMode(monitors[i]);
    if (mode != nullptr && x >= left && x < left + mode->width && y >= top &&
        y < top + mode->height)
      return static_cast<int>(i);
  }
  return 0;
}

}  // namespace

struct PictureWindowCallbacks {
  static PictureWindow& Of(GLFWwindow* window) {
    return *static_cast<PictureWindow*>(glfwGetWindowUserPointer(window));
  }
  static void Refresh(GLFWwindow* window) { Of(window).is_damaged_ = true; }
  // Keys belong to the first window: one over a whole monitor has no use for them.
  static void Focus(GLFWwindow* window, int focused) {
    if (focused && Of(window).is_full_) glfwFocusWindow(Of(window).beside_);
  }
  // A window that was clicked has the keys; those that close it must not go nowhere.
  static void Key(GLFWwindow* window, int key, int, int action, int) {
    if (action == GLFW_PRESS && (key == GLFW_KEY_ESCAPE || key == GLFW_KEY_F12))
      glfwSetWindowShouldClose(window, GLFW_TRUE);
  }
};

PictureWindow::PictureWindow(Window& beside, const std::string& title, int monitor, bool is_visible)
    : beside_(beside.handle()) {
  int count = 0;
  GLFWmonitor** all = glfwGetMonitors(&count);
  const std::vector<GLFWmonitor*> monitors(all, all + count);
  const int own = MonitorOf(beside_, monitors);
  GLFWmonitor* chosen = nullptr;
  if (monitor == 0) {
    for (int i = 0; i < count && chosen == nullptr; ++i)
      if (i != own) chosen = monitors[static_cast<std::size_t>(i)];
    if (chosen == nullptr)
      notice_ = "There is one monitor; the trainee's screen is a window that can be moved.";
  } else if (monitor <= count && monitor - 1 != own) {
    chosen = monitors[static_cast<std::size_t>(monitor - 1)];
  } else {
    notice_ = monitor > count
                  ? fmt::format(
                        "There is no monitor {}; the trainee's screen is a window that can "
                        "be moved.",
                        monitor)
                  : fmt::format(
                        "Monitor {} is this one; the trainee's screen is a window that can "
                        "be moved.",
                        monitor);
  }
  const GLFWvidmode* mode = chosen != nullptr ? glfwGetVideoMode(chosen) : nullptr;
  is_full_ = mode != nullptr;

  glfwWindowHint(GLFW_VISIBLE, is_visible ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_FOCUSED, GLFW_FALSE);
  glfwWindowHint(GLFW_FOCUS_ON_SHOW, GLFW_FALSE);
  glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);  // it stays when the other one is used
  if (is_full_) glfwWindowHint(GLFW_REFRESH_RATE, mode->refreshRate);
  window_ = glfwCreateWindow(is_full_ ? mode->width : kWidth, is_full_ ? mode->height : kHeight,
                             title.c_str(), is_full_ ? chosen : nullptr, beside_);
  if (window_ == nullptr)
    throw Error(Code::kDisplay,
                "the trainee's screen could not be opened: the display gives no second window");
  glfwSetInputMode(window_, GLFW_CURSOR, GLFW_CURSOR_HIDDEN);
  glfwSetWindowUserPointer(window_, this);
  glfwSetWindowRefreshCallback(window_, PictureWindowCallbacks::Refresh);
  glfwSetWindowFocusCallback(window_, PictureWindowCallbacks::Focus);
  glfwSetKeyCallback(window_, PictureWindowCallbacks::Key);
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(0);
  Gl().gen_framebuffers(1, &framebuffer_);
  glfwMakeContextCurrent(beside_);
}

PictureWindow::~PictureWindow() {
  glfwMakeContextCurrent(window_);
  Gl().delete_framebuffers(1, &framebuffer_);
  glfwMakeContextCurrent(beside_);
  glfwDestroyWindow(window_);
}

bool PictureWindow::IsLost() const {
  return glfwWindowShouldClose(window_) || (is_full_ && glfwGetWindowMonitor(window_) == nullptr);
}

bool PictureWindow::Show(unsigned texture, int edge, long version, FrameShape shape) {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  const bool is_same = version == shown_ && width == width_ && height == height_ && !is_damaged_;
  if (is_same || width <= 0 || height <= 0) return false;
  shown_ = version, width_ = width, height_ = height;
  texture_ = texture, edge_ = edge, shape_ = shape;
  is_damaged_ = false;
  // The first context must finish drawing before the second one reads.
  const GLsync drawn = Gl().fence(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  glFlush();
  glfwMakeContextCurrent(window_);
  Gl().wait(drawn, 0, GL_TIMEOUT_IGNORED);
  Draw();
  glfwSwapBuffers(window_);
  glfwMakeContextCurrent(beside_);
  Gl().delete_sync(drawn);
  return true;
}

void PictureWindow::Draw() {
  Gl().bind_framebuffer(GL_FRAMEBUFFER, 0);
  glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  if (texture_ == 0) return;
  const ScreenPlace place = PlaceOnScreen(shape_, width_, height_);
  const int bottom = height_ - place.y - place.edge;
  Gl().bind_framebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  Gl().attach(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
  Gl().blit(0, 0, edge_, edge_, place.x, bottom, place.x + place.edge, bottom + place.edge,
            GL_COLOR_BUFFER_BIT, GL_LINEAR);
  // The texture may be deleted by its owner.
  Gl().attach(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
}

ColourImage PictureWindow::ReadPicture() {
  ColourImage upside_down(width_, height_), picture(width_, height_);
  if (picture.empty()) return picture;
  glfwMakeContextCurrent(window_);
  Draw();
  Gl().bind_framebuffer(GL_FRAMEBUFFER, 0);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE, upside_down.rgb.data());
  glfwMakeContextCurrent(beside_);
  for (int y = 0; y < height_; ++y)
    std::copy_n(upside_down.at(0, height_ - 1 - y), 3 * width_, picture.at(0, y));
  return picture;
}

}  // namespace arthro::app
