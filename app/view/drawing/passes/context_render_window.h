// VTK's window over the current OpenGL context: the application's GLFW window, or an
// OffscreenContext. Draws into its own framebuffer only; the caller shows or reads its texture.
#pragma once

#include <vtkGenericOpenGLRenderWindow.h>

#include "simulation/scene/image.h"

namespace arthro::app {

class ContextRenderWindow : public vtkGenericOpenGLRenderWindow {
 public:
  static ContextRenderWindow* New();
  vtkTypeMacro(ContextRenderWindow, vtkGenericOpenGLRenderWindow);

  // Debian's GLEW asks GLX for a display even when EGL holds the context; see the .cpp.
  void OpenGLInitContext() override;
  // Returns false when the context's OpenGL is too old or could not be loaded.
  bool IsReady() const { return Initialized && GlewInitValid; }
  // The last frame, or the result of a pass over it.
  ColourImage ReadPicture() { return ReadPicture(*GetRenderFramebuffer(), 0); }
  // `side`: px; 0: as large as the window.
  ColourImage ReadPicture(vtkOpenGLFramebufferObject& drawn, int side);
  // The caller keeps its context current.
  void MakeCurrent() override {}
  bool IsCurrent() override { return true; }

 protected:
  ContextRenderWindow();
  ~ContextRenderWindow() override = default;
};

}  // namespace arthro::app
