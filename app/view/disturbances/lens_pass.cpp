#include "app/view/disturbances/lens_pass.h"

#include <algorithm>
#include <cmath>

#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkShaderProgram.h>
#include <vtk_glew.h>

#include "app/view/disturbances/drifting_bits.h"
#include "app/view/disturbances/murk_field.h"
#include "app/view/drawing/passes/pass_state.h"
#include "app/view/drawing/passes/shader_text.h"
#include "app/view/drawing/uniform_float.h"

namespace arthro::app {
namespace {

// Mipmap levels: a blurred disc is at most some hundred pixels wide.
constexpr int kLevels = 8;
// The near blur is computed at this fraction of the resolution.
constexpr int kCoarser = 4;
// Largest disc of the near blur, in window radii.
constexpr double kMostBlur = 0.25;
// Diameter of the disc by which dew blurs the picture, in window radii.
constexpr double kFogBlur = 0.09;

// Bits of a shader's variant. A software rasteriser executes both branches of every `if`.
constexpr std::size_t kHaze = 1, kFog = 2, kOverexposed = 4, kBlur = 8, kNearBlur = 16;

std::vector<std::string> DefinesOf(std::size_t variant) {
  std::vector<std::string> defines;
  if (variant & kHaze) defines.push_back("HAZE");
  if (variant & kFog) defines.push_back("FOG");
  if (variant & kOverexposed) defines.push_back("OVEREXPOSED");
  if (variant & kBlur) defines.push_back("BLUR");
  if (variant & kNearBlur) defines.push_back("NEAR_BLUR");
  return defines;
}

}  // namespace

struct LensPass::Frame {
  vtkOpenGLRenderWindow* window;
  vtkTextureObject *colours, *depths;
  const Disturbances& disturbances;
  double light_reach, radius;  // m; radius of the window, px
  double pixels_of_angle;      // px per radian in the middle of the window
  std::size_t variant;         // haze, fog and overexposure, which all passes share
  int size;
};

void LensPass::ReleaseGraphicsResources(vtkOpenGLRenderWindow* window) {
  const auto release = [](auto& passes) {
    for (Pass& pass : passes) {
      if (pass) pass->ReleaseGraphicsResources();
      pass.reset();
    }
  };
  release(gather_passes_);
  release(flake_passes_);
  release(bubble_passes_);
  release(disturb_passes_);
  if (spread_pass_) spread_pass_->ReleaseGraphicsResources();
  spread_pass_.reset();
  for (RenderTarget* target : {&target_, &gathered_, &spread_})
    target->ReleaseGraphicsResources(window);
  onto_->ReleaseGraphicsResources(window);
  murk_->ReleaseGraphicsResources(window);
}

vtkShaderProgram* LensPass::Ready(Pass& pass, const Frame& frame,
                                  const std::function<ShaderPass()>& make) {
  if (!pass) pass.emplace(make());
  vtkShaderProgram* program = pass->Ready(frame.window);
  if (program == nullptr) return nullptr;
  program->SetUniformi("depths", frame.depths->GetTextureUnit());
  program->SetUniformf("given_windowRadius", Float(frame.radius));
  return program;
}

void LensPass::Gather(const Frame& frame, bool is_far_only) {
  gathered_.Resize(frame.window, frame.size, kLevels, 0);
  Pass& pass = gather_passes_[is_far_only ? 1 : 0];
  vtkShaderProgram* program = Ready(pass, frame, [&] {
    const std::vector<std::string> defines(is_far_only ? 1 : 0, "FAR_ONLY");
    return ShaderPass(ShaderText("gather.glsl", defines), ShaderPass::Shape::kRound);
  });
  if (program == nullptr) return;
  program->SetUniformi("picture", frame.colours->GetTextureUnit());
  if (is_far_only) {
    program->SetUniformf("given_pixelsOfAngle", Float(kBlurAperture * frame.disturbances.far_blur *
                                                      frame.pixels_of_angle));
    program->SetUniformf("given_farFocus", Float(kFarBlurFocus));
  }
  gathered_.Bind(frame.window);
  pass->Draw(frame.size);
  gathered_.texture->Activate();
  glGenerateMipmap(GL_TEXTURE_2D);
}

void LensPass::Spread(const Frame& frame) {
  const int size = std::max(frame.size / kCoarser, 1);
  spread_.Resize(frame.window, size, kLevels, 0);
  vtkShaderProgram* program = Ready(spread_pass_, frame, [] {
    return ShaderPass(ShaderText("spread.glsl"), ShaderPass::Shape::kWhole);
  });
  if (program == nullptr) return;
  program->SetUniformf("given_pixelsOfAngle",
                       Float(kBlurAperture * frame.disturbances.near_blur * frame.pixels_of_angle));
  program->SetUniformf("given_nearFocus", Float(kNearBlurFocus));
  program->SetUniformf("given_mostBlur", Float(kMostBlur * frame.radius));
  spread_.Bind(frame.window);
  spread_pass_->Draw(size);
  spread_.texture->Activate();
  glGenerateMipmap(GL_TEXTURE_2D);
}

void LensPass::TakeMurk(const Frame& frame) {
  const Disturbances& d = frame.disturbances;
  // Dew alone does not move.
  const double time = d.haze > 0 ? d.time : 0.0;
  if (murk_->GetHandle() != 0 && d.seed == murk_seed_ && time == murk_time_)
    return murk_->Activate();
  std::vector<std::uint8_t> texels = MurkField(d.seed, time);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  if (murk_->GetHandle() == 0) {
    murk_->SetContext(frame.window);
    murk_->SetMinificationFilter(vtkTextureObject::Linear);
    murk_->SetMagnificationFilter(vtkTextureObject::Linear);
    murk_->SetWrapS(vtkTextureObject::ClampToEdge);
    murk_->SetWrapT(vtkTextureObject::ClampToEdge);
    murk_->Create2DFromRaw(kMurkSize, kMurkSize, 4, VTK_UNSIGNED_CHAR, texels.data());
    murk_->Activate();
  } else {
    murk_->Activate();
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, kMurkSize, kMurkSize, GL_RGBA, GL_UNSIGNED_BYTE,
                    texels.data());
  }
  murk_seed_ = d.seed;
  murk_time_ = time;
}

