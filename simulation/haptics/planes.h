// Planes that bound free space near a proxy, and the nearest point of free space to a goal: the
// god-object method [Zilles & Salisbury 1995] with its constraint forces. m.
#pragma once

#include <array>

#include <glm/vec3.hpp>

namespace arthro::simulation {

// Free space is normal·x ≥ offset.
struct Plane {
  glm::dvec3 normal{0.0};  // unit
  double offset = 0;
  int contact = 0;    // surface of the plane, see snapshot.h
  double weight = 1;  // factor of its force, 0..1
};

struct PlaneSet {
  static constexpr int kCapacity = 4;  // the backdrop and three faces of meshes
  std::array<Plane, kCapacity> plane;
  int count = 0;

  // Adds a plane, or replaces an equal one up to rounding. Returns false where the set is full.
  bool Add(const Plane& added) noexcept;
};

// nearest = goal + Σ push[i]·normal[i], push ≥ 0.
struct NearestFree {
  glm::dvec3 nearest{0.0};
  std::array<double, PlaneSet::kCapacity> push{};
};

// Tries every active set of up to three planes; the one that satisfies all planes is the solution.
// Returns `otherwise` without pushes if rounding leaves none.
NearestFree NearestPoint(const PlaneSet& planes, const glm::dvec3& goal,
                         const glm::dvec3& otherwise) noexcept;

}  // namespace arthro::simulation
