#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "simulation/tissue/solver/conjugate_gradients.h"
#include "simulation/tissue/solver/implicit_solver_impl.h"

namespace arthro::simulation {
namespace {

// Iterations: however many a step has left over, and at least the last number.
constexpr int kMostForTool = 200, kFewestForTool = 12;

}  // namespace

double ImplicitSolver::ToolStiffness(int owner, const glm::dvec3& direction,
                                     double tolerance) noexcept {
  Impl& body = *impl_;
  std::fill(body.tool_right.begin(), body.tool_right.end(), glm::dvec3(0.0));
  ContactSpring* nearest = nullptr;
  bool bears = false;
  // Computes the tool's own contacts without friction.
  body.tool_springs.assign(body.springs.begin(), body.springs.end());
  for (ContactSpring& spring : body.tool_springs) {
    const ContactPoint& contact = *spring.contact;
    if (contact.owner != owner || !(contact.hold > 0)) continue;
    const glm::dvec3 p = spring.hold >= 0 ? body.holds[spring.hold].offset : glm::dvec3(0.0);
    spring = SpringAt(contact, spring.point, p, glm::dvec3(0.0));
    bears = bears || spring.bears;
    if (nearest == nullptr || spring.gap < nearest->gap) nearest = &spring;
  }
  if (nearest == nullptr || !body.is_evaluated) return 0;
  if (!bears) {
    const glm::dvec3& n = nearest->contact->normal;
    nearest->stiffness = nearest->contact->stiffness * glm::outerProduct(n, n);
    nearest->bears = true;
  }
  const double hold = nearest->contact->hold;
  glm::dmat3 sum(hold), turn(0.0), give(0.0);
  for (const ContactSpring& spring : body.tool_springs) {
    if (spring.contact->owner != owner || !spring.bears) continue;
    sum += spring.stiffness;
    turn += spring.turn;
  }
  const bool turns = InvertPositive(sum + turn, give);
  if (!turns && !InvertPositive(sum, give)) return 0;
  const int at =
      static_cast<int>(std::find_if(body.holds.begin(), body.holds.end(),
                                    [owner](const ToolHold& tool) { return tool.owner == owner; }) -
                       body.holds.begin());
  if (at == static_cast<int>(body.holds.size())) return 0;
  body.tool_holds.assign(body.holds.begin(), body.holds.end());
  body.tool_holds[at].give = give;
  for (ContactSpring& spring : body.tool_springs) {
    const ContactPoint& contact = *spring.contact;
    if (contact.owner != owner || !(contact.hold > 0)) continue;
    spring.hold = at;
    if (!turns) spring.turn = glm::dmat3(0.0);
    if (!spring.bears) continue;
    const glm::dvec3 led = hold * (spring.stiffness + spring.turn) * (give * direction);
    for (int i = 0; i < contact.count; ++i) {
      const int node = contact.node[i];
      body.tool_right[node] += contact.weight[i] * led * body.is_free[node];
    }
  }
  LinearSystem system = body.System();
  system.springs = body.tool_springs;
  system.holds = body.tool_holds;
  auto& left = body.tool_left[static_cast<std::size_t>(owner) % body.tool_left.size()];
  const int most = std::clamp(body.options.max_work - body.last_work, kFewestForTool, kMostForTool);
  const CgResult result = SolveByGradients(system, *body.factor, body.tool_right,
                                           {tolerance, 0, most, true}, body.tool_vectors, left);
  body.last_work += result.iterations;
  // rᵀ A⁻¹ r = rᵀ d + dᵀ (r − A d), up to the square of the error of d.
  return hold - hold * hold * glm::dot(direction, give * direction) - Dot(body.tool_right, left) -
         Dot(left, body.tool_vectors.r);
}

}  // namespace arthro::simulation
