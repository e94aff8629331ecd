// What the servo needs to know of the tissue between two steps of it: for each contact where the
// tool was, which force the tissue then gave, its normal and how stiff it is there, the tissue's
// condensed stiffness in series with the tool's own spring [notes on deformables, 4d].
//   F(tip) = Σ pᵢ nᵢ + tᵢ,  fᵢ = F₀ᵢ + Kᵢ (tip₀ − tip),  pᵢ = max(0, nᵢ·fᵢ),
//   tᵢ: the part of fᵢ across nᵢ, at most μ pᵢ long
// A plain value that goes through LatestValue. Portal frame, m, N. All of it is noexcept, allocates
// nothing and takes a fixed time.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "simulation/tissue/contact/contact_point.h"

namespace arthro::simulation {

inline constexpr int kMaxToolContacts = 8;

struct TissueContact {
  // F₀ on the tool. Of a contact that is still open it pulls: K times the way to go.
  glm::dvec3 force{0.0};
  glm::dvec3 normal{0, 0, 1};  // unit, from the tissue to the tool
  glm::dmat3 stiffness{0.0};   // K, N/m, symmetric positive semidefinite
  double friction = 0;
  int tissue = -1;  // index in the scene
};

struct ToolCoupling {
  std::uint64_t step = 0;  // which tissue step this is of; 0: none yet
  glm::dvec3 tip{0.0};     // tip₀, the tip that the step was solved with
  int count = 0;
  std::array<TissueContact, kMaxToolContacts> contact{};
  bool is_faulty = false;  // a body was reset: no force from it
};

// False: something in it is not a number or an infinity.
bool IsFinite(const ToolCoupling& coupling) noexcept;

// Adds what one body gives a tool. `contacts` and `results` are those of its step, in its own
// frame; those of other owners are left out. `stiffness` is of the tool as a whole, all its
// contacts moved together and the tissue following, also in the body's frame; it is made symmetric,
// its eigenvalues are kept within 0 and `spring` (the tool's own), and it is shared out so that the
// parts of closed contacts sum to it exactly, each positive semidefinite. The rest of `coupling`,
// step and tip, is the caller's. At most kMaxToolContacts are kept, those of more force first.
void AddContacts(std::span<const ContactPoint> contacts, std::span<const ContactResult> results,
                 int owner, const glm::dmat3& stiffness, double spring,
                 const glm::dquat& portal_from_body, int tissue, ToolCoupling& coupling) noexcept;

struct CoupledForce {
  glm::dvec3 force{0.0};  // on the tool's tip
  int tissue = -1;        // of the largest part; −1: none
};
// Zero for a faulty coupling, and where the tip is not a number.
CoupledForce ForceOf(const ToolCoupling& coupling, const glm::dvec3& tip) noexcept;

// From the last coupling to a new one: the force goes over evenly in `time`, so that a step of the
// tissue is not felt as a tick. Where the tip is when a coupling comes, the force does not change
// at all. A faulty one ends the force at once. With nothing new for 0.1 s the force fades in 0.05
// s.
struct CouplingBlend {
  ToolCoupling from, to;
  double passed = 0;     // s since `to` came
  double share = 1;      // of `to` in the force, at the last tip
  glm::dvec3 tip{0.0};   // the last one
  glm::dvec3 left{0.0};  // N beside `from`, of a blend that had not ended when `to` came
};
void TakeCoupling(CouplingBlend& blend, const ToolCoupling& coupling) noexcept;
CoupledForce BlendedForce(CouplingBlend& blend, const glm::dvec3& tip, double dt,
                          double time) noexcept;

}  // namespace arthro::simulation
