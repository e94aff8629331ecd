#include "authoring/models/crescent_sections.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace arthro::authoring {
namespace {

// Calls `use(a, b)` with the radius and height of both ends of each line in which a triangle meets
// the half-plane at an angle.
template <class Use>
void ForEachLine(const SurfaceMesh& surface, double angle, Use&& use) {
  const glm::dvec2 out(std::cos(angle), std::sin(angle)), across(-out.y, out.x);
  for (const auto& triangle : surface.triangles) {
    std::array<glm::dvec2, 2> ends;
    int count = 0;
    for (int k = 0; k < 3 && count < 2; ++k) {
      const glm::dvec3& a = surface.vertices[static_cast<std::size_t>(triangle[k])];
      const glm::dvec3& b = surface.vertices[static_cast<std::size_t>(triangle[(k + 1) % 3])];
      const double da = glm::dot(glm::dvec2(a), across), db = glm::dot(glm::dvec2(b), across);
      if ((da < 0) == (db < 0)) continue;
      const glm::dvec3 x = a + da / (da - db) * (b - a);
      ends[static_cast<std::size_t>(count++)] = {glm::dot(glm::dvec2(x), out), x.z};
    }
    if (count == 2 && ends[0].x > 0 && ends[1].x > 0) use(ends[0], ends[1]);
  }
}

void Take(CrescentSection& section, double radius, double height) {
  if (section.is_empty) section = {false, radius, radius, height, height};
  section.inner = std::min(section.inner, radius);
  section.outer = std::max(section.outer, radius);
  section.low = std::min(section.low, height);
  section.high = std::max(section.high, height);
}

}  // namespace

CrescentSections::CrescentSections(const SurfaceMesh& surface, const Rigid3& model_from_crescent)
    : local_(surface), model_from_crescent_(model_from_crescent) {
  const Rigid3 crescent_from_model = Inverse(model_from_crescent);
  for (glm::dvec3& x : local_.vertices) x = crescent_from_model * x;
}

CrescentSection CrescentSections::At(double angle) const {
  CrescentSection section;
  ForEachLine(local_, angle, [&](const glm::dvec2& a, const glm::dvec2& b) {
    Take(section, a.x, a.y);
    Take(section, b.x, b.y);
  });
  return section;
}

CrescentSection CrescentSections::At(double angle, double radius) const {
  CrescentSection section;
  ForEachLine(local_, angle, [&](const glm::dvec2& a, const glm::dvec2& b) {
    if ((a.x < radius) == (b.x < radius)) return;
    Take(section, radius, a.y + (radius - a.x) / (b.x - a.x) * (b.y - a.y));
  });
  return section;
}

double CrescentSections::BorderLength(double from, double to, bool is_outer) const {
  constexpr int kSteps = 180;
  double length = 0;
  glm::dvec2 before(0);
  bool has_before = false;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = from + (to - from) * i / kSteps;
    const CrescentSection section = At(angle);
    if (section.is_empty) continue;
    const double r = is_outer ? section.outer : section.inner;
    const glm::dvec2 x(r * std::cos(angle), r * std::sin(angle));
    if (has_before) length += glm::distance(before, x);
    before = x;
    has_before = true;
  }
  return length;
}

glm::dvec3 CrescentSections::Place(double angle, double radius, double height) const {
  return model_from_crescent_ *
         glm::dvec3(radius * std::cos(angle), radius * std::sin(angle), height);
}

glm::dvec3 CrescentSections::InCrescent(const glm::dvec3& x_in_model) const {
  return Inverse(model_from_crescent_) * x_in_model;
}

}  // namespace arthro::authoring
