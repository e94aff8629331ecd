#include "simulation/tissue/solver/contact_springs.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace arthro::simulation {
namespace {

bool IsFinite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

double GapOf(const ContactPoint& contact, const glm::dvec3& point) {
  return glm::dot(contact.normal, point - contact.foot);
}

}  // namespace

glm::dvec3 PointOf(const ContactPoint& contact, std::span<const glm::dvec3> x) noexcept {
  glm::dvec3 point(0.0);
  for (int i = 0; i < contact.count; ++i) point += contact.weight[i] * x[contact.node[i]];
  return point;
}

double NormalForce(const ContactPoint& contact, std::span<const glm::dvec3> x) noexcept {
  return -contact.stiffness * std::min(GapOf(contact, PointOf(contact, x)), 0.0);
}

ContactSpring SpringAt(const ContactPoint& contact, std::span<const glm::dvec3> x,
                       double normal_force) noexcept {
  ContactSpring spring;
  spring.contact = &contact;
  const glm::dvec3 point = PointOf(contact, x), n = contact.normal;
  const glm::dmat3 along_normal = glm::outerProduct(n, n);
  spring.gap = GapOf(contact, point);
  if (spring.gap < 0) {
    spring.energy = 0.5 * contact.stiffness * spring.gap * spring.gap;
    spring.force = -contact.stiffness * spring.gap * n;
    spring.stiffness = contact.stiffness * along_normal;
  }
  const double most = contact.friction * normal_force;
  if (!(most > 0)) return spring;
  const glm::dmat3 tangential = glm::dmat3(1.0) - along_normal;
  const glm::dvec3 slip = tangential * (point - contact.start);
  const double s = glm::length(slip), scale = contact.slip_scale;
  if (s < scale) {
    const double secant = 2.0 / scale - s / (scale * scale),
                 slope = 2.0 / scale * (1.0 - s / scale);
    spring.energy += most * s * s / scale * (1.0 - s / (3.0 * scale));
    spring.force -= most * secant * slip;
    spring.stiffness += most * secant * tangential;
    if (s > 0)
      spring.stiffness += most * (slope - secant) / (s * s) * glm::outerProduct(slip, slip);
  } else {
    spring.energy += most * (s - scale / 3.0);
    spring.force -= most / s * slip;
    spring.stiffness += most / s * (tangential - glm::outerProduct(slip, slip) / (s * s));
  }
  return spring;
}

void AddStiffness(std::span<const ContactSpring> springs, std::span<const glm::dvec3> p,
                  std::span<glm::dvec3> y) noexcept {
  for (const ContactSpring& spring : springs) {
    const ContactPoint& contact = *spring.contact;
    const glm::dvec3 pull = spring.stiffness * PointOf(contact, p);
    for (int i = 0; i < contact.count; ++i) y[contact.node[i]] += contact.weight[i] * pull;
  }
}

bool IsUsable(const ContactPoint& contact, int node_count) noexcept {
  if (contact.count < 1 || contact.count > static_cast<int>(contact.node.size())) return false;
  for (int i = 0; i < contact.count; ++i)
    if (contact.node[i] < 0 || contact.node[i] >= node_count || !std::isfinite(contact.weight[i]))
      return false;
  return IsFinite(contact.foot) && IsFinite(contact.normal) && IsFinite(contact.start) &&
         std::isfinite(contact.stiffness) && contact.stiffness >= 0 &&
         std::isfinite(contact.friction) && contact.friction >= 0 && contact.slip_scale > 0;
}

}  // namespace arthro::simulation
