#include "app/view/backdrop/backdrop_prop.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <vtkObjectFactory.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkShaderProgram.h>
#include <vtkTextureObject.h>
#include <vtkViewport.h>
#include <vtk_glew.h>

#include "app/view/backdrop/colour_outlines.h"
#include "app/view/backdrop/relief_filling.h"
#include "app/view/drawing/passes/shader_text.h"
#include "app/view/exposure/automatic_gain.h"
#include "simulation/core/units.h"
#include "simulation/scene/medium.h"

namespace arthro::app {

vtkStandardNewMacro(BackdropProp);

namespace {

// Distance of neutral light in radii of the backdrop: a usual working distance.
constexpr double kLightReach = 0.55;

// Sheen of the fluid film straight from the lamp.
constexpr double kGlint = 0.30;

// Steps along the ray of a corner of cells, over those of a pixel's own search: a corner decides
// for all pixels of four cells, and is one ray for each of them.
constexpr double kCornerSteps = 3;
// Steps within the range of a cell, over the same: a crest that is thinner than a step is missed.
constexpr double kCellSteps = 0.75;

// Largest second difference of the corners' distances, over the distance, at which the relief of a
// cell counts as smooth.
constexpr double kSmoothBend = 0.02;

// Texels of three values with a fourth one, which is not read: a software rasteriser gathers four
// floats as one vector, and three one by one.
std::vector<float> InFours(const std::vector<float>& threes) {
  std::vector<float> fours(threes.size() / 3 * 4);
  for (std::size_t i = 0; i < threes.size() / 3; ++i) std::copy_n(&threes[3 * i], 3, &fours[4 * i]);
  return fours;
}

// The view in the frame of the projection's formulas, which the portal's is turned into about +z
// (Projection::roll). The sphere is the same in both.
simulation::ScopeView InPictureFrame(const simulation::ScopeView& view,
                                     const Projection& projection) {
  if (projection.roll == 0) return view;
  const glm::dquat turn = glm::angleAxis(-projection.roll, glm::dvec3(0, 0, 1));
  return {turn * view.tip, turn * view.view, turn * view.up, turn * view.right};
}

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
                                 const DepthMap& depth, const Backdrop& backdrop,
                                 const DepthMap& sigma, const DrawnRelief* made) {
  backdrop_ = backdrop;
  panorama_size_ = {panorama.width, panorama.height};
  wraps_ = IsWholeTurn(backdrop.projection, panorama.width);
  grid_ = MakeLightGrid(panorama, depth);
  const bool is_relit = backdrop.relight > 0;
  if (is_relit) EvenLight(grid_, backdrop.relight);
  light_ = MeasureLight(grid_);
  ColourImage whole = panorama;
  FillUnimaged(whole, depth);
  if (is_relit) whole = Evened(whole, grid_);
  GLint max_size = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &max_size);
  reduction_ = TextureReduction(panorama.width, panorama.height, max_size);
  // A smaller panorama is a mean of its texels and has no stairs.
  if (reduction_ == 1) SmoothColourOutlines(whole, depth, wraps_, sigma);
  const ColourImage reduced = reduction_ > 1 ? ReducedPanorama(whole, reduction_) : ColourImage();
  const ColourImage& drawn = reduction_ > 1 ? reduced : whole;
  panorama_->SetGenerateMipmap(true);
  panorama_->SetMaxLevel(
      static_cast<int>(std::floor(std::log2(std::max(drawn.width, drawn.height)))));
  panorama_->SetMaximumAnisotropicFiltering(1.0f);
  Fill(*panorama_, window, drawn.width, drawn.height, 3, VTK_UNSIGNED_CHAR, drawn.rgb.data());
  panorama_->SetMinificationFilter(vtkTextureObject::LinearMipmapLinear);
  panorama_->Bind();
  glGenerateMipmap(GL_TEXTURE_2D);
  UploadDepth(window, depth, sigma, made);
  if (reduction_ == 1) return {};
  return fmt::format(
      "the panorama of {}x{} pixels is drawn {} times smaller: this graphics card takes at most "
      "{} a side",
      panorama.width, panorama.height, reduction_, max_size);
}

