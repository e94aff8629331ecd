// Shaft of an instrument against the backdrop: the straight line from the portal to the tip. A tip
// can be free while a ridge of the relief stands in the way of its shaft. The rod turns about its
// portal, so a shaft is held at a ridge by turning the rod out of it. The relief is a height field
// about the scope portal, so its normals lead over the ridge, and the shaft of the scope itself,
// which starts in that portal, never enters the relief beside its tip. Portal frame, m; noexcept,
// allocates nothing.
#pragma once

#include "simulation/haptics/relief/depth_field.h"

namespace arthro::simulation {

struct ShaftHold {
  glm::dvec3 tip{0.0};  // tip of the rod after the turn, or as asked for where no turn frees it
  double held = 0;      // m, way of the tip by the turn
  double through = 0;   // m, depth of the shaft in the backdrop where no turn frees it
  double weight = 0;    // weight of the relief that holds the shaft; 0: nothing is in its way
};

// Points of the axis of a shaft that are deeper than this are in its way.
inline constexpr double kShaftGraze = 1e-4;  // m
// The proxy of the tip keeps this part before the tip out of the relief.
inline constexpr double kShaftFree = 3e-3;  // m
// A shaft that would take the tip further aside has not slid over the ridge: it was led through it.
inline constexpr double kMostShaftWay = 1.2e-2;  // m

// Turns the rod about its portal until its shaft is free. The part from a portal in the relief to
// the first free point passes through the wall of the joint, and counts as free.
ShaftHold HoldShaft(const DepthField& field, const glm::dvec3& portal,
                    const glm::dvec3& tip) noexcept;

}  // namespace arthro::simulation
