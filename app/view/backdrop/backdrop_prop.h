// Panorama behind everything: a polygon over the round window. Each pixel follows its own ray to
// the sphere around the portal, and from there into the panorama [method.md, Oblique view]. Writes
// the relief into the depth buffer, so that it occludes the models.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <vtkNew.h>
#include <vtkProp.h>

#include "app/view/backdrop/drawn_relief.h"
#include "app/view/backdrop/relief_cells.h"
#include "app/view/drawing/lens_model.h"
#include "app/view/drawing/picture.h"
#include "app/view/exposure/footage_light.h"

class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkTextureObject;

namespace arthro::app {

class BackdropProp : public vtkProp {
 public:
  static BackdropProp* New();
  vtkTypeMacro(BackdropProp, vtkProp);

  // Uploads both pictures; the window's context must be current and initialised. Returns a sentence
  // when the panorama had to be reduced. `sigma`: standard error of the depth map, of its size; the
  // relief is drawn without the noise that it explains. Empty: not known. `made`: relief of these
  // maps that was made before; null: it is made here.
  std::string Upload(vtkOpenGLRenderWindow* window, const ColourImage& panorama,
                     const DepthMap& depth, const Backdrop& backdrop, const DepthMap& sigma,
                     const DrawnRelief* made);
  // Replaces the relief of the present panorama: a fraction of the work.
  void UploadDepth(vtkOpenGLRenderWindow* window, const DepthMap& depth, const DepthMap& sigma,
                   const DrawnRelief* made);
  // Moves the present panorama; uploads nothing. Returns false, and does nothing, when it would
  // begin or cease to cover a full turn.
  bool SetGeometry(const Backdrop& backdrop);
  // `shade` is that of the visible instrument; `models` is what the automatic gain meters.
  void SetPicture(const Picture& picture, int size, const LensShade& shade,
                  const MeteredModels& models);

  // Light of the footage, for the models.
  const FootageLight& footage_light() const { return light_; }
  // Distance at which the light is neutral, m.
  double light_reach() const;
  // Light around a direction from the portal, for a model there.
  FootageLight LightAbout(const glm::dvec3& direction) const;
  // Camera gain of the present picture; 1 when the footage's light counts.
  double gain() const { return gain_; }
  double relight() const { return backdrop_.relight; }
  Medium medium() const { return backdrop_.medium; }
  bool is_footage() const { return !backdrop_.footage.empty(); }
  // Height of the lowest step that the error of the depth map does not explain, m; 0: not known.
  double least_side() const { return least_side_; }
  // Binds the relief for the models of the present picture, until EndContact.
  ReliefContact BeginContact();
  void EndContact();

  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  vtkTypeBool HasTranslucentPolygonalGeometry() override { return 0; }
  void ReleaseGraphicsResources(vtkWindow* window) override;

 protected:
  BackdropProp();
  ~BackdropProp() override;

 private:
  void SetUniforms(vtkShaderProgram& program) const;
  // Centre and scale of the projection, texture units.
  std::pair<glm::dvec2, glm::dvec2> ProjectionInTexture() const;
  void Fill(vtkTextureObject& texture, vtkOpenGLRenderWindow* window, int width, int height,
            int channels, int type, const void* data) const;

  Backdrop backdrop_;
  Picture picture_;
  LensShade shade_;
  int size_ = 0;
  glm::ivec2 panorama_size_{0};
  int reduction_ = 1;   // panorama pixels per texel and axis
  bool wraps_ = false;  // full turn: left and right edge meet
  bool is_in_contact_ = false;
  bool is_noisy_ = false;  // the relief has a known standard error
  double least_side_ = 0;  // m, height of the lowest step that has a side; 0: no limit
  double highest_ = 0;     // maximum of the relief, m
  int block_ = 1;          // texels per block of the relief's maxima
  LightGrid grid_;
  FootageLight light_;
  double gain_ = 1;
  vtkNew<vtkTextureObject> panorama_, relief_, ceiling_, slopes_;
  ReliefCells cells_;
  std::array<std::optional<ShaderPass>, 256> passes_;  // one per variant of the shader
};

}  // namespace arthro::app
