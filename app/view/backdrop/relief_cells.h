// Where the relief lies along the rays through the corners of cells of pixels, found once a cell
// instead of once a pixel, as textures for the backdrop's shader (relief_by_cells.glsl). Made anew
// for each frame, in textures that stay.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <vtkNew.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkTextureObject.h>

#include "app/view/shader_pass.h"

class vtkOpenGLRenderWindow;
class vtkShaderProgram;

namespace arthro::app {

class ReliefCells {
 public:
  // `variant` is a number that stands for `defines`.
  bool Has(std::size_t variant) const { return find_corners_ && variant == variant_; }
  void SetShaders(std::size_t variant, const std::vector<std::string>& defines);
  // `set` gives a program its uniforms. A picture of size x size pixels, cells of cell x cell.
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
