// The one window: GLFW for the window and its OpenGL 3.2 context, Dear ImGui 1.86 fed by hand from
// the input queue (input_queue.h), its OpenGL 3 backend for drawing. The order of one frame:
//   WaitEvents → BeginFrame (queue → ImGui) → panels → pictures → EndFrame (draw) → Present
// Sizes and pointer positions are window coordinates; `scale` is the content scale (2 on a screen
// of twice the usual density), by which every pixel constant of ours is multiplied.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/platform/input_queue.h"
#include "app/platform/monitor_size.h"
#include "app/platform/theme.h"
#include "simulation/scene/image.h"

struct GLFWcursor;
struct GLFWwindow;

namespace arthro::app {

struct WindowOptions {
  std::string title = "Arthroscene";
  int width = 1280, height = 800;  // at scale 1
  bool visible = true;
  std::optional<double> scale;  // instead of the screen's
  Theme theme = Theme::kDark;
  std::optional<double> fixed_step;  // s; frames then take this long for ImGui, whatever the clock
};

// Events that BeginFrame took and ImGui has no place for.
struct FrameNews {
  std::vector<std::filesystem::path> dropped;
  bool close_requested = false;
};

class Window {
 public:
  // Throws Error(kDisplay) when there is no display or its OpenGL is older than 3.2.
  explicit Window(const WindowOptions& options);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  // Sleeps until something happens, at most `seconds`; 0 only looks.
  void WaitEvents(double seconds);
  // Callable from any thread: ends a WaitEvents.
  static void WakeUp();

  FrameNews BeginFrame();
  void EndFrame();  // draws ImGui's lists over a cleared window
  void Present();   // swaps

  // The frame that EndFrame drew; call before Present.
  ColourImage ReadPicture() const;

  InputQueue& input() { return input_; }
  bool AnythingHeld() const;  // a key or button is down, so time matters
  double scale() const { return scale_; }
  int width() const { return width_; }
  int height() const { return height_; }
  GLFWwindow* handle() const { return window_; }  // for windows beside it
  const Fonts& fonts() const { return fonts_; }
  void SetTitle(const std::string& title);
  // Takes effect with the next frame. Without a scale the monitor's.
  void SetLook(std::optional<double> scale, Theme theme);
  MonitorSize monitor() const;  // the monitor of the window, or the primary one
  void SetFullScreen(bool full);

 private:
  friend struct WindowCallbacks;
  void ReadSizes();
  void ApplyScale();
  void Feed(const InputEvent& event, FrameNews& news);

  WindowOptions options_;
  GLFWwindow* window_ = nullptr;
  InputQueue input_;
  Fonts fonts_;
  std::vector<GLFWcursor*> cursors_;
  double scale_ = 1.0, applied_scale_ = 0.0;
  Theme applied_theme_ = Theme::kDark;
  int width_ = 0, height_ = 0, framebuffer_width_ = 0, framebuffer_height_ = 0;
  int restore_[4] = {0, 0, 0, 0};  // x, y, width, height before full screen
  double last_time_ = 0.0;
};

}  // namespace arthro::app
