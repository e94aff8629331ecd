// Local tissue model for the servo between two tissue steps. For each touched tissue it holds the
// push, its growth with depth, the curvature of the skin and the friction. A tool that slides takes
// its dent along. Its depth and normal are therefore measured from the skin that nothing presses.
//   d = tip − tip₀, s its part across n;  depth x = δ − n·d + ½ sᵀ C s
//   push P = P₀ (x/δ)^p along n − C s, none for x ≤ 0
//   K = p P₀/δ is the tissue's condensed stiffness in series with the tool's spring h
//     [method.md, Tissue coupling]; no push grows faster than h
//   rub T = T₀ − h d across P, at most μ |P| long: the hand's spring h pulls until the tool slips
//   F(tip) = Σ P + T
// Plain values that pass through LatestValue. Portal frame, m, N. All functions are noexcept,
// allocate nothing and take bounded time.
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
  glm::dvec3 normal{0, 0, 1};  // n, unit, direction of the push on the tool
  double stiffness = 0;        // K, N/m
  double depth = 0;            // δ, m; negative: not in contact yet, distance to it
  double power = 1;            // p
  glm::dmat3 curvature{0.0};   // C, 1/m, symmetric, C n = 0; positive for a hollow
  glm::dvec3 rub{0.0};         // T₀
  double spring = 0;           // h, N/m
  double friction = 0;         // μ
  int tissue = -1;             // index in the scene
};

struct ToolCoupling {
  std::uint64_t step = 0;  // tissue step of this coupling; 0: none yet
  glm::dvec3 tip{0.0};     // tip₀, the tip for which the step was solved
  int count = 0;
  std::array<TissueContact, kMaxTouched> contact{};
  bool is_faulty = false;  // a body was reset: no force from it
};

using arthro::IsFinite;
// Returns false if any number is NaN or infinite.
bool IsFinite(const ToolCoupling& coupling) noexcept;

// Properties of the skin under a tool, apart from the step's forces, in the body's frame.
struct TouchedSkin {
  double stiffness = 0;       // along PushOf, the tissue following, N/m; may be any number
  glm::dmat3 curvature{0.0};  // C, of the unpressed skin
  double depth = 0;           // depth of the commanded tool below that skin, m; 0: unknown
};

// Push of one body on a tool, in the body's frame. Without a push, the direction is that of the
// nearest contact.
struct BodyPush {
  glm::dvec3 direction{0.0};  // unit; zero: no contact
  double size = 0;            // N
};
// Sums the contacts of a tool; the arguments are those of AddContacts. A tool wedged between
// contacts has the whole force of the step as its push, for its rub T₀ would exceed μ |P|.
BodyPush PushOf(std::span<const ContactPoint> contacts, std::span<const ContactResult> results,
                int owner) noexcept;

// Adds the contact of one body to a tool's coupling. `contacts` and `results` are those of its
// step, in its own frame; other owners' contacts are ignored. `spring` is the tool's. If no contact
// bears, the stiffness is that of the nearest one as if it did. The caller sets step and tip. Keeps
// the bodies with the largest forces if there are more than kMaxTouched.
void AddContacts(std::span<const ContactPoint> contacts, std::span<const ContactResult> results,
                 int owner, const TouchedSkin& skin, double spring,
                 const glm::dquat& portal_from_body, int tissue, ToolCoupling& coupling) noexcept;

// Adds the contact of a body that was not solved in this step, as it is after a motion of the tip
// by `way`, m. The force is that of the coupling of the last step at the new tip.
void AddMoved(const TissueContact& contact, const glm::dvec3& way, ToolCoupling& coupling) noexcept;

// Returns the contact with a tissue; nullptr: none.
const TissueContact* ContactWith(const ToolCoupling& coupling, int tissue) noexcept;

struct CoupledForce {
  glm::dvec3 force{0.0};  // on the tool's tip
  int tissue = -1;        // tissue with the largest part; −1: none
};
// Evaluates one contact after a motion of the tip by `way`, m, since the step.
glm::dvec3 ForceOf(const TissueContact& contact, const glm::dvec3& way) noexcept;
// Evaluates the coupling. Returns zero for a faulty coupling or a tip that is not finite.
CoupledForce ForceOf(const ToolCoupling& coupling, const glm::dvec3& tip) noexcept;

// Transition from the last coupling to a new one. The force is blended linearly over `time`, so
// that a tissue step is not felt as a tick. At the tip where a coupling arrives the force does not
// change at all. A faulty coupling ends the force at once. Without a new coupling for 0.1 s the
// force fades within 0.05 s.
struct CouplingBlend {
  ToolCoupling from, to;
  double passed = 0;     // s since `to` arrived
  double share = 1;      // blend weight of `to` at the last tip
  glm::dvec3 tip{0.0};   // the last tip
  glm::dvec3 left{0.0};  // N in addition to `from`, of a blend unfinished when `to` arrived
};
void TakeCoupling(CouplingBlend& blend, const ToolCoupling& coupling) noexcept;
inline constexpr double kTissueFrame = 1.0 / 60.0;  // s, the usual `time`
CoupledForce BlendedForce(CouplingBlend& blend, const glm::dvec3& tip, double dt,
                          double time) noexcept;

}  // namespace arthro::simulation
