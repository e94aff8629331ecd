// Texture as a render target: square, RGBA, 8 bits.
#pragma once

#include <vtkNew.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkTextureObject.h>

class vtkOpenGLRenderWindow;

namespace arthro::app {

struct RenderTarget {
  vtkNew<vtkTextureObject> texture;
  vtkNew<vtkOpenGLFramebufferObject> framebuffer;
  int size = 0;  // px

  // Allocates `levels` mipmap levels, generated after drawing; clears to black with `alpha`. Does
  // nothing at the same size.
  void Resize(vtkOpenGLRenderWindow* window, int wanted_size, int levels, float alpha);
  // Draws go here; sets viewport and scissor.
  void Bind(vtkOpenGLRenderWindow* window);
  void ReleaseGraphicsResources(vtkOpenGLRenderWindow* window);
};

}  // namespace arthro::app
