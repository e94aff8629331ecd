// One shader over a whole target, or over the round window in it, without stored vertices. OpenGL
// 3.2; belongs to the context that was current when it was first drawn. An input that the fragments
// declare as steady (steady_inputs.h) is set as given_NAME.
#pragma once

#include <string>

class vtkOpenGLRenderWindow;
class vtkShaderProgram;

namespace arthro::app {

class ShaderPass {
 public:
  // kRound: a polygon around the disc that touches the target's edges, and a pixel more for its
  // soft rim. A software rasteriser then fills a fifth less.
  enum class Shape { kWhole, kRound };
  // Fragments may read `in vec2 texCoord`, 0 to 1 over the target.
  ShaderPass(const std::string& fragment_shader, Shape shape);
  // Triangles of its own: `vertex_main` calls handOn() and uses gl_VertexID.
  ShaderPass(const std::string& fragment_shader, const std::string& vertex_main);

  // Returns the program, in use; null when the driver refuses the shader.
  vtkShaderProgram* Ready(vtkOpenGLRenderWindow* window);
  // Call after Ready; `side` is that of the target, px.
  void Draw(int side);
  void DrawTriangles(int count);
  void ReleaseGraphicsResources();

 private:
  std::string vertex_, fragment_;
  Shape shape_ = Shape::kWhole;
  vtkShaderProgram* program_ = nullptr;  // owned by the window's shader cache
  unsigned vertex_array_ = 0;
};

}  // namespace arthro::app
