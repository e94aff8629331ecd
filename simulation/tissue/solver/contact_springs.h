// The springs of contact points (contact_point.h): energy, force and stiffness, each a 3×3 on the
// point that its weights give. They lie inside one element; their stiffness is applied point by
// point and need not be assembled. A tool that is tied to its hand by a spring gives way under all
// of its contacts together: it always is where the forces on it balance, and what is left is a
// function of the tissue alone.
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

inline constexpr int kMostTools = 8;  // that hold one body

struct ContactSpring {
  const ContactPoint* contact = nullptr;
  glm::dmat3 stiffness{0.0};  // positive semidefinite
  // What a round bar's normal takes off it by turning as the point moves; negative semidefinite.
  glm::dmat3 turn{0.0};
  glm::dvec3 force{0.0};  // on the tissue
  glm::dvec3 push{0.0};   // of it, what is not friction
  glm::dvec3 point{0.0};  // the tissue's
  double energy = 0;
  double gap = 0;
  bool bears = false;  // pushes or rubs
  int hold = -1;       // index among the tools' holds; −1: none
};

// A tool between its contacts and its hand.
struct ToolHold {
  int owner = -1;
  double stiffness = 0;    // h, N/m
  glm::dvec3 offset{0.0};  // p
  glm::dmat3 give{0.0};    // H⁻¹, m/N
};

// False: a symmetric matrix that is not positive.
bool InvertPositive(const glm::dmat3& m, glm::dmat3& inverse) noexcept;

// Σ wᵢ xᵢ.
glm::dvec3 PointOf(const ContactPoint& contact, std::span<const glm::dvec3> x) noexcept;

// k min(g, 0) ∇g on the tissue's point at `point` with the tool at p: what friction of the next
// iteration leans on.
glm::dvec3 PushOn(const ContactPoint& contact, const glm::dvec3& point,
                  const glm::dvec3& p) noexcept;

// With friction under the given push: μλ f(|u|), f = s²/ε − s³/3ε² up to ε, then s − ε/3, the slip
// u across the push as it was given [Li et al. 2020, eq. 14]: C¹; lagged force and frame.
ContactSpring SpringAt(const ContactPoint& contact, const glm::dvec3& point, const glm::dvec3& p,
                       const glm::dvec3& pressing) noexcept;

// The holds that contacts name, each with p as they may have it. Allocates only where it must grow.
void FindHolds(std::span<const ContactPoint> contacts, std::vector<ToolHold>& holds);

// All springs with the tissue at x, tools where they balance, under friction by `pressing` (one a
// contact; renewed on the way where `renews`). Without `turns` only what is positive of their
// stiffness.
void SetSprings(std::span<const ContactPoint> contacts, std::span<const glm::dvec3> x, bool renews,
                bool turns, std::span<glm::dvec3> pressing, std::span<ToolHold> holds,
                std::span<ContactSpring> springs) noexcept;

// Of all springs and holds.
double EnergyOf(std::span<const ContactSpring> springs, std::span<const ToolHold> holds) noexcept;

// y += Jᵀ (K − K H⁻¹ K) J p.
void AddStiffness(std::span<const ContactSpring> springs, std::span<const ToolHold> holds,
                  std::span<const glm::dvec3> p, std::span<glm::dvec3> y) noexcept;

// False: something in it is not finite, its nodes or its spring do not exist.
bool IsUsable(const ContactPoint& contact, int node_count) noexcept;

}  // namespace arthro::simulation
