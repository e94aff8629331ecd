#include "app/view/drawing/shader_pass.h"

#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLShaderCache.h>
#include <vtkShaderProgram.h>
#include <vtk_glew.h>

#include "app/view/drawing/steady_inputs.h"

namespace arthro::app {
namespace {

constexpr const char* kWhole = R"(
out vec2 texCoord;
void main() {
  handOn();
  texCoord = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(2.0 * texCoord - 1.0, 0.0, 1.0);
}
)";

// A fan of 64 corners about the disc.
constexpr int kCorners = 64;
constexpr const char* kRound = R"(
uniform float reach;  // of the corners; 1 is the disc's rim
out vec2 texCoord;
void main() {
  handOn();
  float turn = 6.283185307 / 64.0 * float(gl_VertexID);
  vec2 corner = gl_VertexID == 0 ? vec2(0.0) : reach * vec2(cos(turn), sin(turn));
  texCoord = 0.5 + 0.5 * corner;
  gl_Position = vec4(corner, 0.0, 1.0);
}
)";

}  // namespace

ShaderPass::ShaderPass(const std::string& fragment_shader, const std::string& vertex_main) {
  const SteadyInputs inputs = TakeSteadyInputs(fragment_shader);
  vertex_ = "//VTK::System::Dec\n" + inputs.uniforms + inputs.outputs + vertex_main;
  fragment_ = inputs.fragment;
}

ShaderPass::ShaderPass(const std::string& fragment_shader, Shape shape)
    : ShaderPass(fragment_shader, shape == Shape::kRound ? kRound : kWhole) {
  shape_ = shape;
}

vtkShaderProgram* ShaderPass::Ready(vtkOpenGLRenderWindow* window) {
  vtkOpenGLShaderCache* cache = window->GetShaderCache();
  if (program_ == nullptr) {
    program_ = cache->ReadyShaderProgram(vertex_.c_str(), fragment_.c_str(), "");
    glGenVertexArrays(1, &vertex_array_);
  } else {
    cache->ReadyShaderProgram(program_);
  }
  return program_;
}

void ShaderPass::Draw(int side) {
  glBindVertexArray(vertex_array_);
  if (shape_ == Shape::kRound) {
    program_->SetUniformf("reach", static_cast<float>(1.00121 + 2.0 / side));
    glDrawArrays(GL_TRIANGLE_FAN, 0, kCorners + 2);
  } else {
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  }
  glBindVertexArray(0);
}

void ShaderPass::DrawTriangles(int count) {
  glBindVertexArray(vertex_array_);
  glDrawArrays(GL_TRIANGLES, 0, 3 * count);
  glBindVertexArray(0);
}

void ShaderPass::ReleaseGraphicsResources() {
  if (vertex_array_ != 0) glDeleteVertexArrays(1, &vertex_array_);
  vertex_array_ = 0;
  program_ = nullptr;
}

}  // namespace arthro::app
