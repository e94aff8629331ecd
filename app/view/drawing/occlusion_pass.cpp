#include "app/view/drawing/occlusion_pass.h"

#include <algorithm>
#include <cmath>

#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkShaderProgram.h>
#include <vtk_glew.h>

#include "app/view/drawing/passes/pass_state.h"
#include "app/view/drawing/passes/shader_text.h"

namespace arthro::app {
namespace {

// A larger picture has no finer shade: its reach is a share of the window.
constexpr int kMostSide = 340;  // px

}  // namespace

void OcclusionPass::ReleaseGraphicsResources(vtkOpenGLRenderWindow* window) {
  for (std::optional<ShaderPass>* pass : {&occlusion_, &smooth_, &multiply_}) {
    if (*pass) (*pass)->ReleaseGraphicsResources();
    pass->reset();
  }
  light_.ReleaseGraphicsResources(window);
  mean_.ReleaseGraphicsResources(window);
}

void OcclusionPass::Draw(vtkOpenGLRenderWindow* window, const Picture& picture, int size) {
  vtkOpenGLFramebufferObject& drawn = *window->GetRenderFramebuffer();
  vtkTextureObject& depths = *drawn.GetDepthAttachmentAsTextureObject();
  const int side = std::clamp(size / 2, 1, kMostSide);
  for (RenderTarget* target : {&light_, &mean_}) target->Resize(window, side, 0, 1);
  if (!occlusion_) occlusion_.emplace(ShaderText("occlusion.glsl"), ShaderPass::Shape::kRound);
  if (!smooth_) smooth_.emplace(ShaderText("occlusion_mean.glsl"), ShaderPass::Shape::kRound);
  PassState state(window);
  // Places around the round window, which the mean reads, take no light away.
  const vtkOpenGLState::ScopedglClearColor colour(window->GetState());
  const auto clear = [&](RenderTarget& target) {
    target.Bind(window);
    window->GetState()->vtkglClearColor(1, 1, 1, 1);
    window->GetState()->vtkglClear(GL_COLOR_BUFFER_BIT);
  };
  vtkShaderProgram* program = occlusion_->Ready(window);
  if (program == nullptr) return;
  depths.Activate();
  program->SetUniformi("depths", depths.GetTextureUnit());
  program->SetUniformf("given_shadeReach", static_cast<float>(kOcclusionReach));
  // Half a texture unit is the window's radius.
  program->SetUniformf(
      "given_unitsOfAngle",
      static_cast<float>(picture.lens.outward[0] / (4.0 * std::sin(picture.field_of_view / 4.0))));
  program->SetUniformf("given_texel", static_cast<float>(1.0 / size));
  clear(light_);
  occlusion_->Draw(side);
  depths.Deactivate();

  program = smooth_->Ready(window);
  if (program == nullptr) return;
  light_.texture->Activate();
  program->SetUniformi("light", light_.texture->GetTextureUnit());
  clear(mean_);
  smooth_->Draw(side);
  light_.texture->Deactivate();
}

void OcclusionPass::Darken(vtkOpenGLRenderWindow* window, int size) {
  if (!multiply_) multiply_.emplace(ShaderText("multiply.glsl"), ShaderPass::Shape::kRound);
  PassState state(window);
  vtkShaderProgram* program = multiply_->Ready(window);
  if (program == nullptr) return;
  mean_.texture->Activate();
  program->SetUniformi("occlusion", mean_.texture->GetTextureUnit());
  vtkOpenGLFramebufferObject& drawn = *window->GetRenderFramebuffer();
  drawn.Bind(GL_DRAW_FRAMEBUFFER);
  drawn.ActivateDrawBuffer(0);
  state->vtkglViewport(0, 0, size, size);
  state->vtkglScissor(0, 0, size, size);
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendFuncSeparate(GL_DST_COLOR, GL_ZERO, GL_ZERO, GL_ONE);
  multiply_->Draw(size);
  state->vtkglDisable(GL_BLEND);
  mean_.texture->Deactivate();
}

}  // namespace arthro::app
