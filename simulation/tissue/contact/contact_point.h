// One place where something holds a tissue's skin: a point of the tissue, given by shape functions
// of one element, is pushed out of a half space with a spring, and held sideways by friction. What
// finds contacts makes these; what solves reads them. Mesh's own frame, m, N.
//   gap g = n · (Σ wᵢ xᵢ − foot); energy ½ k min(g, 0)²
//   friction: at most μ λ against the slip u since the step began, u = (1 − n nᵀ)(Σ wᵢ xᵢ − start),
//   λ the normal force of the iteration before, smoothed over slip_scale (C¹)
#pragma once

#include <array>
#include <vector>

#include <glm/vec3.hpp>

namespace arthro::simulation {

struct ContactPoint {
  int count = 0;  // of nodes, ≤ 10, all of one element
  std::array<int, 10> node{};
  std::array<double, 10> weight{};  // sum 1
  glm::dvec3 foot{0.0};             // on the boundary of the half space
  glm::dvec3 normal{0, 0, 1};       // unit, the way the tissue is pushed
  double stiffness = 0;             // k, N/m
  double friction = 0;              // μ
  glm::dvec3 start{
      0.0};  // where the tissue's point would be had it gone along with what it touches
  double slip_scale = 1e-5;  // m
  int owner = -1;            // tool index; −1: the backdrop or another fixed thing
};

// What one contact does at the end of a step.
struct ContactResult {
  glm::dvec3 point{0.0};  // the tissue's
  glm::dvec3 force{0.0};  // on the tissue
  double gap = 0;         // m
};

}  // namespace arthro::simulation
