#include "app/view/exposure/camera_pass.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkRenderbuffer.h>
#include <vtkShaderProgram.h>
#include <vtk_glew.h>

#include "app/view/drawing/grain.h"
#include "app/view/drawing/passes/pass_state.h"
#include "app/view/drawing/passes/shader_text.h"
#include "app/view/drawing/uniform_float.h"

namespace arthro::app {
namespace {

// Largest fringe that is interpolated between a pixel and its neighbours: without two reads of the
// picture per pixel, a tenth of the camera's work.
constexpr double kNearFringe = 0.8;      // px at the rim
constexpr double kMeteredRadius = 0.92;  // window radii; the rim is dark by its optics

// Window places whose rays meet the instrument or lie at the rim do not count.
bool Counts(const simulation::ScopeOptics& optics, const LensShade& shade, int column, int row) {
  const glm::dvec2 place = (glm::dvec2(column, row) + 0.5) * (2.0 / kMeteredParts) - 1.0;
  if (glm::length(place) > kMeteredRadius) return false;
  if (!(shade.rod.radius > 0)) return true;
  const simulation::ScopeView lens{{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, {1, 0, 0}};
  const glm::dvec3 ray = simulation::RayThrough(optics, lens, place);
  return !MeetsRod(ray, shade.rod) && !MeetsRod(ray, shade.head);
}

}  // namespace

void CameraPass::ReleaseGraphicsResources(vtkOpenGLRenderWindow* window) {
  const auto release = [](auto& passes) {
    for (Pass& pass : passes) {
      if (pass) pass->ReleaseGraphicsResources();
      pass.reset();
    }
  };
  release(meter_passes_);
  release(camera_passes_);
  marks_->ReleaseGraphicsResources(window);
  has_marks_ = false;
  for (RenderTarget* target : {&target_, &metered_}) target->ReleaseGraphicsResources(window);
}

void CameraPass::Meter(vtkOpenGLRenderWindow* window, const Picture& picture,
                       const LensShade& shade, vtkTextureObject& undisturbed,
                       vtkTextureObject* occlusion) {
  exposure_ = {};
  PassState state(window);
  undisturbed.SetMinificationFilter(vtkTextureObject::Linear);
  undisturbed.SetMagnificationFilter(vtkTextureObject::Linear);
  metered_.Resize(window, kMeteredParts, 0, 1);
  Pass& pass = meter_passes_[occlusion != nullptr ? 1 : 0];
  if (!pass) {
    const std::vector<std::string> defines(occlusion != nullptr ? 1 : 0, "OCCLUDED");
    pass.emplace(ShaderText("meter.glsl", defines), ShaderPass::Shape::kWhole);
  }
  vtkShaderProgram* program = pass->Ready(window);
  if (program == nullptr) return;
  undisturbed.Activate();
  program->SetUniformi("picture", undisturbed.GetTextureUnit());
  if (occlusion != nullptr) {
    occlusion->Activate();
    program->SetUniformi("occlusion", occlusion->GetTextureUnit());
  }
  metered_.Bind(window);
  pass->Draw(kMeteredParts);
  if (occlusion != nullptr) occlusion->Deactivate();
  undisturbed.Deactivate();
  texels_.resize(std::size_t{4} * kMeteredParts * kMeteredParts);
  state->PushReadFramebufferBinding();
  metered_.framebuffer->Bind(GL_READ_FRAMEBUFFER);
  metered_.framebuffer->ActivateReadBuffer(0);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, kMeteredParts, kMeteredParts, GL_RGBA, GL_UNSIGNED_BYTE, texels_.data());
  state->PopReadFramebufferBinding();
  parts_.clear();
  const simulation::ScopeOptics optics{picture.field_of_view, picture.lens, {}};
  for (int row = 0; row < kMeteredParts; ++row)
    for (int column = 0; column < kMeteredParts; ++column) {
      const std::uint8_t* texel = &texels_[4 * parts_.size()];
      parts_.push_back(
          {glm::vec3(texel[0], texel[1], texel[2]) / 255.0f, Counts(optics, shade, column, row)});
    }
  exposure_ = ExposureOf(parts_);
}

void CameraPass::Expose(vtkOpenGLRenderWindow* window, const Picture& picture,
                        vtkTextureObject& finished, vtkTextureObject* occlusion, int size,
                        Edges edges) {
  const LensCamera& camera = *picture.camera;
  const auto shows = [&](CameraFeatures feature) { return picture.features >= feature; };
  std::vector<std::string> defines;
  std::size_t variant = 0, bit = 1;
  const auto define = [&](bool is_on, const char* name) {
    if (is_on) defines.push_back(name), variant |= bit;
    bit <<= 1;
  };
  define(shows(CameraFeatures::kGrain) && camera.grain > 0, "GRAIN");
  define(shows(CameraFeatures::kSharpness) && (camera.sharpening > 0 || camera.rim_blur > 0),
         "DETAIL");
  define(shows(CameraFeatures::kFringe) && camera.fringe > 0, "FRINGE");
  define(picture.rays == 1, "SAME_SIZE");
  define(picture.rays == 1 && shows(CameraFeatures::kFringe) &&
             camera.fringe * size <= 2.0 * kNearFringe &&
             (camera.sharpening > 0 || camera.rim_blur > 0),
         "NEAR_FRINGE");
  define(occlusion != nullptr, "OCCLUDED");
  define(edges == Edges::kMarked, "MARKS");
  define(edges == Edges::kSmoothed, "EDGES");
  Pass& pass = camera_passes_[variant];
  if (!pass) pass.emplace(ShaderText("camera.glsl", defines), ShaderPass::Shape::kRound);
  vtkShaderProgram* program = pass->Ready(window);
  if (program == nullptr) return;
  program->SetUniformi("picture", finished.GetTextureUnit());
  if (occlusion != nullptr) program->SetUniformi("occlusion", occlusion->GetTextureUnit());
  program->SetUniformf("given_pixel", Float(1.0 / size));
  program->SetUniformf("given_gain", Float(exposure_.gain));
  program->SetUniformf("given_offset", Float(exposure_.offset));
  program->SetUniformf("given_fringe", Float(camera.fringe));
  program->SetUniformf("given_sharpening", Float(camera.sharpening));
  program->SetUniformf("given_rimBlur", Float(camera.rim_blur));
  program->SetUniformf("given_grain", Float(camera.grain));
  if (camera.grain > 0) program->SetUniformi("seed", GrainSeed(picture));
  pass->Draw(size);
}

void CameraPass::AttachMarks(vtkOpenGLRenderWindow* window) {
  const auto side = static_cast<unsigned>(target_.size);
  if (has_marks_ && marks_->GetWidth() == side) return;
  if (marks_->GetHandle() == 0 || marks_->GetWidth() != side) {
    marks_->SetContext(window);
    marks_->Create(GL_DEPTH_COMPONENT16, side, side);
  }
  target_.framebuffer->Bind();
  target_.framebuffer->RemoveDepthAttachment();
  target_.framebuffer->AddDepthAttachment(marks_);
  has_marks_ = true;
}

// OpenGL draws only where all attachments have pixels: marks of an earlier size would cut it off.
void CameraPass::DetachMarks() {
  if (!has_marks_) return;
  target_.framebuffer->Bind();
  target_.framebuffer->RemoveDepthAttachment();
  has_marks_ = false;
}

void CameraPass::Draw(vtkOpenGLRenderWindow* window, const Picture& picture,
                      vtkTextureObject& finished, vtkTextureObject* occlusion, int size) {
  target_.Resize(window, size, 0, 1);
  PassState state(window);
  finished.SetMinificationFilter(vtkTextureObject::Linear);
  finished.SetMagnificationFilter(vtkTextureObject::Linear);
  finished.Activate();
  if (occlusion != nullptr) occlusion->Activate();
  // Four rays per pixel need no other smoothing.
  if (picture.features >= CameraFeatures::kEdges && picture.rays == 1) {
    // A software rasteriser executes the smoothing for every pixel that it shades. The depth test
    // leaves blocks without an edge out before that.
    AttachMarks(window);
    target_.Bind(window);
    state->vtkglEnable(GL_DEPTH_TEST);
    state->vtkglDepthMask(GL_TRUE);
    state->vtkglDepthFunc(GL_ALWAYS);
    Expose(window, picture, finished, occlusion, size, Edges::kMarked);
    state->vtkglDepthMask(GL_FALSE);
    state->vtkglDepthFunc(GL_LESS);
    Expose(window, picture, finished, occlusion, size, Edges::kSmoothed);
    state->vtkglDepthFunc(GL_LEQUAL);
  } else {
    DetachMarks();
    target_.Bind(window);
    Expose(window, picture, finished, occlusion, size, Edges::kLeft);
  }
  if (occlusion != nullptr) occlusion->Deactivate();
  finished.Deactivate();
}

}  // namespace arthro::app
