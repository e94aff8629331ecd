#include "simulation/tissue/contact/coupling.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "simulation/core/finite.h"

namespace arthro::simulation {
namespace {

// Range of the exponent of force over depth: 1 for a flat end, 1.5 for a round one [Hertz], more
// for thin tissue. Outside this range the depth is not that of unpressed skin: another tool holds
// the skin, or it hangs loose.
constexpr double kLeastPower = 1.0, kMostPower = 2.0;

constexpr double kLongestHold = 0.02;  // m

// Radius around the touch within which the curvature is known; a tool that moves further in a frame
// has left.
constexpr double kBendReach = 2.5e-3;  // m

// Times the friction of one contact, from which a tool is wedged. Contacts around a tool that
// slides through a dent have a little more than one contact.
constexpr double kWedged = 2.0;

constexpr double kSilence = 0.1, kFade = 0.05;  // s [method.md, Tissue coupling]

// Returns |P| at the depth x.
double PushAt(const TissueContact& c, double x) noexcept {
  if (!(x > 0.0)) return 0.0;
  if (c.power == 1.0 || !(c.depth > 0.0)) return c.stiffness * x;
  const auto push = [&c](double deep) noexcept {
    return c.stiffness * c.depth / c.power * std::pow(deep / c.depth, c.power);
  };
  // Depth at which the push grows as fast as the hand's spring.
  const double most = c.depth * std::pow(c.spring / c.stiffness, 1.0 / (c.power - 1.0));
  return x < most ? push(x) : push(most) + c.spring * (x - most);
}

void Keep(ToolCoupling& coupling, const TissueContact& contact) noexcept {
  if (coupling.count < kMaxTouched) {
    coupling.contact[static_cast<std::size_t>(coupling.count++)] = contact;
    return;
  }
  const auto push = [](const TissueContact& c) noexcept { return PushAt(c, c.depth); };
  auto least = std::min_element(
      coupling.contact.begin(), coupling.contact.end(),
      [&](const TissueContact& a, const TissueContact& b) noexcept { return push(a) < push(b); });
  if (push(contact) > push(*least)) *least = contact;
}

// Returns `across` shortened to the length `most`.
glm::dvec3 AtMost(const glm::dvec3& across, double most) noexcept {
  const double length = glm::length(across);
  return length > most ? most / length * across : across;
}

struct ContactForce {
  double push = 0;        // N
  glm::dvec3 force{0.0};  // push and rub
};
ContactForce After(const TissueContact& c, const glm::dvec3& way) noexcept {
  const double deeper = -glm::dot(c.normal, way);
  const glm::dvec3 aside = AtMost(way + deeper * c.normal, kBendReach);
  const glm::dvec3 bend = c.curvature * aside;
  const double size = PushAt(c, c.depth + deeper + 0.5 * glm::dot(aside, bend));
  if (!(size > 0.0)) return {};
  const glm::dvec3 normal = glm::normalize(c.normal - bend);
  const glm::dvec3 pull = c.rub - c.spring * way;
  return {size, size * normal + AtMost(pull - glm::dot(pull, normal) * normal, c.friction * size)};
}

// Returns the fraction of the force left after a time without a new coupling.
double FadeFactor(const CouplingBlend& blend) noexcept {
  return std::clamp(1.0 - (blend.passed - kSilence) / kFade, 0.0, 1.0);
}

// Blends `from` and its remainder into `to`.
CoupledForce EvaluateBlend(const CouplingBlend& blend, const glm::dvec3& tip) noexcept {
  CoupledForce now = ForceOf(blend.to, tip);
  if (blend.share >= 1.0) return now;
  const CoupledForce before = ForceOf(blend.from, tip);
  if (now.tissue < 0) now.tissue = before.tissue;
  now.force = blend.share * now.force + (1.0 - blend.share) * (before.force + blend.left);
  return now;
}

}  // namespace

bool IsFinite(const ToolCoupling& coupling) noexcept {
  if (!IsFinite(coupling.tip) || coupling.count < 0 || coupling.count > kMaxTouched) return false;
  for (int i = 0; i < coupling.count; ++i) {
    const TissueContact& c = coupling.contact[static_cast<std::size_t>(i)];
    if (!IsFinite(c.normal) || !IsFinite(c.rub) ||
        !IsFinite(c.curvature[0] + c.curvature[1] + c.curvature[2]) ||
        !std::isfinite(c.stiffness + c.depth + c.power + c.spring + c.friction))
      return false;
  }
  return true;
}

BodyPush PushOf(std::span<const ContactPoint> contacts, std::span<const ContactResult> results,
                int owner) noexcept {
  const std::size_t count = std::min(contacts.size(), results.size());
  glm::dvec3 push(0.0), force(0.0);
  double friction = 0.0;
  std::size_t nearest = count;
  for (std::size_t i = 0; i < count; ++i) {
    if (contacts[i].owner != owner) continue;
    if (nearest == count || results[i].gap < results[nearest].gap) nearest = i;
    push -= results[i].push;
    force -= results[i].force;
    friction = std::max(friction, contacts[i].friction);
  }
  if (nearest == count) return {};
  // A wedged tool: its contacts push against one another, with more friction than one contact of
  // this push can have.
  if (glm::distance(force, push) > kWedged * friction * glm::length(push)) push = force;
  const double size = glm::length(push);
  return {size > 0.0 ? push / size : -contacts[nearest].normal, size};
}

void AddContacts(std::span<const ContactPoint> contacts, std::span<const ContactResult> results,
                 int owner, const TouchedSkin& skin, double spring,
                 const glm::dquat& portal_from_body, int tissue, ToolCoupling& coupling) noexcept {
  const std::size_t count = std::min(contacts.size(), results.size());
  const auto [normal, size] = PushOf(contacts, results, owner);
  if (normal == glm::dvec3(0.0)) return;
  TissueContact contact;
  glm::dvec3 rub = -size * normal;
  double gap = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    if (contacts[i].owner != owner) continue;
    gap = std::min(gap, results[i].gap);
    rub -= results[i].force;
    contact.friction = contacts[i].friction;
  }
  const double stiffness = skin.stiffness;
  // Keeps a minimum stiffness, so that a tool that a step found about to slip is still held for
  // some distance.
  contact.stiffness = std::clamp(stiffness, std::min(size / kLongestHold, spring), spring);
  contact.spring = spring;
  contact.tissue = tissue;
  if (size > 0.0 && contact.stiffness > 0.0) {
    contact.power = std::clamp(contact.stiffness * skin.depth / size, kLeastPower, kMostPower);
    contact.depth = contact.power * size / contact.stiffness;
  } else {
    contact.depth = -std::max(0.0, gap);
  }
  const glm::dmat3 turn = glm::mat3_cast(portal_from_body);
  contact.normal = turn * normal;
  contact.rub = turn * rub;
  const glm::dmat3 across = glm::dmat3(1.0) - glm::outerProduct(contact.normal, contact.normal);
  contact.curvature = across * turn * skin.curvature * glm::transpose(turn) * across;
  // A sideways motion turns the push by |P| C; the limit is the spring to the hand.
  const double sharpest = glm::length(contact.curvature[0]) + glm::length(contact.curvature[1]) +
                          glm::length(contact.curvature[2]);
  if (size * sharpest > spring) contact.curvature *= spring / (size * sharpest);
  if (!std::isfinite(stiffness) || !std::isfinite(size) || !std::isfinite(skin.depth))
    coupling.is_faulty = true;
  Keep(coupling, contact);
  if (!IsFinite(coupling)) coupling.is_faulty = true;
}

