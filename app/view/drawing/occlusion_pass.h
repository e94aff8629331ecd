// Short-range ambient occlusion among relief, tissues and instruments, so that nothing floats
// [method.md, Camera], from the stored depths of the window's framebuffer alone: a still picture
// gets the same light every time. Needs the OpenGL context of the window that drew the frame.
#pragma once

#include <optional>

#include "app/view/drawing/passes/render_target.h"
#include "app/view/drawing/passes/shader_pass.h"
#include "app/view/drawing/picture.h"

class vtkOpenGLRenderWindow;

namespace arthro::app {

inline constexpr double kOcclusionReach = 1.4e-3;  // m

class OcclusionPass {
 public:
  // Computes the light of the framebuffer's frame of `picture`, size x size. The camera multiplies
  // its picture by it.
  void Draw(vtkOpenGLRenderWindow* window, const Picture& picture, int size);
  // Multiplies the framebuffer's colours by that light, for passes that come before the camera.
  void Darken(vtkOpenGLRenderWindow* window, int size);
  // Light of the last frame; a texel stands for its upper right corner.
  vtkTextureObject& light() { return *mean_.texture; }
  void ReleaseGraphicsResources(vtkOpenGLRenderWindow* window);

 private:
  RenderTarget light_, mean_;  // smaller; as computed, and without its pattern
  std::optional<ShaderPass> occlusion_, smooth_, multiply_;
};

}  // namespace arthro::app
