#include "app/view/backdrop_prop.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <vtkObjectFactory.h>
#include <vtkOpenGLQuadHelper.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLShaderCache.h>
#include <vtkOpenGLState.h>
#include <vtkShaderProgram.h>
#include <vtkTextureObject.h>
#include <vtkViewport.h>
#include <vtk_glew.h>

#include "app/view/lens_shader.h"
#include "simulation/core/units.h"

namespace arthro::app {

vtkStandardNewMacro(BackdropProp);

namespace {

// Where the light is neutral, in radii of the backdrop: a usual working distance.
constexpr double kLightReach = 0.55;

// Samples a pixel at most. Eight serve footprints eight times as long as wide.
constexpr double kSamples = 8;

constexpr const char* kHead = R"(//VTK::System::Dec
//VTK::Output::Dec
in vec2 texCoord;
uniform sampler2D panorama;
uniform sampler2D relief;       // m
uniform sampler2D imagedShare;  // 1 well inside what was imaged
uniform vec3 tip;               // in radii of the sphere
uniform float clearance;        // 1 - |tip|^2, worked out in double
uniform vec3 viewAxis, upAxis, rightAxis;
uniform float lensScale;        // sin(fov/4)
uniform float windowRadius;     // px
uniform int equirectangular, wraps, plain;
uniform vec2 centre, scale;     // of the projection, in texture units
uniform vec2 texels;
const float kSharpness = 0.7;
uniform float samples;           // at most, a pixel
uniform float radius;           // m
uniform float nearest, farthest, lightReach;
uniform vec3 endColour;
uniform vec2 notch;             // unit, image right and up
)";

// A pixel's footprint in the panorama is an ellipse (texels a pixel: dx, dy), long and thin near
// the edge of a gnomonic picture and the poles of an equirectangular one. Samples are strung along
// its longer axis, each averaged over the shorter one; a single round average would blur fine lines
// together there (grid lines up to 1.8 px off instead of 0.3).
constexpr const char* kFilter = R"(
vec3 panoramaColour(vec2 uv, vec2 dx, vec2 dy) {
  float a = dx.x * dx.x + dy.x * dy.x, b = dx.x * dx.y + dy.x * dy.y, c = dx.y * dx.y + dy.y * dy.y;
  float mean = 0.5 * (a + c), spread = sqrt(max(0.25 * (a - c) * (a - c) + b * b, 0.0));
  float longer = sqrt(mean + spread);
  float shorter = abs(dx.x * dy.y - dx.y * dy.x) / max(longer, 1e-6);
  vec2 axis = abs(b) > 1e-6 * mean ? normalize(vec2(mean + spread - c, b))
                                   : (a >= c ? vec2(1.0, 0.0) : vec2(0.0, 1.0));
  float count = clamp(ceil(longer / max(shorter, 1.0) - 0.4), 1.0, samples);
  float lod = log2(max(max(longer / count, shorter) * kSharpness, 1.0));
  vec2 step = axis * longer / count / texels;
  vec2 start = uv - 0.5 * (count - 1.0) * step;
  vec3 sum = vec3(0.0);
  for (float i = 0.0; i < count; i += 1.0) sum += textureLod(panorama, start + i * step, lod).rgb;
  return sum / count;
}
)";

constexpr const char* kMain = R"(
void main() {
  // Pixel -> equisolid ray: |offset| lensScale = sin(theta/2).
  vec2 offset = 2.0 * texCoord - 1.0;
  float r = length(offset);
  float s2 = min(r * r * lensScale * lensScale, 1.0);
  vec2 across = 2.0 * lensScale * sqrt(1.0 - s2) * offset;
  vec3 ray = (1.0 - 2.0 * s2) * viewAxis + across.x * rightAxis + across.y * upAxis;

  // Ray -> sphere -> direction from the portal.
  float b = dot(tip, ray);
  float reach = sqrt(max(b * b + clearance, 0.0)) - b;
  vec3 d = normalize(tip + reach * ray);

  // Direction -> panorama.
  bool imaged = true;
  vec2 uv;
  if (equirectangular != 0) {
    uv = centre + scale * vec2(atan(d.x, d.z), atan(d.y, length(d.xz)));
  } else {
    imaged = d.z > 0.0;
    uv = centre + scale * d.xy / max(d.z, 1e-4);
  }
  vec2 dx = dFdx(uv), dy = dFdy(uv);
  if (wraps != 0) {
    dx.x -= round(dx.x);
    dy.x -= round(dy.x);
  } else {
    imaged = imaged && uv.x >= 0.0 && uv.x <= 1.0;
  }
  imaged = imaged && uv.y >= 0.0 && uv.y <= 1.0;
  float coverage = rimCoverage(r, windowRadius);
  vec3 colour = imaged && coverage > 0.0 ? panoramaColour(uv, dx * texels, dy * texels) : vec3(0.0);
  float h = imaged ? texture(relief, uv).r / radius : 0.0;

  // Depth of the relief's point in the direction that the colour comes from.
  float distance = clamp(radius * dot((1.0 - h) * d - tip, ray), 1.001 * nearest, farthest);
  float stored = storedDepth(distance);

  vec3 shown;
  if (plain != 0) {
    shown = imaged ? colour : vec3(0.0);
  } else {
    // The panorama was lit when it was taken: what lies far fades, but nothing is lit a second time.
    vec3 lit = shoulder(colour * pow(min(lightAt(distance), 1.0), 1.0 / 2.2));
    shown = mix(endColour, lit, imaged ? smoothstep(0.0, 1.0, texture(imagedShare, uv).r) : 0.0) * softRim(r);
    float along = dot(offset, notch) - 0.925;
    float beside = abs(offset.x * notch.y - offset.y * notch.x);
    float mark = clamp((0.5 * along - beside) * 0.9 * windowRadius + 0.5, 0.0, 1.0);
    shown *= 1.0 - mark;
    if (mark > 0.5) stored = 0.0;
  }
  if (coverage <= 0.0) stored = 0.0;
  gl_FragDepth = stored;
  gl_FragData[0] = vec4(shown * coverage, 1.0);
}
)";

