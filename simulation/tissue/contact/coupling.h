// What the servo needs to know of the tissue between two steps of it, for each tissue that the tool
// touches: how hard it was pushed, how that grows with depth, how the skin bends where it is
// touched, and how it was rubbed. A tool that slides takes its dent along: what counts is how deep
// it is below the skin as that is where nothing presses it, and which way that skin faces there.
//   d = tip − tip₀, s its part across n;  depth x = δ − n·d + ½ sᵀ C s
//   push P = P₀ (x/δ)^p along n − C s, none where x ≤ 0; K = p P₀/δ is the tissue's condensed
//   stiffness in series with the tool's own spring h [method.md, Tissue coupling], and no push
//   grows faster than h rub T = T₀ − h d across P, at most μ |P| long: the hand's spring h pulls
//   until the tool slips F(tip) = Σ P + T
// A plain value that goes through LatestValue. Portal frame, m, N. All of it is noexcept, allocates
// nothing and takes a fixed time.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "simulation/core/finite.h"
#include "simulation/tissue/contact/contact_point.h"

namespace arthro::simulation {

inline constexpr int kMaxTouched = 4;  // tissues at once

struct TissueContact {
  glm::dvec3 normal{0, 0, 1};  // n, unit, of the push on the tool
  double stiffness = 0;        // K, N/m
  double depth = 0;            // δ; negative: still open, so far off
  double power = 1;            // p
  glm::dmat3 curvature{0.0};   // C, 1/m, symmetric, C n = 0; positive: a hollow
  glm::dvec3 rub{0.0};         // T₀
  double spring = 0;           // h, N/m
  double friction = 0;         // μ
  int tissue = -1;             // index in the scene
};

struct ToolCoupling {
  std::uint64_t step = 0;  // which tissue step this is of; 0: none yet
  glm::dvec3 tip{0.0};     // tip₀, the tip that the step was solved with
  int count = 0;
  std::array<TissueContact, kMaxTouched> contact{};
  bool is_faulty = false;  // a body was reset: no force from it
};

// False: something in it is not a number or an infinity.
using arthro::IsFinite;
bool IsFinite(const ToolCoupling& coupling) noexcept;

// What there is under a tool apart from the step's forces, in the body's frame.
struct TouchedSkin {
  glm::dmat3 stiffness{0.0};  // of the tool as a whole, the tissue following; any matrix
  glm::dmat3 curvature{0.0};  // C, of the skin where nothing presses it
  double depth = 0;           // of the hand's tool below that skin, m; 0: not known
};

// Adds what one body gives a tool. `contacts` and `results` are those of its step, in its own
// frame; those of other owners are left out. `spring` is the tool's own. Where no contact bears
// the stiffness is that of the nearest as if it did. The rest of `coupling`, step and tip, is the
// caller's. Of more than kMaxTouched bodies those with most force are kept.
void AddContacts(std::span<const ContactPoint> contacts, std::span<const ContactResult> results,
                 int owner, const TouchedSkin& skin, double spring,
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
inline constexpr double kTissueFrame = 1.0 / 60.0;  // s, the usual `time`
CoupledForce BlendedForce(CouplingBlend& blend, const glm::dvec3& tip, double dt,
                          double time) noexcept;

}  // namespace arthro::simulation
