#include <algorithm>

#include <glm/matrix.hpp>

#include "simulation/core/error.h"
#include "simulation/tissue/solver/conjugate_gradients.h"
#include "simulation/tissue/solver/implicit_solver_impl.h"

namespace arthro::simulation {
namespace {

constexpr int kMostIterations = 200;

bool IsSamePlace(const ContactPoint& a, const ContactPoint& b) {
  return a.count == b.count && a.owner == b.owner && a.normal == b.normal &&
         std::equal(a.node.begin(), a.node.begin() + a.count, b.node.begin()) &&
         std::equal(a.weight.begin(), a.weight.begin() + a.count, b.weight.begin());
}

}  // namespace

std::vector<ContactSpring> ImplicitSolver::Impl::SpringsWithout(
    std::span<const ContactPoint> points) const {
  std::vector<ContactSpring> kept;
  for (const ContactSpring& spring : springs)
    if (std::none_of(points.begin(), points.end(),
                     [&](const ContactPoint& p) { return IsSamePlace(p, *spring.contact); }))
      kept.push_back(spring);
  return kept;
}

void ImplicitSolver::Compliance(std::span<const ContactPoint> points, double tolerance,
                                std::span<double> w) {
  Impl& body = *impl_;
  const std::size_t columns = 3 * points.size();
  if (w.size() != columns * columns)
    throw Error(Code::kBadArgument, "compliance of m contacts is a matrix of 3m times 3m numbers");
  for (const ContactPoint& point : points)
    if (!IsUsable(point, body.model->node_count()))
      throw Error(Code::kBadArgument, "a contact names nodes that are not there, or is not finite");
  const std::vector<ContactSpring> springs = body.SpringsWithout(points);
  LinearSystem system = body.System();
  system.springs = springs;
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (int c = 0; c < 3; ++c) {
      std::fill(body.tool_right[c].begin(), body.tool_right[c].end(), glm::dvec3(0.0));
      for (int i = 0; i < points[k].count; ++i) {
        const int node = points[k].node[i];
        body.tool_right[c][node][c] += points[k].weight[i] * body.is_free[node][c];
      }
    }
    SolveThree(system, *body.factor, body.tool_right, {tolerance, 0, kMostIterations},
               body.tool_vectors, body.tool_left[0]);
    for (std::size_t j = 0; j < points.size(); ++j)
      for (int c = 0; c < 3; ++c) {
        const glm::dvec3 moved = ContactPosition(points[j], body.tool_left[0][c]);
        for (int a = 0; a < 3; ++a) w[(3 * j + a) * columns + 3 * k + c] = moved[a];
      }
  }
  // Symmetrises the matrix, which is symmetric up to the tolerance.
  for (std::size_t i = 0; i < columns; ++i)
    for (std::size_t j = 0; j < i; ++j)
      w[i * columns + j] = w[j * columns + i] = 0.5 * (w[i * columns + j] + w[j * columns + i]);
}

glm::dmat3 ImplicitSolver::ToolStiffness(int owner, double tolerance) noexcept {
  Impl& body = *impl_;
  glm::dmat3 stiffness(0.0);
  for (auto& column : body.tool_right) std::fill(column.begin(), column.end(), glm::dvec3(0.0));
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
  if (nearest == nullptr || !body.is_evaluated) return stiffness;
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
  if (!turns && !InvertPositive(sum, give)) return stiffness;
  const int at =
      static_cast<int>(std::find_if(body.holds.begin(), body.holds.end(),
                                    [owner](const ToolHold& tool) { return tool.owner == owner; }) -
                       body.holds.begin());
  if (at == static_cast<int>(body.holds.size())) return stiffness;
  body.tool_holds.assign(body.holds.begin(), body.holds.end());
  body.tool_holds[at].give = give;
  for (ContactSpring& spring : body.tool_springs) {
    const ContactPoint& contact = *spring.contact;
    if (contact.owner != owner || !(contact.hold > 0)) continue;
    spring.hold = at;
    if (!turns) spring.turn = glm::dmat3(0.0);
    if (!spring.bears) continue;
    const glm::dmat3 led = hold * (spring.stiffness + spring.turn) * give;
    for (int c = 0; c < 3; ++c)
      for (int i = 0; i < contact.count; ++i) {
        const int node = contact.node[i];
        body.tool_right[c][node] += contact.weight[i] * led[c] * body.is_free[node];
      }
  }
  LinearSystem system = body.System();
  system.springs = body.tool_springs;
  system.holds = body.tool_holds;
  auto& left = body.tool_left[static_cast<std::size_t>(owner) % body.tool_left.size()];
  SolveThree(system, *body.factor, body.tool_right, {tolerance, 0, kMostIterations, true},
             body.tool_vectors, left);
  // Rᵀ A⁻¹ R = Rᵀ D + Dᵀ (R − A D), up to the square of the error of D.
  stiffness = hold * glm::dmat3(1.0) - hold * hold * give;
  for (int a = 0; a < 3; ++a)
    for (int c = 0; c < 3; ++c)
      stiffness[c][a] -= Dot(body.tool_right[a], left[c]) + Dot(left[a], body.tool_vectors[c].r);
  return 0.5 * (stiffness + glm::transpose(stiffness));
}

}  // namespace arthro::simulation
