// Short-range ambient occlusion among relief, tissues and instruments, so that nothing floats
// [method.md, Camera]. Darkens the finished colours of the window's framebuffer in place, from its
// stored depths alone: a still picture gets the same light every time. Needs the OpenGL context of
// the window that drew the frame.
#pragma once

#include <optional>

#include "app/view/drawing/picture.h"
#include "app/view/drawing/render_target.h"
#include "app/view/drawing/shader_pass.h"

class vtkOpenGLRenderWindow;

namespace arthro::app {

inline constexpr double kOcclusionReach = 1.4e-3;  // m

class OcclusionPass {
 public:
  // The framebuffer holds the frame of `picture`, size x size.
  void Draw(vtkOpenGLRenderWindow* window, const Picture& picture, int size);
  void ReleaseGraphicsResources(vtkOpenGLRenderWindow* window);

 private:
  RenderTarget light_, mean_;  // half the size; as computed, and without its pattern
  std::optional<ShaderPass> occlusion_, smooth_, multiply_;
};

}  // namespace arthro::app
