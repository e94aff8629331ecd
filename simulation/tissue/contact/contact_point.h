// Contact at one point of a tissue, which is given by shape functions of one element. A spring
// keeps the point out of a half space or a round bar, and friction holds it sideways. Contact
// search creates these; the solver reads them. Mesh's own frame, m, N.
//   half space: gap g = n · (Σ wᵢ xᵢ − foot − p)
//   round: g = |Σ wᵢ xᵢ − p − c| − radius, c the nearest point of the segment a–b
//   energy: ½ k min(g, 0)²; round: growing faster once g is a tenth of the radius
//   friction: at most μ λ against the slip u since the step began,
//     u = (1 − n nᵀ)(Σ wᵢ xᵢ − start − p), λ n the push of the previous iteration,
//     smoothed over slip_scale (C¹)
// p is the offset of a tool from its commanded pose. All contacts of one owner are on one rigid
// tool, which a spring, `hold`, ties to the hand; p is its equilibrium (contact_springs.h). Objects
// that are fixed in space have no hold and p = 0.
#pragma once

#include <array>
#include <vector>

#include <glm/vec3.hpp>

namespace arthro::simulation {

struct ContactPoint {
  int count = 0;  // number of nodes, ≤ 10, all of one element
  std::array<int, 10> node{};
  std::array<double, 10> weight{};  // sum 1
  glm::dvec3 foot{0.0};             // on the boundary of the half space
  glm::dvec3 normal{0, 0, 1};       // unit, push on the tissue; round: side of the tissue
  bool is_round = false;
  glm::dvec3 a{0.0}, b{0.0};  // ends of the bar's axis at the commanded pose
  double radius = 0;
  double stiffness = 0;  // k, N/m
  double friction = 0;   // μ
  // Position that the tissue's point would have if it moved with the object; with a hold, less p.
  glm::dvec3 start{0.0};
  double slip_scale = 1e-5;  // m
  int owner = -1;            // tool index; −1: the backdrop or another fixed object
  double hold = 0;           // N/m, spring between hand and tool; 0: rigid, p = 0
  glm::dvec3 offset{0.0};    // p, initial guess
};

// Result of one contact at the end of a step.
struct ContactResult {
  glm::dvec3 point{0.0};  // on the tissue
  glm::dvec3 force{0.0};  // on the tissue
  double gap = 0;         // m
  glm::dvec3 push{0.0};   // part of the force without friction
};

}  // namespace arthro::simulation
