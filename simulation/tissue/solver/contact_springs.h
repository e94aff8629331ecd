// The springs of contact points (contact_point.h): energy, force and stiffness, each a 3×3 on the
// point that its weights give. They lie inside one element; their stiffness is applied point by
// point and need not be assembled. m, N, J.
#pragma once

#include <span>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "simulation/tissue/contact/contact_point.h"

namespace arthro::simulation {

struct ContactSpring {
  const ContactPoint* contact = nullptr;
  glm::dmat3 stiffness{0.0};  // positive semidefinite
  glm::dvec3 force{0.0};      // on the tissue
  double energy = 0;
  double gap = 0;
};

// Σ wᵢ xᵢ.
glm::dvec3 PointOf(const ContactPoint& contact, std::span<const glm::dvec3> x) noexcept;

// k min(g, 0), as a pressing force ≥ 0: what friction of the next iteration leans on.
double NormalForce(const ContactPoint& contact, std::span<const glm::dvec3> x) noexcept;

// At `x`, with friction under the given normal force: μλ f(|u|), f = s²/ε − s³/3ε² up to ε, then
// s − ε/3 [Li et al. 2020, IPC, eq. 14: C¹].
ContactSpring SpringAt(const ContactPoint& contact, std::span<const glm::dvec3> x,
                       double normal_force) noexcept;

// y += Jᵀ K J p.
void AddStiffness(std::span<const ContactSpring> springs, std::span<const glm::dvec3> p,
                  std::span<glm::dvec3> y) noexcept;

// False: something in it is not finite, its nodes or its spring do not exist.
bool IsUsable(const ContactPoint& contact, int node_count) noexcept;

}  // namespace arthro::simulation
