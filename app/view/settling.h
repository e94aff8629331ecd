// Places as they are drawn while a simulation runs: those that hardly move stay, so that the small
// cycles of a contact at rest are not seen, and others follow within a few frames. m.
#pragma once

#include <span>

#include <glm/vec3.hpp>

namespace arthro::app {

inline constexpr double kStill = 12e-6;     // m; a nearer place stays as it is drawn
inline constexpr double kFollowed = 40e-6;  // m; half of the way to a place so far off is taken

// Returns the share of the way to a place at this distance that is taken in a frame.
double SettlingShare(double distance);
// Moves the drawn place towards `now`.
void Settle(const glm::dvec3& now, glm::dvec3& drawn);
// Moves drawn places and normals of a skin, which has as many vertices as before. Returns whether
// all of them stayed.
bool Settle(std::span<const glm::dvec3> now, std::span<const glm::dvec3> normals_now,
            std::span<glm::dvec3> drawn, std::span<glm::dvec3> normals_drawn);

}  // namespace arthro::app
