// The panorama behind everything: a full-screen quad whose every pixel follows its own ray to the
// sphere about the portal and from there into the panorama [method.md, Oblique view], and which
// writes the relief into the depth buffer for the models to be held against.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <vtkNew.h>
#include <vtkProp.h>

#include "app/view/backdrop/backdrop_texture.h"
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

  // Uploads both pictures; the window's context must be current and initialised. What had to be
  // changed for it (size) is said by the returned sentence.
  std::string Upload(vtkOpenGLRenderWindow* window, const ColourImage& panorama,
                     const DepthMap& depth, const Backdrop& backdrop);
  // Another relief for the panorama that is there: a fraction of the work.
  void UploadDepth(vtkOpenGLRenderWindow* window, const DepthMap& depth);
  // Another place for the panorama that is there; nothing is uploaded. False, and nothing done,
  // where it would begin or cease to be a whole turn.
  bool SetGeometry(const Backdrop& backdrop);
  // `shade`: of the instrument, where one is shown. `models`: what the gain sees of them.
  void SetPicture(const Picture& picture, int size, const LensShade& shade,
                  const MeteredModels& models);

  // As the models should take it.
  const FootageLight& footage_light() const { return light_; }
  // Distance at which the light is neutral, m.
  double light_reach() const;
  // What lies about a direction from the portal, for a model there.
  FootageLight LightAbout(const glm::dvec3& direction) const;
  // The camera's gain for the picture that was set; 1 where the footage's light counts.
  double gain() const { return gain_; }
  double relight() const { return backdrop_.relight; }

  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  vtkTypeBool HasTranslucentPolygonalGeometry() override { return 0; }
  void ReleaseGraphicsResources(vtkWindow* window) override;

 protected:
  BackdropProp();
  ~BackdropProp() override;

 private:
  void SetUniforms(vtkShaderProgram& program) const;
  // What the search for the relief needs, made for the first picture that searches.
  void PrepareSearch(vtkOpenGLRenderWindow* window);
  void Fill(vtkTextureObject& texture, vtkOpenGLRenderWindow* window, int width, int height,
            int channels, int type, const void* data) const;

  Backdrop backdrop_;
  Picture picture_;
  LensShade shade_;
  int size_ = 0;
  glm::ivec2 panorama_size_{0};
  int reduction_ = 1;   // panorama pixels a texel and axis
  bool wraps_ = false;  // a whole turn: left and right edge meet
  ReliefTexture unsearched_;
  double highest_ = 0;  // of the relief, m
  int block_ = 1;       // texels of the relief's ceiling
  LightGrid grid_;
  FootageLight light_;
  double gain_ = 1;
  vtkNew<vtkTextureObject> panorama_, relief_, ceiling_, slopes_;
  ReliefCells cells_;
  std::array<std::optional<ShaderPass>, 256> passes_;  // one a variant of the shader
};

}  // namespace arthro::app
