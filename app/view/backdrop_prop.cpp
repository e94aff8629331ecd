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
uniform sampler2D reliefCeiling;  // m, of blocks of blockTexels
uniform sampler2D imagedShare;  // 1 well inside what was imaged
uniform vec3 tip;               // in radii of the sphere
uniform float clearance;        // 1 - |tip|^2, worked out in double
uniform vec3 viewAxis, upAxis, rightAxis;
uniform float lensScale;        // sin(fov/4)
uniform float windowRadius;     // px
uniform int wraps, plain;
uniform vec2 centre, scale;     // of the projection, in texture units
uniform vec2 texels;
const float kSharpness = 0.7;
uniform float samples;           // at most, a pixel
uniform float radius;           // m
uniform float nearest, farthest, lightReach;
uniform float highest;          // of the relief, in radii
uniform float blockTexels;
uniform float reliefSteps;      // at most, along a ray
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

// Where a ray first meets the relief, in radii along it. Nothing lies nearer to the portal than the
// relief's highest place; from that sphere out to the bare one a ray passes a block of texels at
// once where the relief around does not reach it, and an eighth of one where it may. Where it has
// gone behind the relief the place is closed in on.
constexpr const char* kRelief = R"(
#ifdef EQUIRECTANGULAR
vec2 panoramaPlace(vec3 d) {
  return centre + scale * vec2(atan(d.x, d.z), atan(d.y, length(d.xz)));
}
// How much finer the panorama is there than at its centre, at most.
float fineness(vec3 x, float far) { return inversesqrt(max(1.0 - x.y * x.y / far, 1e-4)); }
bool isBefore(vec3 d) { return true; }
#else
vec2 panoramaPlace(vec3 d) { return centre + scale * d.xy / max(d.z, 1e-4); }
float fineness(vec3 x, float far) { return far / max(x.z * x.z, 1e-4 * far); }
bool isBefore(vec3 d) { return d.z > 0.0; }
#endif
bool isImaged(vec3 d, vec2 uv) {
  return isBefore(d) && (wraps != 0 || abs(uv.x - 0.5) <= 0.5) && abs(uv.y - 0.5) <= 0.5;
}
// How far x is behind the relief, in radii.
float behind(vec3 x) {
  vec2 uv = panoramaPlace(x);
  return (isImaged(x, uv) ? textureLod(relief, uv, 0.0).r / radius : 0.0) - 1.0 + length(x);
}
// In radii; nothing within a block is higher.
float ceilingAt(vec2 uv) {
  ivec2 block = ivec2(uv * texels / blockTexels);
  return texelFetch(reliefCeiling, clamp(block, ivec2(0), textureSize(reliefCeiling, 0) - 1), 0).r / radius;
}
// Texels that x passes a radius on its way, at most.
float texelsARadius(vec3 x, vec3 ray) {
  float far = dot(x, x);
  float turn = length(cross(x, ray)) / far;
  return max(turn * fineness(x, far) * max(abs(scale.x) * texels.x, abs(scale.y) * texels.y), 1.0);
}
// The first crossing from `near` to `far`; beyond `far` where there is none. What stands under an if
// is done for every pixel on a processor, so there is little.
float firstBehind(vec3 ray, float b, float near, float far) {
  float least = (far - near) / reliefSteps;
  float low = near, high = near, gapLow = behind(tip + near * ray), gapHigh = gapLow;
  for (float i = 0.0; i < reliefSteps; i += 1.0) {
    low = high;
    gapLow = gapHigh;
    vec3 x = tip + low * ray;
    float pace = blockTexels / texelsARadius(x, ray);
    // To the end of the block, or to where the relief around begins.
    float ceiling = ceilingAt(panoramaPlace(x));
    float begins = sqrt(max(b * b + clearance + ceiling * (ceiling - 2.0), 0.0)) - b;
    float clear = ceiling < 1.0 - length(x) ? min(pace, begins - low) : 0.0;
    high = min(low + max(clear, max(0.125 * pace, least)), far);
    gapHigh = behind(tip + high * ray);
    if ((gapHigh >= 0.0 && gapLow < 0.0) || high >= far) break;
  }
  if (!(gapHigh >= 0.0 && gapLow < 0.0)) return 2.0 * far;
  for (int k = 0; k < 5; ++k) {
    float at = mix(low, high, clamp(gapLow / (gapLow - gapHigh), 0.05, 0.95));
    float gap = behind(tip + at * ray);
    bool is = gap >= 0.0;
    high = is ? at : high, gapHigh = is ? gap : gapHigh;
    low = is ? low : at, gapLow = is ? gapLow : gap;
  }
  return mix(low, high, gapLow / (gapLow - gapHigh));
}
float meetRelief(vec3 ray, float b, float sphere) {
  float inside = clearance + highest * (highest - 2.0);  // (1 - highest)^2 - |tip|^2
  float begins = sqrt(max(b * b + inside, 0.0)) - b;
  // A lens among the relief looks from where it is.
  return min(firstBehind(ray, b, inside >= 0.0 ? begins : 0.0, sphere), sphere);
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

  // Ray -> sphere -> direction from the portal -> panorama.
  float b = dot(tip, ray);
  float sphere = sqrt(max(b * b + clearance, 0.0)) - b;
  vec3 d = normalize(tip + sphere * ray);
  vec2 uv = panoramaPlace(d);
  // Of the smooth sphere: at the relief's outlines a pixel's neighbours are elsewhere.
  vec2 dx = dFdx(uv), dy = dFdy(uv);
  float coverage = rimCoverage(r, windowRadius);
  if (wraps != 0) {
    dx.x -= round(dx.x);
    dy.x -= round(dy.x);
  }
#ifdef RELIEF
  float reach = meetRelief(ray, b, sphere);
  d = normalize(tip + reach * ray);
  uv = panoramaPlace(d);
  dx *= reach / sphere;
  dy *= reach / sphere;
#endif
  bool imaged = isImaged(d, uv);
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
  const int width = depth.empty() ? 1 : (depth.width + reduction_ - 1) / reduction_;
  const int height = depth.empty() ? 1 : (depth.height + reduction_ - 1) / reduction_;
  const std::vector<float> relief =
      depth.empty() ? std::vector<float>(1, 0.0f) : ReliefTexture(depth, reduction_);
  Fill(*relief_, window, width, height, 1, VTK_FLOAT, relief.data());
  const ReliefCeiling ceiling = MakeReliefCeiling(relief, width, height, wraps_);
  Fill(*ceiling_, window, ceiling.width, ceiling.height, 1, VTK_FLOAT, ceiling.relief.data());
  ceiling_->SetMinificationFilter(vtkTextureObject::Nearest);
  ceiling_->SetMagnificationFilter(vtkTextureObject::Nearest);
  block_ = ceiling.block;
  highest_ = *std::max_element(ceiling.relief.begin(), ceiling.relief.end());
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
  // A processor goes both ways of every if of a shader, so what is not needed is not compiled.
  const bool is_equirectangular = backdrop_.projection.type == ProjectionType::kEquirectangular;
  const bool has_relief = highest_ > 0.0 && picture_.relief_steps > 0;
  const int variant = (is_equirectangular ? 1 : 0) + (has_relief ? 2 : 0);
  if (!quad_ || variant != variant_) {
    std::string source = kHead;
    if (is_equirectangular) source += "#define EQUIRECTANGULAR\n";
    if (has_relief) source += "#define RELIEF\n";
    source = source + kDepthShader + kLightShader + kFilter + kRelief + kMain;
    quad_ = std::make_unique<vtkOpenGLQuadHelper>(window, nullptr, source.c_str(), nullptr);
    variant_ = variant;
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
  ceiling_->Activate();
  imaged_->Activate();
  SetUniforms();
  quad_->Render();
  imaged_->Deactivate();
  ceiling_->Deactivate();
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
  program.SetUniformi("reliefCeiling", ceiling_->GetTextureUnit());
  program.SetUniformi("imagedShare", imaged_->GetTextureUnit());
  SetUniform(program, "tip", tip);
  SetUniform(program, "clearance", 1.0 - glm::dot(tip, tip));
  SetUniform(program, "viewAxis", view.view);
  SetUniform(program, "upAxis", view.up);
  SetUniform(program, "rightAxis", view.right);
  SetUniform(program, "lensScale", std::sin(picture_.field_of_view / 4.0));
  SetUniform(program, "windowRadius", size_ / 2.0);
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
  SetUniform(program, "highest", highest_ / backdrop_.radius);
  SetUniform(program, "blockTexels", block_);
  SetUniform(program, "reliefSteps", double(picture_.relief_steps));
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
  for (vtkTextureObject* texture : {panorama_.Get(), relief_.Get(), ceiling_.Get(), imaged_.Get()})
    texture->ReleaseGraphicsResources(window);
  Superclass::ReleaseGraphicsResources(window);
}

}  // namespace arthro::app