void BackdropProp::UploadDepth(vtkOpenGLRenderWindow* window, const DepthMap& depth,
                               const DepthMap& sigma, const DrawnRelief* made) {
  if (made == nullptr) {
    const DrawnRelief relief = MakeDrawnRelief(panorama_size_, depth, sigma, backdrop_);
    UploadDepth(window, depth, sigma, &relief);
    return;
  }
  const ReliefTexture& relief = made->texture;
  Fill(*relief_, window, relief.width, relief.height, 4, VTK_FLOAT, relief.texels.data());
  if (backdrop_.relight > 0)
    Fill(*slopes_, window, made->slopes.width, made->slopes.height, 4, VTK_FLOAT,
         InFours(made->slopes.slopes).data());
  const ReliefCeiling& ceiling = made->ceiling;
  Fill(*ceiling_, window, ceiling.width, ceiling.height, 1, VTK_FLOAT, ceiling.relief.data());
  ceiling_->SetMinificationFilter(vtkTextureObject::Nearest);
  ceiling_->SetMagnificationFilter(vtkTextureObject::Nearest);
  block_ = ceiling.block;
  highest_ = *std::max_element(ceiling.relief.begin(), ceiling.relief.end());
  is_noisy_ = made->is_noisy;
  least_side_ = made->least_side;
  SetRelief(grid_, depth);
}

bool BackdropProp::SetGeometry(const Backdrop& backdrop) {
  if (IsWholeTurn(backdrop.projection, panorama_size_.x) != wraps_ ||
      backdrop.relight != backdrop_.relight)
    return false;
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

FootageLight BackdropProp::LightAbout(const glm::dvec3& direction) const {
  constexpr double kAround = 0.6;  // rad
  return MeasureLight(grid_, backdrop_.projection, direction, kAround);
}

void BackdropProp::SetPicture(const Picture& picture, int size, const LensShade& shade,
                              const MeteredModels& models) {
  picture_ = picture;
  size_ = size;
  shade_ = shade;
  gain_ = 1;
  if (backdrop_.relight > 0 && !picture.plain && !grid_.blocks.empty())
    gain_ = AutomaticGain(grid_, light_, backdrop_, picture.view,
                          {picture.field_of_view, picture.lens}, light_reach(), &models);
}

int BackdropProp::RenderOpaqueGeometry(vtkViewport* viewport) {
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(viewport->GetVTKWindow());
  if (!window || !panorama_->GetHandle()) return 0;
  // A software rasteriser executes both branches of a shader's `if`, so unused parts are not
  // compiled.
  const bool is_equirectangular = backdrop_.projection.type == ProjectionType::kEquirectangular;
  const bool has_relief = highest_ > 0.0 && picture_.relief.steps > 0;
  const bool has_cells = has_relief && picture_.relief.cell > 1;
  const bool has_lens = !simulation::IsEquisolid(picture_.lens);
  const bool is_relit = backdrop_.relight > 0 && !picture_.plain;
  const bool has_rod = shade_.rod.radius > 0 && !picture_.plain;
  std::vector<std::string> defines;
  std::size_t variant = 0, bit = 1;
  const auto define = [&](bool is_on, const char* name) {
    if (is_on) defines.push_back(name), variant |= bit;
    bit <<= 1;
  };
  define(is_equirectangular, "EQUIRECTANGULAR");
  define(has_lens, "LENS");
  define(wraps_, "WRAPS");
  relief_->Activate();
  if (has_relief) ceiling_->Activate();
  if (has_cells) {
    if (!cells_.Has(variant)) cells_.SetShaders(variant, defines);
    cells_.Draw(window, size_, picture_.relief.cell,
                [this](vtkShaderProgram& program) { SetUniforms(program); });
  }
  define(has_relief, "RELIEF");
  define(has_cells, "CELLS");
  define(picture_.plain, "PLAIN");
  define(is_relit, "RELIT");
  define(has_rod, "ROD");
  auto& pass = passes_[variant];
  if (!pass) pass.emplace(ShaderText("backdrop.glsl", defines), ShaderPass::Shape::kRound);
  vtkShaderProgram* program = pass->Ready(window);
  if (program == nullptr) return 0;

  vtkOpenGLState* state = window->GetState();
  state->vtkglDisable(GL_BLEND);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDepthFunc(GL_ALWAYS);
  panorama_->Activate();
  if (is_relit) slopes_->Activate();
  if (has_cells) cells_.cells()->Activate();
  SetUniforms(*program);
  if (is_relit) program->SetUniformi("broadSlopes", slopes_->GetTextureUnit());
  if (has_cells) program->SetUniformi("cells", cells_.cells()->GetTextureUnit());
  pass->Draw(size_);
  if (has_cells) cells_.cells()->Deactivate();
  if (is_relit) slopes_->Deactivate();
  panorama_->Deactivate();
  if (has_relief) ceiling_->Deactivate();
  if (!is_in_contact_) relief_->Deactivate();
  state->vtkglDepthFunc(GL_LEQUAL);
  // Models fade into the relief where they meet it, and steel beside the lens into what is behind
  // it.
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE,
                                GL_ONE_MINUS_SRC_ALPHA);
  return 1;
}

