#include "app/view/drawing/passes/shader_pass.h"

#include <cmath>
#include <numbers>

#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLShaderCache.h>
#include <vtkShaderProgram.h>
#include <vtk_glew.h>

#include "app/view/drawing/passes/shader_text.h"
#include "app/view/drawing/passes/steady_inputs.h"
#include "app/view/shaders/constants.h"

namespace arthro::app {
ShaderPass::ShaderPass(const std::string& fragment_shader, const std::string& vertex_main) {
  const SteadyInputs inputs =
      TakeSteadyInputs("//VTK::System::Dec\n//VTK::Output::Dec\n" + fragment_shader);
  vertex_ = "//VTK::System::Dec\n" + inputs.uniforms + inputs.outputs + vertex_main;
  fragment_ = inputs.fragment;
}

ShaderPass::ShaderPass(const std::string& fragment_shader, Shape shape)
    : ShaderPass(fragment_shader,
                 ShaderText(shape == Shape::kRound ? "disc_vertex.glsl" : "whole_vertex.glsl")) {
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
    const double around = 1.0 / std::cos(std::numbers::pi / kDiscCorners);
    program_->SetUniformf("reach", static_cast<float>(around + 2.0 / side));
    glDrawArrays(GL_TRIANGLES, 0, 3 * (kDiscCorners - 2));
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
