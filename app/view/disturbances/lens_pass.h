// The second pass over a finished frame that disturbs it for training (disturbances.h): reads its
// colours and stored depths, draws into a texture of its own. Only what is on is compiled and
// drawn. Needs the OpenGL context of the window that drew the frame.
#pragma once

#include <memory>
#include <string>

#include <vtkNew.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkTextureObject.h>

#include "app/view/arthroscopic_view.h"

class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkShaderProgram;

namespace arthro::app {

struct DriftingBit;

class LensPass {
 public:
  LensPass();
  ~LensPass();
  // `drawn` holds the frame of `picture`, size x size; `light_reach` as the models have it, m.
  void Draw(vtkOpenGLRenderWindow* window, const Picture& picture, double light_reach, int size);
  vtkOpenGLFramebufferObject& result() { return *target_.framebuffer; }
  void ReleaseGraphicsResources(vtkOpenGLRenderWindow* window);

 private:
  // A texture to draw into.
  struct Target {
    vtkNew<vtkTextureObject> texture;
    vtkNew<vtkOpenGLFramebufferObject> framebuffer;
    int size = 0;
  };
  struct Frame;
  // A full-screen shader, compiled anew where its source is another.
  struct Quad {
    std::string source;
    std::unique_ptr<vtkOpenGLQuadHelper> helper;
  };
  static void Resize(Target& target, vtkOpenGLRenderWindow* window, int size, int levels);
  static vtkShaderProgram* Ready(Quad& quad, const Frame& frame, const std::string& source);
  void Gather(const Frame& frame, bool is_far_only);
  void Spread(const Frame& frame);
  void TakeMurk(const Frame& frame);
  void DrawBits(const Frame& frame, const std::vector<DriftingBit>& bits, const char* main);
  void SetDisturbed(vtkShaderProgram& program, const Frame& frame) const;

  Target target_, gathered_, spread_;
  vtkNew<vtkTextureObject> murk_;
  int murk_seed_ = -1;
  double murk_time_ = -1;
  Quad disturb_quad_, gather_quad_, spread_quad_;
  unsigned vertex_array_ = 0;  // empty: the bits' shader makes its own corners
};

}  // namespace arthro::app