std::pair<glm::dvec2, glm::dvec2> BackdropProp::ProjectionInTexture() const {
  // Pixel (0, 0) is the middle of the first texel; the last texel may extend beyond the panorama.
  const glm::dvec2 texels = (panorama_size_ + (reduction_ - 1)) / reduction_;
  const glm::dvec2 covered = texels * double(reduction_);
  const Projection& projection = backdrop_.projection;
  const double pixels = projection.type == ProjectionType::kEquirectangular
                            ? DegreesFromRadians(projection.px_per_deg)
                            : projection.focal_px;
  return {(projection.centre_px + 0.5) / covered, pixels / covered};
}

ReliefContact BackdropProp::BeginContact() {
  ReliefContact contact;
  const simulation::ScopeView view = InPictureFrame(picture_.view, backdrop_.projection);
  contact.tip = view.tip;
  contact.right = view.right;
  contact.up = glm::cross(view.right, view.view);
  contact.ahead = view.view;
  if (!relief_->GetHandle() || picture_.relief.steps == 0 || picture_.plain) return contact;
  relief_->Activate();
  contact.texture_unit = relief_->GetTextureUnit();
  contact.radius = backdrop_.radius;
  std::tie(contact.centre, contact.scale) = ProjectionInTexture();
  contact.is_equirectangular = backdrop_.projection.type == ProjectionType::kEquirectangular;
  contact.wraps = wraps_;
  is_in_contact_ = true;
  return contact;
}

void BackdropProp::EndContact() {
  if (std::exchange(is_in_contact_, false)) relief_->Deactivate();
}

