// Loose bodies of an exercise: balls that the grasper carries. Jaws that close to less than
// kGraspOpening with their tip within kGraspReach of a ball hold it. When they open it sinks along
// gravity, +y, slides along relief and tissues, and comes to rest. It is kinematic: it presses
// nothing, and tissues hold it as they are at rest. A body that is let go at its goal has left the
// joint and stays there. Portal frame, m, s.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "simulation/haptics/relief/depth_field.h"
#include "simulation/haptics/surface/surface_bvh.h"
#include "simulation/practice/snapshot.h"
#include "simulation/scene/files/loaded_scene.h"

namespace arthro::simulation {

inline constexpr double kGraspOpening = 0.3, kGraspReach = 1.5e-3;  // share, m
inline constexpr double kSinkSpeed = 0.03;  // m/s, of a body of 4 mm in saline, to one digit

struct LooseBody {
  glm::dvec3 place{0.0};  // place of its middle
  double radius = 0;
  bool is_held = false, is_at_rest = false;
};

class LooseBodies {
 public:
  // `relief` outlives this. `goals`: balls of the portal frame in which bodies stay.
  LooseBodies(const LoadedScene& loaded, std::vector<LooseBody> bodies, const DepthField& relief,
              std::vector<Ball> goals = {});

  // Advances by a tick of length dt, in which the hands were as in `snapshot`. Allocates nothing.
  void Tick(const Snapshot& snapshot, double dt) noexcept;

  std::span<const LooseBody> all() const noexcept { return bodies_; }

 private:
  void Sink(LooseBody& body, double dt) const noexcept;

  std::vector<LooseBody> bodies_;
  std::vector<Ball> goals_;
  const DepthField& relief_;
  std::vector<SurfaceBvh> tissues_;
  double opening_ = 1;               // opening in the tick before
  std::optional<std::size_t> held_;  // one at a time
  glm::dvec3 held_in_tool_{0.0};
};

}  // namespace arthro::simulation
