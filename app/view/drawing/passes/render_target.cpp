#include "app/view/drawing/passes/render_target.h"

#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtk_glew.h>

namespace arthro::app {

void RenderTarget::Resize(vtkOpenGLRenderWindow* window, int wanted_size, int levels, float alpha) {
  if (size == wanted_size) return;
  size = wanted_size;
  texture->ReleaseGraphicsResources(window);
  texture->SetContext(window);
  texture->SetWrapS(vtkTextureObject::ClampToEdge);
  texture->SetWrapT(vtkTextureObject::ClampToEdge);
  texture->SetMagnificationFilter(vtkTextureObject::Linear);
  texture->SetMaximumAnisotropicFiltering(1.0f);
  texture->SetGenerateMipmap(levels > 0);
  texture->SetMaxLevel(levels);
  texture->Create2D(static_cast<unsigned>(size), static_cast<unsigned>(size), 4, VTK_UNSIGNED_CHAR,
                    false);
  texture->SetMinificationFilter(levels > 0 ? vtkTextureObject::LinearMipmapNearest
                                            : vtkTextureObject::Linear);
  framebuffer->SetContext(window);
  vtkOpenGLState* state = window->GetState();
  state->PushFramebufferBindings();
  framebuffer->Bind();
  // Attaches the new storage: VTK skips a texture object that is attached already, although its
  // OpenGL texture is new.
  framebuffer->RemoveColorAttachment(0);
  framebuffer->AddColorAttachment(0, texture);
  framebuffer->ActivateDrawBuffer(0);
  state->vtkglViewport(0, 0, size, size);
  state->vtkglScissor(0, 0, size, size);
  state->vtkglClearColor(0, 0, 0, alpha);
  state->vtkglClear(GL_COLOR_BUFFER_BIT);
  state->PopFramebufferBindings();
}

void RenderTarget::Bind(vtkOpenGLRenderWindow* window) {
  framebuffer->Bind(GL_DRAW_FRAMEBUFFER);
  framebuffer->ActivateDrawBuffer(0);
  window->GetState()->vtkglViewport(0, 0, size, size);
  window->GetState()->vtkglScissor(0, 0, size, size);
}

void RenderTarget::ReleaseGraphicsResources(vtkOpenGLRenderWindow* window) {
  texture->ReleaseGraphicsResources(window);
  framebuffer->ReleaseGraphicsResources(window);
  size = 0;
}

}  // namespace arthro::app