void AddMoved(const TissueContact& contact, const glm::dvec3& way,
              ToolCoupling& coupling) noexcept {
  TissueContact moved = contact;
  const double deeper = -glm::dot(contact.normal, way);
  const glm::dvec3 aside = AtMost(way + deeper * contact.normal, kBendReach);
  const glm::dvec3 bend = contact.curvature * aside;
  moved.normal = glm::normalize(contact.normal - bend);
  moved.depth = contact.depth + deeper + 0.5 * glm::dot(aside, bend);
  moved.rub = glm::dvec3(0.0);
  if (const double size = PushAt(contact, moved.depth); size > 0.0) {
    if (contact.depth > 0.0)
      moved.stiffness =
          std::min(contact.spring,
                   contact.stiffness * std::pow(moved.depth / contact.depth, contact.power - 1.0));
    moved.power = std::clamp(moved.stiffness * moved.depth / size, kLeastPower, kMostPower);
    moved.depth = moved.power * size / moved.stiffness;
    const glm::dvec3 pull = contact.rub - contact.spring * way;
    moved.rub = AtMost(pull - glm::dot(pull, moved.normal) * moved.normal, contact.friction * size);
  }
  const glm::dmat3 across = glm::dmat3(1.0) - glm::outerProduct(moved.normal, moved.normal);
  moved.curvature = across * contact.curvature * across;
  Keep(coupling, moved);
  if (!IsFinite(coupling)) coupling.is_faulty = true;
}

const TissueContact* ContactWith(const ToolCoupling& coupling, int tissue) noexcept {
  for (int i = 0; i < coupling.count; ++i)
    if (const TissueContact& contact = coupling.contact[static_cast<std::size_t>(i)];
        contact.tissue == tissue)
      return &contact;
  return nullptr;
}

glm::dvec3 ForceOf(const TissueContact& contact, const glm::dvec3& way) noexcept {
  return After(contact, way).force;
}

CoupledForce ForceOf(const ToolCoupling& coupling, const glm::dvec3& tip) noexcept {
  CoupledForce result;
  if (coupling.is_faulty) return result;
  double largest = 0.0;
  const glm::dvec3 way = tip - coupling.tip;
  for (int i = 0; i < std::clamp(coupling.count, 0, kMaxTouched); ++i) {
    const TissueContact& c = coupling.contact[static_cast<std::size_t>(i)];
    const auto [push, force] = After(c, way);
    result.force += force;
    if (push > largest) {
      largest = push;
      result.tissue = c.tissue;
    }
  }
  return IsFinite(result.force) ? result : CoupledForce{};
}

void TakeCoupling(CouplingBlend& blend, const ToolCoupling& coupling) noexcept {
  if (coupling.is_faulty || !IsFinite(coupling)) {
    blend.from = blend.to = ToolCoupling{};
    blend.to.step = coupling.step;
    blend.to.is_faulty = true;
    blend.left = glm::dvec3(0.0);
  } else {
    // Starts from the force that is felt: after silence that is little or nothing.
    blend.left = FadeFactor(blend) * EvaluateBlend(blend, blend.tip).force -
                 ForceOf(blend.to, blend.tip).force;
    blend.from = blend.to;
    blend.to = coupling;
  }
  blend.passed = 0.0;
  blend.share = 0.0;
}

CoupledForce BlendedForce(CouplingBlend& blend, const glm::dvec3& tip, double dt,
                          double time) noexcept {
  blend.passed += std::max(dt, 0.0);
  blend.share = time > 0.0 ? std::min(1.0, blend.passed / time) : 1.0;
  blend.tip = tip;
  CoupledForce force = EvaluateBlend(blend, tip);
  const double fade = FadeFactor(blend);
  if (fade < 1.0) force.force *= fade;
  if (fade <= 0.0) force.tissue = -1;
  return force;
}

}  // namespace arthro::simulation
