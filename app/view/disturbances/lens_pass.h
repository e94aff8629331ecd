// Second pass over a finished frame that disturbs it for training (disturbances.h). Reads the
// colours and stored depths of the frame, and draws into a texture of its own. Compiles and draws
// only what is on. Needs the OpenGL context of the window that drew the frame.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <vtkNew.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkTextureObject.h>

#include "app/view/drawing/passes/render_target.h"
#include "app/view/drawing/passes/shader_pass.h"
#include "app/view/drawing/picture.h"

class vtkOpenGLRenderWindow;
class vtkShaderProgram;

namespace arthro::app {

struct DriftingBit;

class LensPass {
 public:
  // `drawn` holds the frame of `picture`, size x size; `light_reach` is that of the models, m.
  void Draw(vtkOpenGLRenderWindow* window, const Picture& picture, double light_reach, int size);
  // Draws the flecks of the fluid into the frame itself, for a picture without disturbances. A copy
  // of the frame would cost more than the flecks.
  void DrawFlecks(vtkOpenGLRenderWindow* window, const Picture& picture, double light_reach,
                  int size);
  vtkOpenGLFramebufferObject& result() { return *target_.framebuffer; }
  void ReleaseGraphicsResources(vtkOpenGLRenderWindow* window);

 private:
  struct Frame;
  static Frame FrameOf(vtkOpenGLRenderWindow* window, const Picture& picture, double light_reach,
                       int size);
  // One per variant of a shader, made when it is first needed.
  using Pass = std::optional<ShaderPass>;
  static vtkShaderProgram* Ready(Pass& pass, const Frame& frame,
                                 const std::function<ShaderPass()>& make);
  void Gather(const Frame& frame, bool is_far_only);
  void Spread(const Frame& frame);
  void TakeMurk(const Frame& frame);
  void DrawBits(const Frame& frame, const std::vector<DriftingBit>& bits, Pass& pass,
                const char* file, bool shows_scene);
  void SetDisturbed(vtkShaderProgram& program, const Frame& frame) const;

  RenderTarget target_, gathered_, spread_;
  vtkNew<vtkOpenGLFramebufferObject> onto_;  // the frame's colours, without its depths
  vtkNew<vtkTextureObject> murk_;
  int murk_seed_ = -1;
  double murk_time_ = -1;
  std::vector<float> places_, looks_;  // bits as they are uploaded
  Pass spread_pass_;
  std::array<Pass, 2> gather_passes_;
  std::array<Pass, 8> flake_passes_, bubble_passes_;
  std::array<Pass, 32> disturb_passes_;
};

}  // namespace arthro::app
