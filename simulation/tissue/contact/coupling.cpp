#include "simulation/tissue/contact/coupling.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace arthro::simulation {
namespace {

using Eigen::Matrix3d;

// Of a contact that is still open nothing is known but the tool's spring. Tissue as it is probed,
// 2.8 N for 1 mm [notes on deformables, 6], leaves 0.85 of 500 N/m, the softest presets half.
constexpr double kOpenStiffness = 0.7;

// How much less a contact takes of the stiffness across its normal than of that along it.
constexpr double kAcross = 1e-2;

constexpr double kSilence = 0.1, kFade = 0.05;  // s [notes on haptics, 3: watchdogs]

bool IsFinite(const glm::dvec3& x) noexcept { return std::isfinite(x.x + x.y + x.z); }

Matrix3d ToEigen(const glm::dmat3& m) noexcept {
  Matrix3d result;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) result(row, column) = m[column][row];
  return result;
}

glm::dmat3 ToGlm(const Matrix3d& m) noexcept {
  glm::dmat3 result;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) result[column][row] = m(row, column);
  return result;
}

// f(m) of a symmetric matrix through its eigenvalues.
template <class Function>
Matrix3d OfEigenvalues(const Matrix3d& m, Function&& f) noexcept {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(m);
  const Eigen::Vector3d values = solver.eigenvalues().unaryExpr(f);
  return solver.eigenvectors() * values.asDiagonal() * solver.eigenvectors().transpose();
}

Matrix3d Shape(const ContactPoint& contact) noexcept {
  const Eigen::Vector3d n(contact.normal.x, contact.normal.y, contact.normal.z);
  return contact.stiffness * ((1.0 - kAcross) * n * n.transpose() + kAcross * Matrix3d::Identity());
}

bool IsClosed(const ContactPoint& contact, const ContactResult& result) noexcept {
  return glm::dot(result.force, contact.normal) > 0.0;
}

void Keep(ToolCoupling& coupling, const TissueContact& contact) noexcept {
  if (coupling.count < kMaxToolContacts) {
    coupling.contact[static_cast<std::size_t>(coupling.count++)] = contact;
    return;
  }
  const auto push = [](const TissueContact& c) noexcept { return glm::dot(c.force, c.normal); };
  auto least = std::min_element(
      coupling.contact.begin(), coupling.contact.end(),
      [&](const TissueContact& a, const TissueContact& b) noexcept { return push(a) < push(b); });
  if (push(contact) > push(*least)) *least = contact;
}

// Where `from` and what was left of it go over into `to`.
CoupledForce Mixed(const CouplingBlend& blend, const glm::dvec3& tip) noexcept {
  CoupledForce now = ForceOf(blend.to, tip);
  if (blend.share >= 1.0) return now;
  const CoupledForce before = ForceOf(blend.from, tip);
  if (now.tissue < 0) now.tissue = before.tissue;
  now.force = blend.share * now.force + (1.0 - blend.share) * (before.force + blend.left);
  return now;
}

}  // namespace

bool IsFinite(const ToolCoupling& coupling) noexcept {
  if (!IsFinite(coupling.tip) || coupling.count < 0 || coupling.count > kMaxToolContacts)
    return false;
  for (int i = 0; i < coupling.count; ++i) {
    const TissueContact& c = coupling.contact[static_cast<std::size_t>(i)];
    if (!IsFinite(c.force) || !IsFinite(c.normal) || !std::isfinite(c.friction) ||
        !IsFinite(c.stiffness[0] + c.stiffness[1] + c.stiffness[2]))
      return false;
  }
  return true;
}

// Each contact takes Kᵢ = T kᵢ (nᵢ nᵢᵀ + a little across) Tᵀ, with T such that the sum is K.
void AddContacts(std::span<const ContactPoint> contacts, std::span<const ContactResult> results,
                 int owner, const glm::dmat3& stiffness, double spring,
                 const glm::dquat& portal_from_body, int tissue, ToolCoupling& coupling) noexcept {
  const std::size_t count = std::min(contacts.size(), results.size());
  Matrix3d sum = Matrix3d::Zero();
  for (std::size_t i = 0; i < count; ++i)
    if (contacts[i].owner == owner && IsClosed(contacts[i], results[i])) sum += Shape(contacts[i]);
  const Matrix3d whole = 0.5 * (ToEigen(stiffness) + ToEigen(stiffness).transpose());
  if (!whole.allFinite() || !sum.allFinite()) {
    coupling.is_faulty = true;
    return;
  }
  const Matrix3d root =
      OfEigenvalues(whole, [spring](double v) { return std::sqrt(std::clamp(v, 0.0, spring)); });
  const Matrix3d spread =
      root * OfEigenvalues(sum, [](double v) { return v > 0.0 ? 1.0 / std::sqrt(v) : 0.0; });
  const Matrix3d turn = ToEigen(glm::mat3_cast(portal_from_body));

  for (std::size_t i = 0; i < count; ++i) {
    const ContactPoint& at = contacts[i];
    if (at.owner != owner) continue;
    TissueContact contact;
    contact.normal = portal_from_body * -at.normal;
    contact.friction = at.friction;
    contact.tissue = tissue;
    if (IsClosed(at, results[i])) {
      const Matrix3d part = turn * spread * Shape(at) * spread.transpose() * turn.transpose();
      contact.stiffness = ToGlm(0.5 * (part + part.transpose()));
      contact.force = portal_from_body * -results[i].force;
    } else {
      const double k = kOpenStiffness * at.stiffness;
      contact.stiffness = k * glm::outerProduct(contact.normal, contact.normal);
      contact.force = -k * std::max(0.0, results[i].gap) * contact.normal;
    }
    Keep(coupling, contact);
  }
  if (!IsFinite(coupling)) coupling.is_faulty = true;
}

CoupledForce ForceOf(const ToolCoupling& coupling, const glm::dvec3& tip) noexcept {
  CoupledForce result;
  if (coupling.is_faulty) return result;
  double largest = 0.0;
  for (int i = 0; i < std::clamp(coupling.count, 0, kMaxToolContacts); ++i) {
    const TissueContact& c = coupling.contact[static_cast<std::size_t>(i)];
    const glm::dvec3 force = c.force + c.stiffness * (coupling.tip - tip);
    const double push = glm::dot(c.normal, force);
    if (!(push > 0.0)) continue;
    const glm::dvec3 across = force - push * c.normal;
    const double drag = glm::length(across), most = c.friction * push;
    result.force += push * c.normal + (drag > most ? most / drag : 1.0) * across;
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
    blend.left = Mixed(blend, blend.tip).force - ForceOf(blend.to, blend.tip).force;
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
  CoupledForce force = Mixed(blend, tip);
  const double fade = std::clamp(1.0 - (blend.passed - kSilence) / kFade, 0.0, 1.0);
  if (fade < 1.0) force.force *= fade;
  if (fade <= 0.0) force.tissue = -1;
  return force;
}

}  // namespace arthro::simulation
