// The panorama behind everything: a full-screen quad whose every pixel follows its own ray to the
// sphere about the portal and from there into the panorama [design §4], and which writes the relief
// into the depth buffer for the models to be held against.
#pragma once

#include <memory>
#include <string>

#include <vtkNew.h>
#include <vtkProp.h>

#include "app/view/arthroscopic_view.h"

class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
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
  void SetPicture(const Picture& picture, int size);

  // The light of the picture as the models should take it; linear, of the imaged part.
  const glm::dvec3& mean_colour() const { return mean_colour_; }
  const glm::dvec3& bright_colour() const { return bright_colour_; }
  // Distance at which the light is neutral, m.
  double light_reach() const;

  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  vtkTypeBool HasTranslucentPolygonalGeometry() override { return 0; }
  void ReleaseGraphicsResources(vtkWindow* window) override;

 protected:
  BackdropProp();
  ~BackdropProp() override;

 private:
  void SetUniforms();

  Backdrop backdrop_;
  Picture picture_;
  int size_ = 0;
  glm::dvec2 texture_pixels_{1.0};  // panorama pixels across the texture
  glm::dvec2 texels_{1.0};
  bool wraps_ = false;  // a whole turn: left and right edge meet
  glm::dvec3 mean_colour_{0.2}, bright_colour_{0.6};
  vtkNew<vtkTextureObject> panorama_, relief_;
  std::unique_ptr<vtkOpenGLQuadHelper> quad_;
};

}  // namespace arthro::app
