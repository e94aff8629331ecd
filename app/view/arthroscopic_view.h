// Picture of the arthroscope: the panorama through the exact geometry [method.md, Oblique view],
// with tissues and an instrument, in a round window. Draws in the current OpenGL context (3.2 core
// or later) into a texture of its own. Portal frame, m, rad.
//
// The backdrop is exact for every pixel. Models are warped per vertex with the same lens, so a
// straight edge is drawn as a chord: its error grows with the square of its angle (tests/app/view
// prints it). Depth is the distance from the tip along the pixel's ray. Without a relief search the
// surface counts as D − h in the direction that the pixel's colour comes from: colours then have no
// parallax, and hide models behind them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/view/drawing/picture.h"
#include "app/view/drawing/picture_cost.h"
#include "app/view/exposure/camera_exposure.h"
#include "simulation/scene/files/loaded_scene.h"
#include "simulation/tissue/body/tissue_look.h"

namespace arthro::app {

struct DrawnRelief;

class ArthroscopicView {
 public:
  ArthroscopicView();
  // The context in which it draws must still be current.
  ~ArthroscopicView();
  ArthroscopicView(const ArthroscopicView&) = delete;
  ArthroscopicView& operator=(const ArthroscopicView&) = delete;

  // An empty `depth` gives the bare sphere. notice() says what could not be shown as given.
  // `sigma`: standard error of the depth map, of its size; the relief is drawn without the noise
  // that it explains. Empty: not known. `made`: relief of these maps that was made beside the
  // window (backdrop/drawn_relief.h); null: it is made here.
  void SetBackdrop(const ColourImage& panorama, const DepthMap& depth, const Backdrop& backdrop,
                   const DepthMap& sigma = {}, const DrawnRelief* made = nullptr);
  // Replaces the relief of the same panorama, for a live preview: only the relief is uploaded.
  void SetDepth(const DepthMap& depth, const DepthMap& sigma = {},
                const DrawnRelief* made = nullptr);
  // Moves the same panorama and relief. Returns false, and does nothing, when the panorama would
  // begin or cease to cover a full turn: call SetBackdrop then.
  bool SetGeometry(const Backdrop& backdrop);
  // One surface per tissue, in its own frame; an empty one is not drawn.
  // Tissues without an entry in `looks` are plain.
  void SetTissues(std::span<const Tissue> tissues, std::span<const SharedSurface> surfaces,
                  std::span<const simulation::TissueLook> looks = {});
  // Deforms a tissue: as many vertices and unit normals as its surface has, in its own frame.
  // Computes normals when none are given. Returns whether anything moved; nothing is uploaded
  // otherwise.
  bool SetTissueShape(int index, std::span<const glm::dvec3> positions,
                      std::span<const glm::dvec3> normals = {});
  // Replaces the surface of one tissue after a cut. `fresh` (empty, or 1 for a vertex of a cut
  // face) marks what is drawn paler, like the inside of a tissue.
  void SetTissueSurface(int index, const SurfaceMesh& surface,
                        std::span<const std::uint8_t> fresh = {});
  void SetTissuePose(int index, const Pose& portal_from_tissue);
  // Loose bodies beside the tissues, in the portal frame; none: an empty list. Returns whether
  // anything changed.
  bool SetLooseBodies(std::span<const Ball> bodies);

  // Draws into the texture, size x size pixels; with a camera from `rays` times as many per axis.
  // The caller binds its own framebuffer, viewport and program afterwards. Throws
  // Error(kBadArgument) for disturbances out of range.
  void Render(const Picture& picture, int size);

  // Measures the stages of the next frames, which waits for OpenGL after each stage.
  void SetTimed(bool is_timed);
  // Cost of the last frame that was measured.
  const PictureCost& cost() const;

  // Waits until the last frame is drawn; OpenGL draws on after Render returns.
  void Finish() const;

  // OpenGL name of the texture with the last frame: RGBA, opaque, first row at the bottom.
  unsigned int TextureId() const;
  ColourImage ReadPixels() const;
  // Distance from the tip at each ray of the last frame, m; row-major from the top. 0 outside the
  // window and under its mark. Disturbances and camera do not change it.
  std::vector<float> ReadDistances() const;

  // Exposure of the last frame with a camera.
  const CameraExposure& exposure() const;

  // A sentence for the user, such as a reduced size of the panorama; empty when there is none.
  const std::string& notice() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace arthro::app
