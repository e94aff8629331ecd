#include "app/view/disturbances/lens_pass.h"

#include <algorithm>
#include <cmath>

#include <vtkOpenGLQuadHelper.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLShaderCache.h>
#include <vtkOpenGLState.h>
#include <vtkShaderProgram.h>
#include <vtk_glew.h>

#include "app/view/disturbances/drifting_bits.h"
#include "app/view/disturbances/lens_pass_shader.h"
#include "app/view/disturbances/murk_field.h"
#include "app/view/lens_shader.h"

namespace arthro::app {
namespace {

// Of the small copies: a blurred disc is at most some hundred pixels wide.
constexpr int kLevels = 8;
// The near blur is worked out at this part of the size.
constexpr int kCoarser = 4;
// A near thing that would be a larger disc is drawn as one of this share of the window's radius.
constexpr double kMostBlur = 0.25;
// Dew blurs what is seen through it: the disc's diameter in window radii.
constexpr double kFogBlur = 0.09;

float Float(double value) { return static_cast<float>(value); }

}  // namespace

struct LensPass::Frame {
  vtkOpenGLRenderWindow* window;
  vtkTextureObject *colours, *depths;
  const Disturbances& disturbances;
  double light_reach, radius;  // m; of the window, px
  double pixels_of_angle;      // px that a radian takes in the middle of the window
  std::string defines;         // of kDisturbShader
  int size;
};

LensPass::LensPass() = default;
LensPass::~LensPass() = default;

void LensPass::ReleaseGraphicsResources(vtkOpenGLRenderWindow* window) {
  for (Quad* quad : {&disturb_quad_, &gather_quad_, &spread_quad_}) {
    if (quad->helper) quad->helper->ReleaseGraphicsResources(window);
    *quad = {};
  }
  for (Target* target : {&target_, &gathered_, &spread_}) {
    target->texture->ReleaseGraphicsResources(window);
    target->framebuffer->ReleaseGraphicsResources(window);
    target->size = 0;
  }
  murk_->ReleaseGraphicsResources(window);
  if (vertex_array_ != 0) glDeleteVertexArrays(1, &vertex_array_);
  vertex_array_ = 0;
}

// `levels` small copies, to be made once it is drawn.
void LensPass::Resize(Target& target, vtkOpenGLRenderWindow* window, int size, int levels) {
  if (target.size == size) return;
  target.size = size;
  vtkTextureObject& texture = *target.texture;
  texture.ReleaseGraphicsResources(window);
  texture.SetContext(window);
  texture.SetWrapS(vtkTextureObject::ClampToEdge);
  texture.SetWrapT(vtkTextureObject::ClampToEdge);
  texture.SetMagnificationFilter(vtkTextureObject::Linear);
  texture.SetMaximumAnisotropicFiltering(1.0f);
  texture.SetGenerateMipmap(levels > 0);
  texture.SetMaxLevel(levels);
  texture.Create2D(static_cast<unsigned>(size), static_cast<unsigned>(size), 4, VTK_UNSIGNED_CHAR,
                   false);
  texture.SetMinificationFilter(levels > 0 ? vtkTextureObject::LinearMipmapNearest
                                           : vtkTextureObject::Linear);
  target.framebuffer->SetContext(window);
  vtkOpenGLState* state = window->GetState();
  state->PushFramebufferBindings();
  target.framebuffer->Bind();
  target.framebuffer->AddColorAttachment(0, &texture);
  target.framebuffer->ActivateDrawBuffer(0);
  state->PopFramebufferBindings();
}

vtkShaderProgram* LensPass::Ready(Quad& quad, const Frame& frame, const std::string& source) {
  if (!quad.helper || quad.source != source) {
    if (quad.helper) quad.helper->ReleaseGraphicsResources(frame.window);
    quad.helper =
        std::make_unique<vtkOpenGLQuadHelper>(frame.window, nullptr, source.c_str(), nullptr);
    quad.source = source;
  } else {
    frame.window->GetShaderCache()->ReadyShaderProgram(quad.helper->Program);
  }
  vtkShaderProgram* program = quad.helper->Program;
  if (program == nullptr) return nullptr;
  program->SetUniformi("depths", frame.depths->GetTextureUnit());
  program->SetUniformf("windowRadius", Float(frame.radius));
  program->SetUniformf("nearest", Float(kNearest));
  program->SetUniformf("farthest", Float(kFarthest));
  return program;
}

namespace {

void DrawInto(vtkOpenGLFramebufferObject& framebuffer, vtkOpenGLState* state, int size) {
  framebuffer.Bind(GL_DRAW_FRAMEBUFFER);
  framebuffer.ActivateDrawBuffer(0);
  state->vtkglViewport(0, 0, size, size);
  state->vtkglScissor(0, 0, size, size);
}

}  // namespace

void LensPass::Gather(const Frame& frame, bool is_far_only) {
  Resize(gathered_, frame.window, frame.size, kLevels);
  const std::string source = std::string(kLensPassHead) +
                             (is_far_only ? "#define FAR_ONLY\n" : "") + kLightShader + kGatherMain;
  vtkShaderProgram* program = Ready(gather_quad_, frame, source);
  if (program == nullptr) return;
  program->SetUniformi("picture", frame.colours->GetTextureUnit());
  if (is_far_only) {
    program->SetUniformf("pixelsOfAngle", Float(kBlurAperture * frame.disturbances.far_blur *
                                                frame.pixels_of_angle));
    program->SetUniformf("farFocus", Float(kFarBlurFocus));
  }
  DrawInto(*gathered_.framebuffer, frame.window->GetState(), frame.size);
  gather_quad_.helper->Render();
  gathered_.texture->Activate();
  glGenerateMipmap(GL_TEXTURE_2D);
}

void LensPass::Spread(const Frame& frame) {
  const int size = std::max(frame.size / kCoarser, 1);
  Resize(spread_, frame.window, size, kLevels);
  vtkShaderProgram* program = Ready(spread_quad_, frame, std::string(kLensPassHead) + kSpreadMain);
  if (program == nullptr) return;
  program->SetUniformf("pixelsOfAngle",
                       Float(kBlurAperture * frame.disturbances.near_blur * frame.pixels_of_angle));
  program->SetUniformf("nearFocus", Float(kNearBlurFocus));
  program->SetUniformf("mostBlur", Float(kMostBlur * frame.radius));
  DrawInto(*spread_.framebuffer, frame.window->GetState(), size);
  spread_quad_.helper->Render();
  spread_.texture->Activate();
  glGenerateMipmap(GL_TEXTURE_2D);
}

void LensPass::TakeMurk(const Frame& frame) {
  const Disturbances& d = frame.disturbances;
  // Dew alone stands still.
  const double time = d.haze > 0 ? d.time : 0.0;
  if (murk_->GetHandle() == 0 || d.seed != murk_seed_ || time != murk_time_) {
    std::vector<std::uint8_t> texels = MurkField(d.seed, time);
    murk_->ReleaseGraphicsResources(frame.window);
    murk_->SetContext(frame.window);
    murk_->SetMinificationFilter(vtkTextureObject::Linear);
    murk_->SetMagnificationFilter(vtkTextureObject::Linear);
    murk_->SetWrapS(vtkTextureObject::ClampToEdge);
    murk_->SetWrapT(vtkTextureObject::ClampToEdge);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    murk_->Create2DFromRaw(kMurkSize, kMurkSize, 4, VTK_UNSIGNED_CHAR, texels.data());
    murk_seed_ = d.seed;
    murk_time_ = time;
  }
  murk_->Activate();
}

void LensPass::SetDisturbed(vtkShaderProgram& program, const Frame& frame) const {
  const Disturbances& d = frame.disturbances;
  program.SetUniformf("lightReach", Float(frame.light_reach));
  if (d.haze > 0 || d.fog > 0) program.SetUniformi("murk", murk_->GetTextureUnit());
  const float extinction[3] = {Float(kHazeExtinction[0]), Float(kHazeExtinction[1]),
                               Float(kHazeExtinction[2])};
  if (d.haze > 0) {
    program.SetUniformf("hazeStrength", Float(d.haze));
    program.SetUniform3f("hazeExtinction", extinction);
  }
  if (d.fog > 0) program.SetUniformf("fogStrength", Float(d.fog));
  if (d.overexposure > 0) program.SetUniformf("exposureGain", Float(ExposureGain(d.overexposure)));
}

void LensPass::DrawBits(const Frame& frame, const std::vector<DriftingBit>& bits,
                        const char* main) {
  if (bits.empty()) return;
  std::string source = std::string(kLensPassHead) + frame.defines + kLightShader + kDisturbShader +
                       "const float fibreShare = " + std::to_string(kFibreShare) + ";\n" +
                       kBitHead + main;
  vtkShaderProgram* program =
      frame.window->GetShaderCache()->ReadyShaderProgram(kBitVertex, source.c_str(), "");
  if (program == nullptr) return;
  std::vector<float> places, looks;
  for (const DriftingBit& bit : bits) {
    places.insert(places.end(), {Float(bit.centre.x), Float(bit.centre.y), Float(bit.radius),
                                 Float(bit.distance)});
    looks.insert(looks.end(),
                 {Float(bit.angle), Float(bit.shape), Float(bit.opacity), Float(bit.softness)});
  }
  const auto count = static_cast<int>(bits.size());
  program->SetUniform4fv("place", count, places.data());
  program->SetUniform4fv("look", count, looks.data());
  program->SetUniformi("depths", frame.depths->GetTextureUnit());
  if (main == kBubbleMain) program->SetUniformi("gathered", gathered_.texture->GetTextureUnit());
  program->SetUniformf("windowRadius", Float(frame.radius));
  program->SetUniformf("nearest", Float(kNearest));
  program->SetUniformf("farthest", Float(kFarthest));
  SetDisturbed(*program, frame);
  vtkOpenGLState* state = frame.window->GetState();
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  if (vertex_array_ == 0) glGenVertexArrays(1, &vertex_array_);
  glBindVertexArray(vertex_array_);
  glDrawArrays(GL_TRIANGLES, 0, 6 * count);
  glBindVertexArray(0);
  state->vtkglDisable(GL_BLEND);
}

void LensPass::Draw(vtkOpenGLRenderWindow* window, const Picture& picture, double light_reach,
                    int size) {
  vtkOpenGLFramebufferObject& drawn = *window->GetRenderFramebuffer();
  const Disturbances& d = picture.disturbances;
  Frame frame{window,
              drawn.GetColorAttachmentAsTextureObject(0),
              drawn.GetDepthAttachmentAsTextureObject(),
              d,
              light_reach,
              size / 2.0,
              0.0,
              "",
              size};
  frame.pixels_of_angle =
      picture.lens.outward[0] * frame.radius / (2.0 * std::sin(picture.field_of_view / 4.0));
  if (d.haze > 0) frame.defines += "#define HAZE\n";
  if (d.fog > 0) frame.defines += "#define FOG\n";
  if (d.overexposure > 0) frame.defines += "#define OVEREXPOSED\n";
  const bool is_blurred = d.near_blur > 0 || d.far_blur > 0 || d.fog > 0;
  const std::vector<DriftingBit> bubbles =
      Bubbles(d, picture.view, picture.field_of_view, picture.lens);

  Resize(target_, window, size, 0);
  vtkOpenGLState* state = window->GetState();
  state->PushFramebufferBindings();
  state->vtkglDisable(GL_BLEND);
  state->vtkglDisable(GL_DEPTH_TEST);
  state->vtkglDepthMask(GL_FALSE);
  frame.colours->Activate();
  frame.depths->Activate();
  if (is_blurred || !bubbles.empty())
    Gather(frame, d.far_blur > 0 && d.near_blur <= 0 && d.fog <= 0 && bubbles.empty());
  if (d.near_blur > 0) Spread(frame);
  if (d.haze > 0 || d.fog > 0) TakeMurk(frame);

  const std::string source =
      std::string(kLensPassHead) + frame.defines + (is_blurred ? "#define BLUR\n" : "") +
      (d.near_blur > 0 ? "#define NEAR_BLUR\n" : "") + kLightShader + kDisturbShader + kDisturbMain;
  if (vtkShaderProgram* program = Ready(disturb_quad_, frame, source)) {
    program->SetUniformi("picture", frame.colours->GetTextureUnit());
    SetDisturbed(*program, frame);
    if (is_blurred) {
      program->SetUniformi("gathered", gathered_.texture->GetTextureUnit());
      program->SetUniformf("farPixelsOfAngle",
                           Float(kBlurAperture * d.far_blur * frame.pixels_of_angle));
      program->SetUniformf("farFocus", Float(kFarBlurFocus));
      program->SetUniformf("fogBlur", Float(kFogBlur * frame.radius));
    }
    if (d.near_blur > 0) {
      program->SetUniformi("spread", spread_.texture->GetTextureUnit());
      program->SetUniformf("pixelsOfAngle",
                           Float(kBlurAperture * d.near_blur * frame.pixels_of_angle));
      program->SetUniformf("nearFocus", Float(kNearBlurFocus));
      program->SetUniformf("mostBlur", Float(kMostBlur * frame.radius));
      // As wide as a disc of half the largest.
      program->SetUniformf(
          "spreadLod", Float(std::max(std::log2(0.3 * kMostBlur * frame.radius / kCoarser), 0.0)));
    }
    DrawInto(*target_.framebuffer, state, size);
    disturb_quad_.helper->Render();
    DrawBits(frame, Flakes(d, picture.view, picture.field_of_view, picture.lens), kFlakeMain);
    DrawBits(frame, bubbles, kBubbleMain);
  }

  if (d.haze > 0 || d.fog > 0) murk_->Deactivate();
  if (d.near_blur > 0) spread_.texture->Deactivate();
  if (is_blurred || !bubbles.empty()) gathered_.texture->Deactivate();
  frame.depths->Deactivate();
  frame.colours->Deactivate();
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->PopFramebufferBindings();
}

}  // namespace arthro::app
