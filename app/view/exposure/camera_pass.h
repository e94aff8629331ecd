// Last pass over a picture: the camera behind the scope [method.md, Camera]. Meters the undisturbed
// picture, and draws the picture with exposure, lateral colour, sharpness and grain into a texture
// of its own. Compiles and draws only what is on. Needs the OpenGL context of the window.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <vtkNew.h>
#include <vtkRenderbuffer.h>

#include "app/view/drawing/lens_shade.h"
#include "app/view/drawing/passes/render_target.h"
#include "app/view/drawing/passes/shader_pass.h"
#include "app/view/drawing/picture.h"
#include "app/view/exposure/camera_exposure.h"

class vtkOpenGLRenderWindow;
class vtkShaderProgram;

namespace arthro::app {

class CameraPass {
 public:
  // Finds the exposure of the picture as it was drawn, picture.rays * size pixels a side.
  // `occlusion` (OcclusionPass::light) multiplies the picture; null: it is multiplied already.
  void Meter(vtkOpenGLRenderWindow* window, const Picture& picture, const LensShade& shade,
             vtkTextureObject& undisturbed, vtkTextureObject* occlusion);
  // Draws the picture that is shown, `finished`, of the same size, with the last exposure.
  void Draw(vtkOpenGLRenderWindow* window, const Picture& picture, vtkTextureObject& finished,
            vtkTextureObject* occlusion, int size);
  const CameraExposure& exposure() const { return exposure_; }  // exposure of the last picture
  vtkOpenGLFramebufferObject& result() { return *target_.framebuffer; }
  void ReleaseGraphicsResources(vtkOpenGLRenderWindow* window);

 private:
  using Pass = std::optional<ShaderPass>;
  enum class Edges { kLeft, kMarked, kSmoothed };
  // Draws one variant of the camera's shader from `finished`; the depth test chooses the pixels.
  void Expose(vtkOpenGLRenderWindow* window, const Picture& picture, vtkTextureObject& finished,
              vtkTextureObject* occlusion, int size, Edges edges);
  void AttachMarks(vtkOpenGLRenderWindow* window);
  void DetachMarks();

  RenderTarget target_, metered_;
  vtkNew<vtkRenderbuffer> marks_;  // depth 1 at edges of the picture
  bool has_marks_ = false;         // the target has them as its depths, at its own size
  CameraExposure exposure_;
  std::vector<std::uint8_t> texels_;
  std::vector<MeteredPart> parts_;
  std::array<Pass, 2> meter_passes_;     // without and with occlusion
  std::array<Pass, 256> camera_passes_;  // one per variant of the shader
};

}  // namespace arthro::app