void LensPass::SetDisturbed(vtkShaderProgram& program, const Frame& frame) const {
  const Disturbances& d = frame.disturbances;
  program.SetUniformf("given_lightReach", Float(frame.light_reach));
  if (d.haze > 0 || d.fog > 0) program.SetUniformi("murk", murk_->GetTextureUnit());
  const float extinction[3] = {Float(simulation::kHazeExtinction[0]),
                               Float(simulation::kHazeExtinction[1]),
                               Float(simulation::kHazeExtinction[2])};
  if (d.haze > 0) {
    program.SetUniformf("given_hazeStrength", Float(d.haze));
    program.SetUniform3f("given_hazeExtinction", extinction);
  }
  if (d.fog > 0) program.SetUniformf("given_fogStrength", Float(d.fog));
  if (d.overexposure > 0)
    program.SetUniformf("given_exposureGain", Float(ExposureGain(d.overexposure)));
}

void LensPass::DrawBits(const Frame& frame, const std::vector<DriftingBit>& bits, Pass& pass,
                        const char* file, bool shows_scene) {
  if (bits.empty()) return;
  vtkShaderProgram* program = Ready(pass, frame, [&] {
    return ShaderPass(ShaderText(file, DefinesOf(frame.variant)), ShaderText("bit_vertex.glsl"));
  });
  if (program == nullptr) return;
  places_.clear();
  looks_.clear();
  for (const DriftingBit& bit : bits) {
    places_.insert(places_.end(), {Float(bit.centre.x), Float(bit.centre.y), Float(bit.radius),
                                   Float(bit.distance)});
    looks_.insert(looks_.end(),
                  {Float(bit.angle), Float(bit.shape), Float(bit.opacity), Float(bit.softness)});
  }
  const auto count = static_cast<int>(bits.size());
  program->SetUniform4fv("place", count, places_.data());
  program->SetUniform4fv("look", count, looks_.data());
  if (shows_scene) program->SetUniformi("gathered", gathered_.texture->GetTextureUnit());
  SetDisturbed(*program, frame);
  vtkOpenGLState* state = frame.window->GetState();
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  pass->DrawTriangles(2 * count);
  state->vtkglDisable(GL_BLEND);
}

LensPass::Frame LensPass::FrameOf(vtkOpenGLRenderWindow* window, const Picture& picture,
                                  double light_reach, int size) {
  vtkOpenGLFramebufferObject& drawn = *window->GetRenderFramebuffer();
  const Disturbances& d = picture.disturbances;
  const double radius = size / 2.0;
  return {window,
          drawn.GetColorAttachmentAsTextureObject(0),
          drawn.GetDepthAttachmentAsTextureObject(),
          d,
          light_reach,
          radius,
          picture.lens.outward[0] * radius / (2.0 * std::sin(picture.field_of_view / 4.0)),
          (d.haze > 0 ? kHaze : 0u) + (d.fog > 0 ? kFog : 0u) +
              (d.overexposure > 0 ? kOverexposed : 0u),
          size};
}

