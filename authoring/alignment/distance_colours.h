// Colours for the distances of a surface from the relief: white on it, blue in front of it, red
// behind it. Contours of them: lines on the surface along which the distance is one of a few round
// values. sRGB, m.
#pragma once

#include <array>
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

// Positive in front of the relief, negative behind it; ascending.
inline constexpr std::array kContourLevels = {-2e-3, -1e-3, -0.5e-3, 0.0, 0.5e-3, 1e-3, 2e-3};

struct ContourSegment {
  glm::dvec3 from{0.0}, to{0.0};
  glm::dvec3 normal{0.0};  // outward normal of its triangle; not of unit length
};

// One list per level of `levels`, in the frame of the surface. `distances`: one per vertex; no line
// crosses a triangle with a NaN. A vertex at a level counts as above it.
std::vector<std::vector<ContourSegment>> ContoursOf(const SurfaceMesh& surface,
                                                    const std::vector<double>& distances,
                                                    const std::vector<double>& levels);

// The contours of kContourLevels.
std::vector<std::vector<ContourSegment>> DistanceContours(const ReliefTarget& relief,
                                                          const SurfaceMesh& surface,
                                                          const Pose& pose);

}  // namespace arthro::authoring
