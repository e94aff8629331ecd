#include "app/view/context_render_window.h"

#include <vtkObjectFactory.h>
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
  // glewInit loads OpenGL's functions first and then asks GLX for its display; under EGL only the
  // second step fails, and it is not needed. VTK would take that for a failure of the whole.
  if (!Initialized) {
    const GLenum result = glewInit();
    if ((result == GLEW_OK || result == GLEW_ERROR_NO_GLX_DISPLAY) && GLEW_VERSION_3_2) {
      GlewInitValid = true;
      Initialized = true;
    }
  }
  Superclass::OpenGLInitContext();
}

}  // namespace arthro::app
