// Picture of the arthroscope: the panorama through the exact geometry [method.md, Oblique view],
// with tissues and an instrument in it, in a round window. Draws in whatever OpenGL context is
// current (3.2 core or later) into its own texture. Portal frame, m, rad.
//
// The backdrop is exact for every pixel. Models are warped vertex by vertex with the same equisolid
// lens, so a straight edge is drawn as a chord: its error grows with the square of its angle
// (tests/app/view prints it). Depth is the distance from the tip along the pixel's ray; the relief
// counts as the surface at D − h in the direction that the pixel's colour comes from, so colours
// have no parallax and hide what lies behind them where they are seen.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/view/drawing/picture.h"
#include "simulation/scene/loaded_scene.h"

namespace arthro::app {

class ArthroscopicView {
 public:
  ArthroscopicView();
  // The context it draws in must still be current.
  ~ArthroscopicView();
  ArthroscopicView(const ArthroscopicView&) = delete;
  ArthroscopicView& operator=(const ArthroscopicView&) = delete;

  // `depth` may be empty: the bare sphere. Says in notice() what could not be shown as given.
  void SetBackdrop(const ColourImage& panorama, const DepthMap& depth, const Backdrop& backdrop);
  // Another relief for the same panorama, for a live preview: only it is uploaded.
  void SetDepth(const DepthMap& depth);
  // Another place for the same panorama and relief. False, and nothing done, where it would begin
  // or cease to be a whole turn: then SetBackdrop.
  bool SetGeometry(const Backdrop& backdrop);
  // One surface a tissue, in its own frame; an empty one is not drawn.
  void SetTissues(std::span<const Tissue> tissues, std::span<const SharedSurface> surfaces);
  // A tissue as it is deformed: as many vertices and unit normals as its surface has, in its own
  // frame. Without normals they are computed. Nothing is uploaded where nothing moved; says whether
  // something did.
  bool SetTissueShape(int index, std::span<const glm::dvec3> positions,
                      std::span<const glm::dvec3> normals = {});
  // Another surface for one tissue: it was cut. `fresh` (empty, or 1 a vertex of a cut face) is
  // drawn paler, as the inside of a tissue is.
  void SetTissueSurface(int index, const SurfaceMesh& surface,
                        std::span<const std::uint8_t> fresh = {});
  void SetTissuePose(int index, const Pose& portal_from_tissue);

  // Draws into the texture, size x size pixels. The caller binds its own framebuffer,
  // viewport and program afterwards. Throws Error(kBadArgument) for disturbances that are none.
  void Render(const Picture& picture, int size);

  // Returns when the last frame is drawn, which goes on behind Render's back.
  void Finish() const;

  // The last frame, as an OpenGL texture name: RGBA, opaque, first row at the bottom.
  unsigned int TextureId() const;
  ColourImage ReadPixels() const;
  // Distance from the tip at each pixel of the last frame, m; row-major from the top. 0 outside the
  // window and under its mark. Disturbances change none.
  std::vector<float> ReadDistances() const;

  // A sentence for the user, e.g. that the panorama was drawn smaller; empty when all is well.
  const std::string& notice() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace arthro::app
