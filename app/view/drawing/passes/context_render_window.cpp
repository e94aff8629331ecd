#include "app/view/drawing/passes/context_render_window.h"

#include <algorithm>
#include <vector>

#include <vtkObjectFactory.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLState.h>
#include <vtk_glew.h>

namespace arthro::app {

vtkStandardNewMacro(ContextRenderWindow);

ContextRenderWindow::ContextRenderWindow() {
  SetMultiSamples(0);
  SetIsDirect(1);
  SetSupportsOpenGL(1);
  SetReadyForRendering(true);
  SetFrameBlitModeToNoBlit();
}

void ContextRenderWindow::OpenGLInitContext() {
  // glewInit loads OpenGL's functions first and then asks GLX for its display. Under EGL only the
  // second step fails, which is harmless; VTK would treat it as a failure of the whole.
  if (!Initialized) {
    const GLenum result = glewInit();
    if ((result == GLEW_OK || result == GLEW_ERROR_NO_GLX_DISPLAY) && GLEW_VERSION_3_2) {
      GlewInitValid = true;
      Initialized = true;
    }
  }
  Superclass::OpenGLInitContext();
}

ColourImage ContextRenderWindow::ReadPicture(vtkOpenGLFramebufferObject& drawn, int side) {
  const int* size = GetActualSize();
  ColourImage image(side > 0 ? side : size[0], side > 0 ? side : size[1]);
  std::vector<std::uint8_t> rows(image.rgb.size());
  GetState()->PushReadFramebufferBinding();
  drawn.Bind(GL_READ_FRAMEBUFFER);
  drawn.ActivateReadBuffer(0);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, image.width, image.height, GL_RGB, GL_UNSIGNED_BYTE, rows.data());
  GetState()->PopReadFramebufferBinding();
  // OpenGL's first row is the lowest.
  const std::size_t row = static_cast<std::size_t>(image.width) * 3;
  const auto height = static_cast<std::size_t>(image.height);
  for (std::size_t y = 0; y < height; ++y)
    std::copy_n(&rows[(height - 1 - y) * row], row, &image.rgb[y * row]);
  return image;
}

}  // namespace arthro::app
