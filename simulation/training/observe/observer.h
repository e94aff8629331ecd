// Sight of the targets of an exercise and of the instrument's tip [method.md, Sight of a target]:
// what the picture shows by the exact model of the scope, and neither relief, tissue, the drawn
// instrument, blood nor a fogged lens hides. Portal frame, m, rad.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "simulation/core/geometry/segment3.h"
#include "simulation/haptics/relief/depth_field.h"
#include "simulation/practice/scope_eye.h"
#include "simulation/scope/window_lens.h"
#include "simulation/tissue/contact/tool_shape.h"
#include "simulation/training/observe/attempt_frame.h"
#include "simulation/training/observe/target_place.h"

namespace arthro::simulation {

inline constexpr double kLeastTransmittance = 0.3;  // share of green light
inline constexpr double kMostFog = 0.5;             // strength, above which nothing is seen
inline constexpr double kSurfaceMargin = 5e-4;      // m before the target where the test ends

// Pose of the rod that a tool of a frame has, in its own portal.
RodPose HandOf(const ToolFrame& tool) noexcept;

class Observer {
 public:
  // `relief` and `eye` are those of the practice, and outlive this; the eye has the present shapes
  // of the tissues. Throws Error(kBadArgument) for more than kMostTargets.
  Observer(const LoadedScene& loaded, const std::vector<TargetPlace>& targets,
           const DepthField& relief, const ScopeEye& eye);

  // Moves the targets with the tissues. Ties those of a tissue that was cut to its new skin.
  // Allocates nothing.
  void Follow(const WorldPicture& world) noexcept;

  // Sets frame.lens and frame.sight from the other values of the frame. The places of loose bodies
  // are those that frame.sight has. Allocates nothing.
  void Observe(AttemptFrame& frame) const noexcept;

 private:
  struct Target {
    TargetPlace place;
    glm::dvec3 now{0.0}, normal{0.0};  // portal frame
    std::shared_ptr<const BodySkin> skin;
    std::array<int, 3> vertices{};  // vertices of the skin's triangle on which it lies
    glm::dvec3 at{0.0};             // barycentric coordinates
    bool is_gone = false;
  };
  struct Look {
    ScopeView view;
    glm::dvec3 lens;
    double haze;
    std::span<const Capsule> instrument;
  };
  static void Tie(Target& target, const std::shared_ptr<const BodySkin>& skin) noexcept;
  PointSight SightOf(const glm::dvec3& x, const glm::dvec3& normal,
                     const Look& look) const noexcept;
  bool IsHiddenByRelief(const Segment3& between) const noexcept;

  ScopeOptics optics_;
  std::vector<Target> targets_;
  std::vector<Rigid3> portal_from_body_;  // one per tissue
  const DepthField& relief_;
  const ScopeEye& eye_;
  std::array<ToolShape, static_cast<std::size_t>(ToolKind::kGrasper) + 1>
      shapes_;  // indexed by kind
};

}  // namespace arthro::simulation
