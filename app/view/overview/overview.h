// The author's view of the whole scene from outside: the relief of the backdrop as a bowl, portals,
// rods and the scope's field of view, the tissues, and a box to move, turn and scale the chosen
// one. Portal frame, m. Draws in the current OpenGL context into its own texture, and only when
// something changed.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/view/drawing/picture.h"
#include "simulation/scene/files/loaded_scene.h"
#include "simulation/scene/image.h"
#include "simulation/scene/scene.h"

namespace arthro::app {

struct OverviewTools {
  simulation::ScopeView scope;
  double field_of_view = std::numbers::pi / 2;
  std::optional<InstrumentView> instrument;
};

struct PointerEvent {
  enum class Kind { kMove, kPress, kRelease, kWheel };
  enum class Button { kLeft, kMiddle, kRight };
  Kind kind = Kind::kMove;
  double x = 0, y = 0;  // px from the picture's top-left
  Button button = Button::kLeft;
  double wheel = 0;  // steps away from the user
  bool shift = false, control = false;
};

// Faults of one kind on a tissue's surface, in its own frame, m; sRGB.
struct SurfaceMark {
  std::vector<std::array<glm::dvec3, 2>> edges;
  std::vector<std::array<glm::dvec3, 3>> triangles;
  glm::dvec3 colour{1.0};
};

class Overview {
 public:
  Overview();
  // The context in which it draws must still be current.
  ~Overview();
  Overview(const Overview&) = delete;
  Overview& operator=(const Overview&) = delete;

  // `depth`: of the panorama's shape, in pixels of any size; empty: the bare sphere.
  void SetBackdrop(const ColourImage& panorama, const DepthMap& depth, const Backdrop& backdrop);
  // Replaces the relief or the place of the present panorama.
  void SetRelief(const DepthMap& depth, const Backdrop& backdrop);
  void SetTissues(std::span<const Tissue> tissues, std::span<const SharedSurface> surfaces);
  void SetTissuePose(int index, const Pose& portal_from_tissue);
  // Like those of ArthroscopicView.
  bool SetTissueShape(int index, std::span<const glm::dvec3> positions,
                      std::span<const glm::dvec3> normals = {});
  void SetTissueSurface(int index, const SurfaceMesh& surface,
                        std::span<const std::uint8_t> fresh = {});
  void SetIncisionSpacing(double spacing);
  void SetTools(const OverviewTools& tools);
  // Words of the labels in another language, in the order of kLabels.
  static constexpr std::array<const char*, 5> kLabels = {"scope", "instrument", "x right", "y down",
                                                         "z in"};
  void SetLabels(const std::array<std::string, kLabels.size()>& words);
  // Rods, portals and labels; without them nothing hides the tissues.
  void ShowTools(bool is_shown);
  // A hidden tissue is neither drawn nor picked, and has no box.
  void ShowTissue(int index, bool is_shown);

  // Puts the box around a tissue; -1 removes it. A left drag that begins on its handle, in the
  // middle of the box, moves it across the picture, with Shift or Control turns it; a right drag
  // from there scales it.
  void ChooseTissue(int index);
  // Gives box and handle to a part of the chosen tissue, drawn translucent; nullptr gives them
  // back. While its handle is dragged the part stays as it is. Its pose may have another scale
  // than 1.
  void ShowPart(const SharedSurface& part, const Pose& portal_from_part);
  std::function<void(const Pose& pose, bool finished)> on_part;  // like on_pose, for the part
  // Axes of the handle's arms: those of the portal frame, or the tissue's own. A left drag that
  // begins on the end of an arm moves the tissue along it.
  enum class Arms { kPortal, kOwn };
  void ShowArms(Arms arms);
  // Points along the ring about an axis of the handle, px from the picture's top left; empty where
  // no tissue is chosen. A left drag that begins on a ring turns the tissue about that axis.
  std::vector<glm::dvec2> RingPlaces(int axis) const;
  // Steps of drags along arms (m) and about rings (rad); 0: none.
  double snap_step = 0, snap_turn = 0;
  // Ends of the arms, px from the picture's top left; empty where no tissue is chosen.
  std::vector<glm::dvec2> ArmPlaces() const;
  // The handle, px from the picture's top left; nothing where none is chosen or it is out of sight.
  std::optional<glm::dvec2> HandlePlace() const;
  static constexpr double kHandleRadius = 14.0;  // px at scale 1
  double handle_scale = 1.0;                     // pixels of the picture per pixel at scale 1
  // Balls of one tissue, in its own frame, the chosen one highlighted; -1: none are shown.
  void ShowBalls(int tissue, std::span<const Ball> balls, int chosen);
  // Loose bodies, in the portal frame; none: an empty list.
  void ShowLooseBodies(std::span<const Ball> bodies);
  // Marks on one tissue; none: an empty list.
  void ShowMarks(int tissue, std::span<const SurfaceMark> marks);
  // sRGB per vertex of the surface at hand; SetTissueSurface gives it its own colour again.
  void SetTissueColours(int index, std::span<const glm::dvec3> colours);
  // Place on a tissue's surface under a pixel, in the tissue's own frame.
  struct TissuePlace {
    int tissue = -1;
    glm::dvec3 x_in_tissue{0.0};
  };
  std::optional<TissuePlace> PickTissue(double x, double y) const;
  // The same for a hand that misses by up to `radius` px: the nearest pixel that shows tissue.
  std::optional<TissuePlace> PickTissueNear(double x, double y, double radius) const;
  // Line of sight through a pixel: from the camera, unit direction, pixels per radian there.
  struct Line {
    glm::dvec3 eye{0.0}, direction{0.0};
    double px_per_radian = 0;
  };
  Line LineThrough(double x, double y) const;
  // Pixel of a place; nothing for one behind the camera.
  std::optional<glm::dvec2> PixelOf(const glm::dvec3& x_in_portal) const;
  // The first one along a line in the portal frame, from a point to `way` beyond it.
  std::optional<TissuePlace> PickAlong(const glm::dvec3& from, const glm::dvec3& way) const;
  // Called while the box is dragged, with the pose that it asks for; `finished` with the last one.
  std::function<void(int tissue, const Pose& pose, bool finished)> on_pose;

  // Pointer events over the picture, and those of a drag that began there. Beside the handle: a
  // left drag turns the view, a middle drag shifts it, wheel and right drag zoom.
  void Handle(const PointerEvent& event);
  // The whole scene obliquely, or along an axis of the portal frame: as the operator looks in, from
  // above, and from the right.
  enum class Side { kWhole, kFront, kTop, kRight };
  void LookFrom(Side side);
  void ResetCamera() { LookFrom(Side::kWhole); }

  // Draws if the scene or the size changed; returns whether it drew.
  bool Render(int width, int height);
  unsigned int TextureId() const;  // RGBA, opaque, first row at the bottom
  ColourImage ReadPixels() const;

 private:
  // True where the event belongs to a drag along an arm.
  bool DragArm(const PointerEvent& event);
  bool DragRing(const PointerEvent& event);
  double RingAngle(const glm::dvec2& at) const;
  void PlaceHeld(const Pose& pose, bool is_finished);
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace arthro::app
