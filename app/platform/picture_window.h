// A second window that shows one texture of the first and nothing else: over all of another
// monitor, without a cursor, or, where there is none, a window that can be moved. A context of its
// own that shares the first one's textures, so that neither disturbs what the other has bound. Not
// synchronised with its monitor: the first window is, and waits for one only.
#pragma once

#include <optional>
#include <string>

#include "app/recording/frame_shape.h"
#include "simulation/scene/image.h"

struct GLFWwindow;

namespace arthro::app {

class Window;

class PictureWindow {
 public:
  // `monitor` from 1; 0: the first that `beside` is not on. One that is not there is as none.
  // Throws Error(kDisplay). notice() says what was not as it was asked for.
  PictureWindow(Window& beside, const std::string& title, int monitor, bool is_visible);
  ~PictureWindow();
  PictureWindow(const PictureWindow&) = delete;
  PictureWindow& operator=(const PictureWindow&) = delete;

  const std::string& notice() const { return notice_; }
  // It was closed, or its monitor is gone.
  bool IsLost() const;

  // Shows a texture of edge x edge pixels, its first row at the bottom, in a frame of that shape.
  // `version`: grows with each picture; nothing is drawn where neither it nor the window changed.
  // True: it drew. The first window's context is current afterwards.
  bool Show(unsigned texture, int edge, long version, FrameShape shape);

  // Draws its picture again and reads it; the texture must be unchanged.
  ColourImage ReadPicture();

 private:
  friend struct PictureWindowCallbacks;
  void Draw();

  GLFWwindow* beside_ = nullptr;
  GLFWwindow* window_ = nullptr;
  bool is_full_ = false, is_damaged_ = true;
  unsigned framebuffer_ = 0;
  int width_ = 0, height_ = 0;
  long shown_ = -1;
  unsigned texture_ = 0;
  int edge_ = 0;
  FrameShape shape_ = FrameShape::kSquare;
  std::string notice_;
};

}  // namespace arthro::app
