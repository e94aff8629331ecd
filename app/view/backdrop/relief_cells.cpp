#include "app/view/backdrop/relief_cells.h"

#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkShaderProgram.h>
#include <vtk_glew.h>

#include "app/view/drawing/passes/shader_text.h"

namespace arthro::app {
namespace {

void Allocate(vtkTextureObject& texture, vtkOpenGLRenderWindow* window, int side, int channels) {
  texture.ReleaseGraphicsResources(window);
  texture.SetContext(window);
  texture.SetMinificationFilter(vtkTextureObject::Nearest);
  texture.SetMagnificationFilter(vtkTextureObject::Nearest);
  texture.SetWrapS(vtkTextureObject::ClampToEdge);
  texture.SetWrapT(vtkTextureObject::ClampToEdge);
  texture.Allocate2D(static_cast<unsigned>(side), static_cast<unsigned>(side), channels, VTK_FLOAT);
}

}  // namespace

void ReliefCells::Pass(vtkOpenGLRenderWindow* window, ShaderPass& pass, vtkTextureObject* into,
                       const std::function<void(vtkShaderProgram&)>& set) {
  const auto side = static_cast<GLsizei>(into->GetWidth());
  framebuffer_->AddColorAttachment(0, into);
  framebuffer_->ActivateDrawBuffer(0);
  window->GetState()->vtkglViewport(0, 0, side, side);
  window->GetState()->vtkglScissor(0, 0, side, side);
  vtkShaderProgram* program = pass.Ready(window);
  if (program == nullptr) return;
  set(*program);
  pass.Draw(side);
}

void ReliefCells::SetShaders(std::size_t variant, const std::vector<std::string>& defines) {
  variant_ = variant;
  find_corners_.emplace(ShaderText("relief_corners.glsl", defines), ShaderPass::Shape::kWhole);
  join_corners_.emplace(ShaderText("relief_cells.glsl", defines), ShaderPass::Shape::kWhole);
}

void ReliefCells::Draw(vtkOpenGLRenderWindow* window, int size, int cell,
                       const std::function<void(vtkShaderProgram&)>& set) {
  const int across = (size + cell - 1) / cell;
  if (across != across_) {
    across_ = across;
    Allocate(*corners_, window, across + 3, 2);
    Allocate(*cells_, window, across, 4);
    framebuffer_->SetContext(window);
  }
  vtkOpenGLState* state = window->GetState();
  state->Push();
  state->vtkglDisable(GL_BLEND);
  state->vtkglDisable(GL_DEPTH_TEST);
  state->PushFramebufferBindings();
  framebuffer_->Bind();
  Pass(window, *find_corners_, corners_, set);
  corners_->Activate();
  Pass(window, *join_corners_, cells_, [&](vtkShaderProgram& program) {
    set(program);
    program.SetUniformi("corners", corners_->GetTextureUnit());
  });
  corners_->Deactivate();
  state->PopFramebufferBindings();
  state->Pop();
}

void ReliefCells::ReleaseGraphicsResources(vtkOpenGLRenderWindow* window) {
  for (auto* pass : {&find_corners_, &join_corners_}) {
    if (*pass) (*pass)->ReleaseGraphicsResources();
    pass->reset();
  }
  framebuffer_->ReleaseGraphicsResources(window);
  corners_->ReleaseGraphicsResources(window);
  cells_->ReleaseGraphicsResources(window);
  across_ = 0;
}

}  // namespace arthro::app
