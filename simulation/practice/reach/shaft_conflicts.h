// Conflicts of the two shafts as they are held: a shaft that passes through a tissue or through the
// relief of the backdrop, or the shafts that touch each other. Portal frame, m.
#pragma once

#include <memory>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/scene/files/loaded_scene.h"

namespace arthro::simulation {

inline constexpr double kShaftRadius = 2e-3;  // m, of a scope and of an instrument of 4 mm
// The end of an instrument is meant to touch tissue, and a lens to be near it.
inline constexpr double kFreeEnd = 4e-3;  // m
// A measured relief is no more exact than this, so that an axis may lie as deep below it.
inline constexpr double kReliefSlack = 1e-3;  // m

struct ShaftConflict {
  enum class Kind {
    kScopeInTissue,
    kInstrumentInTissue,
    kScopeInRelief,
    kInstrumentInRelief,
    kShaftsTouch
  } kind;
  int tissue = -1;        // -1 where the kind names none
  double depth = 0;       // m, from the portal of the shaft (of the scope) to the place
  glm::dvec3 place{0.0};  // on the axis of that shaft
};

// Relief of a scene, and its tissues with a search structure.
class ShaftObstacles {
 public:
  explicit ShaftObstacles(const LoadedScene& loaded);
  ~ShaftObstacles();
  ShaftObstacles(ShaftObstacles&&) noexcept;
  ShaftObstacles& operator=(ShaftObstacles&&) noexcept;

  // `lens` and `tip`: ends of the scope, whose portal is the origin, and of the instrument. Each
  // portal may lie in the wall of the joint: the part of a shaft up to its first free point is none
  // in the relief.
  std::vector<ShaftConflict> Find(const glm::dvec3& lens, const glm::dvec3& instrument_portal,
                                  const glm::dvec3& tip) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace arthro::simulation