void SetUniform(vtkShaderProgram& program, const char* name, const glm::dvec3& value) {
  const float v[3] = {static_cast<float>(value.x), static_cast<float>(value.y),
                      static_cast<float>(value.z)};
  program.SetUniform3f(name, v);
}

void SetUniform(vtkShaderProgram& program, const char* name, const glm::dvec2& value) {
  const float v[2] = {static_cast<float>(value.x), static_cast<float>(value.y)};
  program.SetUniform2f(name, v);
}

void SetUniform(vtkShaderProgram& program, const char* name, double value) {
  program.SetUniformf(name, static_cast<float>(value));
}

}  // namespace

BackdropProp::BackdropProp() = default;
BackdropProp::~BackdropProp() = default;

double BackdropProp::light_reach() const { return kLightReach * backdrop_.radius; }

std::string BackdropProp::Upload(vtkOpenGLRenderWindow* window, const ColourImage& panorama,
                                 const DepthMap& depth, const Backdrop& backdrop) {
  backdrop_ = backdrop;
  panorama_size_ = {panorama.width, panorama.height};
  wraps_ = IsWholeTurn(backdrop.projection, panorama.width);
  light_ = MeasureLight(panorama, depth);
  GLint max_size = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &max_size);
  reduction_ = TextureReduction(panorama.width, panorama.height, max_size);
  const ColourImage reduced =
      reduction_ > 1 ? ReducedPanorama(panorama, reduction_) : ColourImage();
  const ColourImage& drawn = reduction_ > 1 ? reduced : panorama;
  panorama_->SetGenerateMipmap(true);
  panorama_->SetMaxLevel(
      static_cast<int>(std::floor(std::log2(std::max(drawn.width, drawn.height)))));
  panorama_->SetMaximumAnisotropicFiltering(1.0f);
  Fill(*panorama_, window, drawn.width, drawn.height, 3, VTK_UNSIGNED_CHAR, drawn.rgb.data());
  panorama_->SetMinificationFilter(vtkTextureObject::LinearMipmapLinear);
  panorama_->Bind();
  glGenerateMipmap(GL_TEXTURE_2D);
  UploadDepth(window, depth);
  if (reduction_ == 1) return {};
  return fmt::format(
      "the panorama of {}x{} pixels is drawn {} times smaller: this graphics card takes at most "
      "{} a side",
      panorama.width, panorama.height, reduction_, max_size);
}

void BackdropProp::UploadDepth(vtkOpenGLRenderWindow* window, const DepthMap& depth) {
  if (depth.empty()) {
    const float bare = 0.0f;
    Fill(*relief_, window, 1, 1, 1, VTK_FLOAT, &bare);
  } else {
    const std::vector<float> relief = ReliefTexture(depth, reduction_);
    Fill(*relief_, window, (depth.width + reduction_ - 1) / reduction_,
         (depth.height + reduction_ - 1) / reduction_, 1, VTK_FLOAT, relief.data());
  }
  const ImagedMask mask = MakeImagedMask(panorama_size_.x, panorama_size_.y, depth, wraps_);
  Fill(*imaged_, window, mask.width, mask.height, 1, VTK_UNSIGNED_CHAR, mask.share.data());
}

bool BackdropProp::SetGeometry(const Backdrop& backdrop) {
  if (IsWholeTurn(backdrop.projection, panorama_size_.x) != wraps_) return false;
  backdrop_ = backdrop;
  return true;
}

