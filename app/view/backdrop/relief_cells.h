// Distances of the relief along the rays through the corners of cells of pixels, found once per
// cell instead of once per pixel, as textures for the backdrop's shader (relief_by_cells.glsl).
// Computed for each frame, in textures that are reused.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <vtkNew.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkTextureObject.h>

#include "app/view/drawing/passes/shader_pass.h"

class vtkOpenGLRenderWindow;
class vtkShaderProgram;

namespace arthro::app {

class ReliefCells {
 public:
  // `variant` is a number that stands for `defines`.
  bool Has(std::size_t variant) const { return find_corners_ && variant == variant_; }
  void SetShaders(std::size_t variant, const std::vector<std::string>& defines);
  // `set` sets the uniforms of a program. The picture has size x size pixels, a cell cell x cell.
  void Draw(vtkOpenGLRenderWindow* window, int size, int cell,
            const std::function<void(vtkShaderProgram&)>& set);
  vtkTextureObject* cells() { return cells_; }
  void ReleaseGraphicsResources(vtkOpenGLRenderWindow* window);

 private:
  void Pass(vtkOpenGLRenderWindow* window, ShaderPass& pass, vtkTextureObject* into,
            const std::function<void(vtkShaderProgram&)>& set);

  std::size_t variant_ = 0;
  int across_ = 0;  // cells
  vtkNew<vtkTextureObject> corners_, cells_;
  vtkNew<vtkOpenGLFramebufferObject> framebuffer_;
  std::optional<ShaderPass> find_corners_, join_corners_;
};

}  // namespace arthro::app