void LensPass::DrawFlecks(vtkOpenGLRenderWindow* window, const Picture& picture, double light_reach,
                          int size) {
  const std::vector<DriftingBit> flecks = Flecks(picture.flecks, picture.disturbances, picture.view,
                                                 picture.field_of_view, picture.lens);
  if (flecks.empty()) return;
  const Frame frame = FrameOf(window, picture, light_reach, size);
  PassState state(window);
  onto_->SetContext(window);
  onto_->Bind();
  // VTK skips a texture object that is attached already, although its OpenGL texture may be new.
  onto_->RemoveColorAttachment(0);
  onto_->AddColorAttachment(0, frame.colours);
  onto_->ActivateDrawBuffer(0);
  state->vtkglViewport(0, 0, size, size);
  state->vtkglScissor(0, 0, size, size);
  frame.depths->Activate();
  DrawBits(frame, flecks, flake_passes_[frame.variant], "flake.glsl", false);
  frame.depths->Deactivate();
}

void LensPass::Draw(vtkOpenGLRenderWindow* window, const Picture& picture, double light_reach,
                    int size) {
  const Disturbances& d = picture.disturbances;
  const Frame frame = FrameOf(window, picture, light_reach, size);
  const bool is_blurred = d.near_blur > 0 || d.far_blur > 0 || d.fog > 0;
  const std::vector<DriftingBit> bubbles =
      Bubbles(d, picture.view, picture.field_of_view, picture.lens);

  target_.Resize(window, size, 0, 1);
  PassState state(window);
  frame.colours->Activate();
  frame.depths->Activate();
  if (is_blurred || !bubbles.empty())
    Gather(frame, d.far_blur > 0 && d.near_blur <= 0 && d.fog <= 0 && bubbles.empty());
  if (d.near_blur > 0) Spread(frame);
  if (d.haze > 0 || d.fog > 0) TakeMurk(frame);

  const std::size_t variant =
      frame.variant + (is_blurred ? kBlur : 0u) + (d.near_blur > 0 ? kNearBlur : 0u);
  Pass& pass = disturb_passes_[variant];
  if (vtkShaderProgram* program = Ready(pass, frame, [&] {
        return ShaderPass(ShaderText("disturb.glsl", DefinesOf(variant)),
                          ShaderPass::Shape::kRound);
      })) {
    program->SetUniformi("picture", frame.colours->GetTextureUnit());
    SetDisturbed(*program, frame);
    if (is_blurred) {
      program->SetUniformi("gathered", gathered_.texture->GetTextureUnit());
      program->SetUniformf("given_farPixelsOfAngle",
                           Float(kBlurAperture * d.far_blur * frame.pixels_of_angle));
      program->SetUniformf("given_farFocus", Float(kFarBlurFocus));
      program->SetUniformf("given_fogBlur", Float(kFogBlur * frame.radius));
    }
    if (d.near_blur > 0) {
      program->SetUniformi("spread", spread_.texture->GetTextureUnit());
      program->SetUniformf("given_pixelsOfAngle",
                           Float(kBlurAperture * d.near_blur * frame.pixels_of_angle));
      program->SetUniformf("given_nearFocus", Float(kNearBlurFocus));
      program->SetUniformf("given_mostBlur", Float(kMostBlur * frame.radius));
      // Level at which a texel is as wide as a disc of half the largest diameter.
      program->SetUniformf(
          "given_spreadLod",
          Float(std::max(std::log2(0.3 * kMostBlur * frame.radius / kCoarser), 0.0)));
    }
    target_.Bind(window);
    pass->Draw(size);
    DrawBits(frame, Flecks(picture.flecks, d, picture.view, picture.field_of_view, picture.lens),
             flake_passes_[frame.variant], "flake.glsl", false);
    DrawBits(frame, Flakes(d, picture.view, picture.field_of_view, picture.lens),
             flake_passes_[frame.variant], "flake.glsl", false);
    DrawBits(frame, bubbles, bubble_passes_[frame.variant], "bubble.glsl", true);
  }

  if (d.haze > 0 || d.fog > 0) murk_->Deactivate();
  if (d.near_blur > 0) spread_.texture->Deactivate();
  if (is_blurred || !bubbles.empty()) gathered_.texture->Deactivate();
  frame.depths->Deactivate();
  frame.colours->Deactivate();
}

}  // namespace arthro::app