void BackdropProp::Fill(vtkTextureObject& texture, vtkOpenGLRenderWindow* window, int width,
                        int height, int channels, int type, const void* data) const {
  texture.ReleaseGraphicsResources(window);
  texture.SetContext(window);
  texture.SetMinificationFilter(vtkTextureObject::Linear);
  texture.SetMagnificationFilter(vtkTextureObject::Linear);
  texture.SetWrapS(wraps_ ? vtkTextureObject::Repeat : vtkTextureObject::ClampToEdge);
  texture.SetWrapT(vtkTextureObject::ClampToEdge);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  // VTK takes a non-const pointer but only reads.
  texture.Create2DFromRaw(static_cast<unsigned>(width), static_cast<unsigned>(height), channels,
                          type, const_cast<void*>(data));
}

void BackdropProp::SetPicture(const Picture& picture, int size) {
  picture_ = picture;
  size_ = size;
}

int BackdropProp::RenderOpaqueGeometry(vtkViewport* viewport) {
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(viewport->GetVTKWindow());
  if (!window || !panorama_->GetHandle()) return 0;
  if (!quad_) {
    const std::string source = std::string(kHead) + kDepthShader + kLightShader + kFilter + kMain;
    quad_ = std::make_unique<vtkOpenGLQuadHelper>(window, nullptr, source.c_str(), nullptr);
  } else {
    window->GetShaderCache()->ReadyShaderProgram(quad_->Program);
  }
  if (!quad_->Program) return 0;

  vtkOpenGLState* state = window->GetState();
  state->vtkglDisable(GL_BLEND);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDepthFunc(GL_ALWAYS);
  panorama_->Activate();
  relief_->Activate();
  imaged_->Activate();
  SetUniforms();
  quad_->Render();
  imaged_->Deactivate();
  relief_->Deactivate();
  panorama_->Deactivate();
  state->vtkglDepthFunc(GL_LEQUAL);
  return 1;
}

void BackdropProp::SetUniforms() {
  vtkShaderProgram& program = *quad_->Program;
  const simulation::ScopeView& view = picture_.view;
  const Projection& projection = backdrop_.projection;
  const bool equirectangular = projection.type == ProjectionType::kEquirectangular;
  // Double precision until here: 1 - |tip|² is a small difference when the tip nears the sphere.
  const glm::dvec3 tip = view.tip / backdrop_.radius;
  program.SetUniformi("panorama", panorama_->GetTextureUnit());
  program.SetUniformi("relief", relief_->GetTextureUnit());
  program.SetUniformi("imagedShare", imaged_->GetTextureUnit());
  SetUniform(program, "tip", tip);
  SetUniform(program, "clearance", 1.0 - glm::dot(tip, tip));
  SetUniform(program, "viewAxis", view.view);
  SetUniform(program, "upAxis", view.up);
  SetUniform(program, "rightAxis", view.right);
  SetUniform(program, "lensScale", std::sin(picture_.field_of_view / 4.0));
  SetUniform(program, "windowRadius", size_ / 2.0);
  program.SetUniformi("equirectangular", equirectangular ? 1 : 0);
  program.SetUniformi("wraps", wraps_ ? 1 : 0);
  program.SetUniformi("plain", picture_.plain ? 1 : 0);
  // Pixel (0, 0) is the middle of the first texel; the last texel may reach beyond the panorama.
  const glm::dvec2 texels = (panorama_size_ + (reduction_ - 1)) / reduction_;
  const glm::dvec2 covered = texels * double(reduction_);
  const double pixels =
      equirectangular ? DegreesFromRadians(projection.px_per_deg) : projection.focal_px;
  SetUniform(program, "centre", (projection.centre_px + 0.5) / covered);
  SetUniform(program, "scale", pixels / covered);
  SetUniform(program, "texels", texels);
  SetUniform(program, "samples", kSamples);
  SetUniform(program, "radius", backdrop_.radius);
  SetUniform(program, "nearest", kNearest);
  SetUniform(program, "farthest", kFarthest);
  SetUniform(program, "lightReach", light_reach());
  // Neutral and dark, but not the black of the window's surround.
  SetUniform(program, "endColour", glm::dvec3(0.105, 0.102, 0.1));
  SetUniform(program, "notch", glm::dvec2(std::sin(picture_.notch), std::cos(picture_.notch)));
}

void BackdropProp::ReleaseGraphicsResources(vtkWindow* window) {
  if (quad_) quad_->ReleaseGraphicsResources(window);
  quad_.reset();
  for (vtkTextureObject* texture : {panorama_.Get(), relief_.Get(), imaged_.Get()})
    texture->ReleaseGraphicsResources(window);
  Superclass::ReleaseGraphicsResources(window);
}

}  // namespace arthro::app
