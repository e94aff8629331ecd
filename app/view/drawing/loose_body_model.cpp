#include "app/view/drawing/loose_body_model.h"

#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace arthro::app {
namespace {

// Edges of a body of 2 mm are 0.17 mm long: its distances are interpolated (lens_model.cpp), and
// its outline is round near the lens.
constexpr int kAroundBody = 72, kAlongBody = 36;
constexpr int kDents = 9;
// Linear; darker than cartilage, since a body comes close to the lamp.
constexpr glm::dvec3 kBodyColour(0.52, 0.45, 0.35);

// Directions of dents that are even over the sphere [Fibonacci lattice], turned by the number.
glm::dvec3 DentOf(int dent, int number) {
  const double height = 1.0 - (2.0 * dent + 1.0) / kDents;
  const double angle = 2.0 * std::numbers::pi * (dent * std::numbers::phi + 0.37 * number);
  const double flat = std::sqrt(1.0 - height * height);
  return {flat * std::cos(angle), flat * std::sin(angle), height};
}

// Radius in a direction, a share of the ball's: dents of three widths and depths.
double RadiusAlong(const glm::dvec3& direction, int number) {
  double radius = 1.0;
  for (int dent = 0; dent < kDents; ++dent) {
    constexpr std::array<double, 3> kDepth{kDeepestDent, 0.08, 0.05}, kSharpness{5, 9, 14};
    const auto kind = static_cast<std::size_t>((dent + number) % 3);
    const double near = glm::dot(direction, DentOf(dent, number)) - 1.0;  // 0 in its middle
    radius -= kDepth[kind] * std::exp(kSharpness[kind] * near);
  }
  return std::max(radius, 1.0 - kDeepestDent);
}

}  // namespace

SurfaceMesh MakeLooseBody(double radius, int number) {
  SurfaceMesh mesh;
  const auto add = [&](const glm::dvec3& direction) {
    mesh.vertices.push_back(radius * RadiusAlong(direction, number) * direction);
  };
  add({0, 0, 1});
  for (int j = 1; j < kAlongBody; ++j)
    for (int i = 0; i < kAroundBody; ++i) {
      const double a = 2 * std::numbers::pi * i / kAroundBody,
                   b = std::numbers::pi * j / kAlongBody;
      add({std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), std::cos(b)});
    }
  add({0, 0, -1});
  const int last = static_cast<int>(mesh.vertices.size()) - 1;
  const auto at = [](int j, int i) { return 1 + (j - 1) * kAroundBody + i % kAroundBody; };
  for (int i = 0; i < kAroundBody; ++i) {
    mesh.triangles.push_back({0, at(1, i), at(1, i + 1)});
    mesh.triangles.push_back({last, at(kAlongBody - 1, i + 1), at(kAlongBody - 1, i)});
    for (int j = 1; j + 1 < kAlongBody; ++j) {
      mesh.triangles.push_back({at(j, i), at(j + 1, i), at(j + 1, i + 1)});
      mesh.triangles.push_back({at(j, i), at(j + 1, i + 1), at(j, i + 1)});
    }
  }
  return mesh;
}

Tissue LooseBodyTissue(const Ball& ball) {
  Tissue tissue;
  tissue.name = "loose body";
  tissue.colour = kBodyColour;
  tissue.pose.position = ball.centre;
  return tissue;
}

simulation::TissueLook LooseBodyLook() {
  simulation::TissueLook look;
  // Tint and gloss of the preset "Cartilage, for probing"; its plate has no border here.
  look.tint = {0.95, 1.09, 1.4};
  look.gloss = 1.5;
  return look;
}

}  // namespace arthro::app
