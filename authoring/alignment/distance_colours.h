// Colours for the distances of a surface from the relief: white on it, blue in front of it, red
// behind it. sRGB, m.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "authoring/alignment/relief_distance.h"

namespace arthro::authoring {

inline constexpr double kFullColour = 3e-3;                     // m, distance of the full colour
inline constexpr glm::dvec3 kNoDistanceColour{0.5, 0.5, 0.52};  // beside what was imaged, or far

// `distance`: positive in front of the relief; NaN has kNoDistanceColour.
glm::dvec3 ColourOfDistance(double distance);

// One colour per vertex.
std::vector<glm::dvec3> DistanceColours(const ReliefTarget& relief, const SurfaceMesh& surface,
                                        const Pose& pose);

}  // namespace arthro::authoring
