// One place where something holds a tissue's skin: a point of the tissue, given by shape functions
// of one element, is kept out of a half space or out of a round bar with a spring, and held
// sideways by friction. What finds contacts makes these; what solves reads them. Mesh's own frame,
// m, N.
//   half space: gap g = n · (Σ wᵢ xᵢ − foot − p)
//   round: g = |Σ wᵢ xᵢ − p − c| − radius, c the nearest point of the segment a–b
//   energy ½ k min(g, 0)²; round: growing faster once g is a tenth of the radius
//   friction: at most μ λ against the slip u since the step began, u = (1 − n nᵀ)(Σ wᵢ xᵢ − start −
//   p), λ n the push of the iteration before, smoothed over slip_scale (C¹)
// p is how far a tool is from where the hand has it: all contacts of one owner are on one rigid
// tool that a spring, `hold`, ties to the hand; p is where it comes to rest [contact_hold.h]. What
// is fixed in space has no hold and p = 0.
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
  glm::dvec3 normal{0, 0, 1};  // unit, the way the tissue is pushed; round: the side that it is on
  bool is_round = false;
  glm::dvec3 a{0.0}, b{0.0};  // of the bar's axis, where the hand has it
  double radius = 0;
  double stiffness = 0;  // k, N/m
  double friction = 0;   // μ
  // Where the tissue's point would be had it gone along with what it touches; with a hold, less p.
  glm::dvec3 start{0.0};
  double slip_scale = 1e-5;  // m
  int owner = -1;            // tool index; −1: the backdrop or another fixed thing
  double hold = 0;           // N/m, of the spring between hand and tool; 0: rigid, p = 0
  glm::dvec3 offset{0.0};    // p, as it may be
};

// What one contact does at the end of a step.
struct ContactResult {
  glm::dvec3 point{0.0};  // the tissue's
  glm::dvec3 force{0.0};  // on the tissue
  double gap = 0;         // m
  glm::dvec3 push{0.0};   // of the force, the part that is not friction
};

}  // namespace arthro::simulation
