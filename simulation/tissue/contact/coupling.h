// What the servo needs to know of the tissue between two steps of it: for each contact where the
// tool was, which force the tissue then gave, its normal and how stiff it is there, from the
// condensed compliance J A⁻¹ Jᵀ in series with the tool's own spring [notes on deformables, 4d].
//   F(tip) = Σ  max(0, nᵢ·fᵢ) nᵢ + friction part of fᵢ,   fᵢ = F₀ᵢ + Kᵢ (tip₀ − tip)
// A plain value that goes through LatestValue. Portal frame, m, N. Evaluating is noexcept and takes
// a fixed time.
#pragma once

#include <array>
#include <cstdint>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace arthro::simulation {

inline constexpr int kMaxToolContacts = 8;

struct TissueContact {
  glm::dvec3 force{0.0};       // F₀ on the tool
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

struct CoupledForce {
  glm::dvec3 force{0.0};  // on the tool's tip
  int tissue = -1;        // of the largest part; −1: none
};
CoupledForce ForceOf(const ToolCoupling& coupling, const glm::dvec3& tip) noexcept;

// Between the last coupling and a new one: the force goes over evenly in `time`, so that a step of
// the tissue is not felt as a tick.
struct CouplingBlend {
  ToolCoupling from, to;
  double passed = 0;  // s since `to` came
};
void TakeCoupling(CouplingBlend& blend, const ToolCoupling& coupling) noexcept;
CoupledForce BlendedForce(CouplingBlend& blend, const glm::dvec3& tip, double dt,
                          double time) noexcept;

}  // namespace arthro::simulation