void BackdropProp::SetUniforms(vtkShaderProgram& program) const {
  const simulation::ScopeView view = InPictureFrame(picture_.view, backdrop_.projection);
  // Double precision until here: 1 - |tip|² is a small difference when the tip nears the sphere.
  const glm::dvec3 tip = view.tip / backdrop_.radius;
  program.SetUniformi("panorama", panorama_->GetTextureUnit());
  program.SetUniformi("relief", relief_->GetTextureUnit());
  if (ceiling_->GetHandle()) program.SetUniformi("reliefCeiling", ceiling_->GetTextureUnit());
  SetUniform(program, "given_tip", tip);
  SetUniform(program, "given_clearance", 1.0 - glm::dot(tip, tip));
  SetUniform(program, "given_viewAxis", view.view);
  SetUniform(program, "given_rightAxis", view.right);
  SetUniform(program, "given_lensScale", std::sin(picture_.field_of_view / 4.0));
  SetUniform(program, "given_windowRadius", size_ / 2.0);
  if (!simulation::IsEquisolid(picture_.lens)) {
    float inward[simulation::WindowLens::kTerms];
    std::transform(picture_.lens.inward.begin(), picture_.lens.inward.end(), inward,
                   [](double term) { return static_cast<float>(term); });
    program.SetUniform1fv("given_lensInward", simulation::WindowLens::kTerms, inward);
    SetUniform(program, "given_lensEnd", picture_.lens.end);
    SetUniform(program, "given_lensAxis", picture_.lens.axis);
  }
  const auto [centre, scale] = ProjectionInTexture();
  const glm::dvec2 texels = (panorama_size_ + (reduction_ - 1)) / reduction_;
  SetUniform(program, "given_centre", centre);
  SetUniform(program, "given_scale", scale);
  SetUniform(program, "given_texels", texels);
  SetUniform(program, "given_reliefTexels", glm::dvec2(relief_->GetWidth(), relief_->GetHeight()));
  SetUniform(program, "given_endTexels", kEndShare * std::max(texels.x, texels.y));
  SetUniform(program, "given_samples", double(picture_.samples));
  SetUniform(program, "given_radius", backdrop_.radius);
  SetUniform(program, "given_perRadius", 1.0 / backdrop_.radius);
  constexpr double kNoLimit = 1e-9;  // m
  SetUniform(program, "given_leastSide", std::max(least_side_, kNoLimit) / backdrop_.radius);
  SetUniform(program, "given_highest", highest_ / backdrop_.radius);
  SetUniform(program, "given_blockTexels", block_);
  const double steps = picture_.relief.steps;
  SetUniform(program, "given_reliefSteps", picture_.relief.cell > 1 ? kCornerSteps * steps : steps);
  SetUniform(program, "given_cellPixels", double(picture_.relief.cell));
  SetUniform(program, "given_cellSteps", kCellSteps * steps);
  SetUniform(program, "given_smoothBend", kSmoothBend);
  SetUniform(program, "given_lightReach", light_reach());
  SetUniform(program, "given_gain", gain_);
  SetUniform(program, "given_relit", backdrop_.relight);
  // Slopes whose noise is known are uncertain by more than a sharp glint is wide, so it spreads.
  SetUniform(program, "given_glints",
             is_noisy_ ? glm::dvec2(kGlint / 3, kGlint / 8) : glm::dvec2(kGlint, 0.0));
  SetUniform(program, "given_mirroredShare", MirroredShare(backdrop_.medium));
  SetUniform(program, "given_rodFrom", shade_.rod.from);
  SetUniform(program, "given_rodTo", shade_.rod.to);
  SetUniform(program, "given_rodRadius", shade_.rod.radius);
  SetUniform(program, "given_headFrom", shade_.head.from);
  SetUniform(program, "given_headTo", shade_.head.to);
  SetUniform(program, "given_headRadius", shade_.head.radius);
  SetUniform(program, "given_notch",
             glm::dvec2(std::sin(picture_.notch), std::cos(picture_.notch)));
}

void BackdropProp::ReleaseGraphicsResources(vtkWindow* window) {
  for (auto& pass : passes_) {
    if (pass) pass->ReleaseGraphicsResources();
    pass.reset();
  }
  cells_.ReleaseGraphicsResources(vtkOpenGLRenderWindow::SafeDownCast(window));
  for (vtkTextureObject* texture : {panorama_.Get(), relief_.Get(), ceiling_.Get(), slopes_.Get()})
    texture->ReleaseGraphicsResources(window);
  Superclass::ReleaseGraphicsResources(window);
}

}  // namespace arthro::app
