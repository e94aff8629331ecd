// Eye of the arthroscope: the point from which its picture is drawn. The hand may push the tip into
// a surface, and the proxy of the tip may lie on one; the eye stays outside of relief, tissues and
// layers by the radius of the lens. It follows the tip as the proxy of a ball does
// (haptics/proxy.h), so it never jumps through a wall, and slides along what it meets. The rod of
// the picture leads from the portal to the eye. Portal frame, m.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/haptics/proxy.h"
#include "simulation/haptics/relief/depth_field.h"
#include "simulation/haptics/surface/moving_skin.h"
#include "simulation/practice/snapshot.h"
#include "simulation/scene/files/loaded_scene.h"
#include "simulation/tissue/body/tissue_world.h"

namespace arthro::simulation {

// Pose of the rod that leads from its portal to `eye`, for a hand that holds it at `pose`.
RodPose PoseThrough(const RodPose& pose, const glm::dvec3& eye) noexcept;

class ScopeEye {
 public:
  // Half the diameter of the tube, which is 4 mm.
  static constexpr double kLensRadius = 2e-3;  // m

  // Throws Error for an author's cut that cannot be made.
  explicit ScopeEye(const LoadedScene& loaded);

  // Takes the shapes of the tissues that have changed.
  void Follow(const WorldPicture& world);
  // Moves the eye after a tip, which the hand holds at `pose`, and returns the pose of the rod that
  // leads to it. The first time, and after a gap in the hand's samples, it enters from the portal.
  RodPose MoveTo(const RodPose& pose, const glm::dvec3& tip);
  RodPose MoveTo(const ToolState& scope) { return MoveTo(scope.pose, scope.proxy_in_portal); }
  void Leave() { last_goal_.reset(); }

  const glm::dvec3& position() const { return proxy_.position; }
  // Way from the tip of the last MoveTo to the eye; 0 before.
  glm::dvec3 beside() const { return last_goal_ ? proxy_.position - *last_goal_ : glm::dvec3(0.0); }

  // Returns true where a tissue lies between two points. The relief is left out.
  bool IsHiddenByTissue(const Segment3& between) const noexcept;

 private:
  struct Body {
    std::unique_ptr<MovingSkin> skin;  // null: the tissue has no surface
    std::shared_ptr<const BodySkin> shown;
    std::uint64_t shape = 0;
  };
  std::vector<Rigid3> portal_from_body_;  // one per tissue
  std::vector<Body> bodies_;              // one per tissue
  // Surroundings of the eye: the relief, and in place of the other meshes the skins of the tissues.
  DepthField no_field_;
  std::vector<SurfaceBvh> meshes_;
  std::vector<const SweptSurface*> instead_;
  std::vector<glm::dvec3> positions_;  // reused memory
  Proxy proxy_;
  std::optional<glm::dvec3> last_goal_;
};

}  // namespace arthro::simulation
