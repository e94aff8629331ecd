// One deformable body through time: implicit Euler (or its static limit) by Newton's method with
// line search. Each linear system is solved by conjugate gradients on the true tangent,
// preconditioned with a stale sparse Cholesky factor that is rotated node by node [method.md,
// Deformable tissue]. Where the true tangent is not positive the projected one is used. Where
// elements are inverted, far from balance, a corotated law of its own, until none is; where more
// than a fifth are, from the rest shape laid on what holds the body (shape_recovery.cpp). Implicit
// Euler damps: a mode of angular frequency w loses the factor 1/sqrt(1 + (w dt)²) a step. Mesh's
// own frame, m, s, N. Step allocates nothing once warm.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "simulation/core/options.h"
#include "simulation/tissue/contact/contact_point.h"
#include "simulation/tissue/factor/fixed_axes.h"
#include "simulation/tissue/fem/fem_model.h"

namespace arthro::simulation {

struct SolverOptions {
  double tolerance = 1e-2;
  int max_newton = 2;
  int max_iterations = 200;
  double max_speed = 20.0;
  template <class V>
  void Visit(V&& v) {
    v("tolerance", tolerance, Range{1e-12, 0.5}, "",
      "Residual force over the largest of load, inertia and internal forces at which a step ends.");
    v("max_newton", max_newton, Range{1, 1000}, "", "Newton iterations a step.");
    v("max_iterations", max_iterations, Range{1, 100000}, "",
      "Conjugate-gradient iterations a Newton iteration.");
    v("max_speed", max_speed, Range{0.01, 1e4}, "m/s", "Nodes are not let go faster; it is said.");
  }
};

struct BodyState {
  std::vector<glm::dvec3> x, v;  // m, m/s
};

struct StepReport {
  double residual = 0;  // relative, as in `tolerance`
  int newton = 0, iterations = 0;
  int inverted = 0;
  double energy = 0;       // J, elastic
  bool converged = false;  // residual ≤ tolerance
  bool used_fallback = false, clamped_speed = false;
  bool is_finite = true;  // false: the state was put back to where the step began
};

class ImplicitSolver {
 public:
  // Factors the rest state. `fixed`: one byte a node, or empty.
  ImplicitSolver(std::shared_ptr<const FemModel> model, FixedAxes fixed,
                 const SolverOptions& options = {});
  ~ImplicitSolver();
  ImplicitSolver(ImplicitSolver&&) noexcept;
  ImplicitSolver& operator=(ImplicitSolver&&) noexcept;

  // Room for so many contacts, so that a step with them allocates nothing.
  void Reserve(std::size_t contacts);

  // Advances by dt under `load` (N a node) and `contacts`; `results` gets one a contact. `target`
  // (empty, or a position a node) leads the fixed axes. noexcept: what goes wrong is in the report.
  StepReport Step(BodyState& state, std::span<const glm::dvec3> load,
                  std::span<const ContactPoint> contacts, std::span<const glm::dvec3> target,
                  double dt, std::span<ContactResult> results) noexcept;

  // Equilibrium from where `state` is; v is set to zero. Loads are stepped when that is what it
  // takes.
  StepReport SolveStatic(BodyState& state, std::span<const glm::dvec3> load,
                         std::span<const ContactPoint> contacts, std::span<const glm::dvec3> target,
                         double tolerance, std::span<ContactResult> results);

  // The elastic forces at fixed axes in the last state: what holds them, N a node.
  std::span<const glm::dvec3> reactions() const;

  // A new factor of the tangent as it is now: Begin copies what it needs (on this thread), Run
  // factors (on any other thread; touches nothing that Step reads), Take swaps (on this thread).
  void BeginRefresh();
  void RunRefresh() noexcept;
  // False: none was ready, a step has made a younger one, or the tangent was too far from positive
  // to be factored; then the next one is of the projected tangent.
  bool TakeRefreshed() noexcept;
  int factor_age() const;  // steps since the factor in use was begun

  // Condensed compliance of the last step's system without the contacts of `points` themselves:
  // W = J A⁻¹ Jᵀ, 3m × 3m row-major, m/N, J the points' weights. Solved to `tolerance` by the same
  // conjugate gradients.
  void Compliance(std::span<const ContactPoint> points, double tolerance, std::span<double> w);

  // How what pushes a tool grows when its hand is moved, tool and tissue following and the tool's
  // own friction apart: K = h − h H⁻¹ h − Bᵀ A⁻¹ B, B = h Σ Jᵢᵀ Kᵢ H⁻¹, H = h + Σ Kᵢ, over the
  // contacts of `owner` that bear in the last step, or the nearest as if it did; h the spring to
  // the hand, A that step's system. The turn of a round tool's normals is in it, so it is exact,
  // and need not be positive. N/m, symmetric. Three right-hand sides of the same conjugate
  // gradients at once; allocates nothing.
  glm::dmat3 ToolStiffness(int owner, double tolerance) noexcept;

  // The same body after a cut or new shares: node i of the new model was node parent[i] of the old
  // one. The old factor goes on as preconditioner through that map until a refreshed one is taken.
  void Replace(std::shared_ptr<const FemModel> model, FixedAxes fixed, std::span<const int> parent);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace arthro::simulation
