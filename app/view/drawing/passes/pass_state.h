// State of OpenGL for passes over a picture: no blending, no depth test, no depth written. The
// destructor restores the depth test and the framebuffers that were bound.
#pragma once

#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtk_glew.h>

namespace arthro::app {

class PassState {
 public:
  explicit PassState(vtkOpenGLRenderWindow* window) : state_(*window->GetState()) {
    state_.PushFramebufferBindings();
    state_.vtkglDisable(GL_BLEND);
    state_.vtkglDisable(GL_DEPTH_TEST);
    state_.vtkglDepthMask(GL_FALSE);
  }
  ~PassState() {
    state_.vtkglDepthMask(GL_TRUE);
    state_.vtkglEnable(GL_DEPTH_TEST);
    state_.PopFramebufferBindings();
  }
  PassState(const PassState&) = delete;
  PassState& operator=(const PassState&) = delete;
  vtkOpenGLState* operator->() { return &state_; }

 private:
  vtkOpenGLState& state_;
};

}  // namespace arthro::app
