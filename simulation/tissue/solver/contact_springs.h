// Springs of contact points (contact_point.h): energy, force and stiffness, each a 3×3 on the point
// given by its weights. A spring lies inside one element, so its stiffness is applied point by
// point and need not be assembled.
// A tool tied to its hand by a spring yields under all its contacts together. It is always in
// equilibrium, so the energy is a function of the tissue alone:
//   E(x) = min over p of ½ h p² + Σ eᵢ(xᵢ − p),  H = h I + Σ Kᵢ,
//   ∂²E/∂xᵢ∂xⱼ = Kᵢ δᵢⱼ − Kᵢ H⁻¹ Kⱼ
// m, N, J.
#pragma once

#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "simulation/tissue/contact/contact_point.h"

namespace arthro::simulation {

inline constexpr int kMostTools = 8;  // on one body

struct ContactSpring {
  const ContactPoint* contact = nullptr;
  glm::dmat3 stiffness{0.0};  // positive semidefinite
  // Negative semidefinite part of a round bar's stiffness, from the rotation of its normal as the
  // point moves.
  glm::dmat3 turn{0.0};
  glm::dvec3 force{0.0};  // on the tissue
  glm::dvec3 push{0.0};   // part of `force` without friction
  glm::dvec3 point{0.0};  // on the tissue
  double energy = 0;
  double gap = 0;
  bool bears = false;  // pushes or rubs
  int hold = -1;       // index among the tools' holds; −1: none
};

// Spring between a tool and its hand.
struct ToolHold {
  int owner = -1;
  double stiffness = 0;    // h, N/m
  glm::dvec3 offset{0.0};  // p
  glm::dmat3 give{0.0};    // H⁻¹, m/N
};

// Inverts a symmetric matrix; returns false if it is not positive definite.
bool InvertPositive(const glm::dmat3& m, glm::dmat3& inverse) noexcept;

// Returns Σ wᵢ xᵢ.
glm::dvec3 ContactPosition(const ContactPoint& contact, std::span<const glm::dvec3> x) noexcept;

// Returns k min(g, 0) ∇g on the tissue's point at `point` with the tool at p. The next iteration
// uses it as the normal force of friction.
glm::dvec3 PushOn(const ContactPoint& contact, const glm::dvec3& point,
                  const glm::dvec3& p) noexcept;

// Evaluates the spring, with friction under the given push: μλ f(|u|), f = s²/ε − s³/3ε² up to ε,
// then s − ε/3, for the slip u across that push [Li et al. 2020, eq. 14]. C¹; force and frame are
// lagged.
ContactSpring SpringAt(const ContactPoint& contact, const glm::dvec3& point, const glm::dvec3& p,
                       const glm::dvec3& pressing) noexcept;

// Finds the holds that contacts name, with p from the contacts. Allocates only if `holds` must
// grow.
void FindHolds(std::span<const ContactPoint> contacts, std::vector<ToolHold>& holds);

// Sets all springs with the tissue at x and the tools in equilibrium. Friction uses `pressing` (one
// per contact), which is updated if `renews`. Without `turns` only the positive part of their
// stiffness is used.
void SetSprings(std::span<const ContactPoint> contacts, std::span<const glm::dvec3> x, bool renews,
                bool turns, std::span<glm::dvec3> pressing, std::span<ToolHold> holds,
                std::span<ContactSpring> springs) noexcept;

// Returns the energy of all springs and holds.
double SpringEnergy(std::span<const ContactSpring> springs,
                    std::span<const ToolHold> holds) noexcept;

// Computes y += Jᵀ (K − K H⁻¹ K) J p.
void AddStiffness(std::span<const ContactSpring> springs, std::span<const ToolHold> holds,
                  std::span<const glm::dvec3> p, std::span<glm::dvec3> y) noexcept;

// Returns false if a value is not finite or if its nodes or its spring do not exist.
bool IsUsable(const ContactPoint& contact, int node_count) noexcept;

}  // namespace arthro::simulation
