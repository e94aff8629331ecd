// Time integration of one deformable body: implicit Euler (or its static limit) by Newton's method
// with line search. Conjugate gradients solve each linear system on the true tangent,
// preconditioned with a stale sparse Cholesky factor that is rotated node by node [method.md,
// Deformable tissue]. If the true tangent is not positive definite, the projected one is used.
//
// Inverted elements far from equilibrium are recovered with a separate corotated law. If more than
// a fifth are inverted, recovery starts from the rest shape fitted to the fixed nodes
// (shape_recovery.cpp).
//
// Implicit Euler damps: a mode of angular frequency w loses the factor 1/sqrt(1 + (w dt)²) per
// step. Mesh's own frame, m, s, N. Step allocates nothing after the first steps.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/core/options.h"
#include "simulation/tissue/contact/contact_point.h"
#include "simulation/tissue/fem/block_matrix.h"
#include "simulation/tissue/fem/fem_model.h"

namespace arthro::simulation {

struct SolverOptions {
  double tolerance = 1e-2;
  int max_newton = 2;
  int max_iterations = 200;
  int max_work = 1'000'000;
  double max_speed = 20.0;
  template <class V>
  void Visit(V&& v) {
    v("tolerance", tolerance, Range{1e-12, 0.5}, "",
      "Residual force over the largest of load, inertia and internal forces at which a step ends.");
    v("max_newton", max_newton, Range{1, 1000}, "", "Newton iterations per step.");
    v("max_iterations", max_iterations, Range{1, 100000}, "",
      "Conjugate-gradient iterations per Newton iteration.");
    v("max_work", max_work, Range{1, 1'000'000}, "",
      "Work of a step, in iterations of conjugate gradients, beyond which it ends as it is. What "
      "is left of the residual moves the tissue in the next step.");
    v("max_speed", max_speed, Range{0.01, 1e4}, "m/s",
      "Speed limit of nodes; the report tells when it was applied.");
  }
};

struct BodyState {
  std::vector<glm::dvec3> x, v;  // m, m/s
};

struct StepReport {
  double residual = 0;  // relative, as in `tolerance`
  int newton = 0, iterations = 0;
  int work = 0;  // in the unit of `max_work`
  int inverted = 0;
  double energy = 0;       // J, elastic
  bool converged = false;  // residual ≤ tolerance
  bool used_fallback = false, clamped_speed = false;
  bool is_finite = true;  // false: the state was reset to the start of the step
};

class ImplicitSolver {
 public:
  // Factors the rest state. `fixed` has one byte per node, or is empty.
  ImplicitSolver(std::shared_ptr<const FemModel> model, FixedAxes fixed,
                 const SolverOptions& options = {});
  ~ImplicitSolver();
  ImplicitSolver(ImplicitSolver&&) noexcept;
  ImplicitSolver& operator=(ImplicitSolver&&) noexcept;

  // Reserves memory for this number of contacts, so that a step allocates nothing.
  void Reserve(std::size_t contacts);

  // Advances by dt under `load` (N per node) and `contacts`; `results` gets one entry per contact.
  // `target` (empty, or a position per node) prescribes the fixed axes. noexcept: the report tells
  // what went wrong.
  StepReport Step(BodyState& state, std::span<const glm::dvec3> load,
                  std::span<const ContactPoint> contacts, std::span<const glm::dvec3> target,
                  double dt, std::span<ContactResult> results) noexcept;

  // Solves for the equilibrium, starting at `state`, and sets v to zero. Applies the load in steps
  // if needed.
  StepReport SolveStatic(BodyState& state, std::span<const glm::dvec3> load,
                         std::span<const ContactPoint> contacts, std::span<const glm::dvec3> target,
                         double tolerance, std::span<ContactResult> results);

  // Returns the elastic forces at fixed axes in the last state, i.e. the reactions, N per node.
  std::span<const glm::dvec3> reactions() const;

  // Make a new factor of the present tangent. Begin copies the data (on this thread). Run factors
  // (on any other thread; touches nothing that Step reads). Take swaps the factors (on this
  // thread).
  void BeginRefresh();
  void RunRefresh() noexcept;
  // Returns false if no factor was ready, if a step has made a newer one, or if the tangent was too
  // far from positive definite to be factored. In the last case the next factor is of the projected
  // tangent.
  bool TakeRefreshed() noexcept;
  int factor_age() const;  // steps since the factor in use was begun

  // Plan the first factor after Replace, so that the step that makes it finds the plan. Run may be
  // called on another thread and touches nothing that Step reads. Take is called on this one.
  // Without them the step plans, with the same result.
  void RunPlan() noexcept;
  void TakePlan() noexcept;

  // Returns the stiffness nᵀ K n that the hand feels through a tool along a unit direction n: the
  // change of its force when the hand moves, tool and tissue following, without the tool's own
  // friction. K = h − h H⁻¹ h − Bᵀ A⁻¹ B, B = h Σ Jᵢᵀ Kᵢ H⁻¹, H = h + Σ Kᵢ. The sums run over the
  // contacts of `owner` that bear in the last step, or the nearest as if it did. h is the spring to
  // the hand, A that step's system. N/m; 0: no such tool, or no step yet.
  // The rotation of a round tool's normals is included, so K is exact and need not be positive
  // definite. Solves for A⁻¹ B n by the same conjugate gradients, which start at the last answer
  // for this tool; the error of the stiffness is the square of `tolerance`, in parts of h. Ends at
  // `max_work`, the step's own work included, but makes 12 iterations at least; the stiffness is
  // then too high. Allocates nothing.
  double ToolStiffness(int owner, const glm::dvec3& direction, double tolerance) noexcept;

  // Replaces the model after a cut or with new shares: node i of the new model was node parent[i]
  // of the old one. The old factor, mapped by `parent`, stays the preconditioner until a refreshed
  // one is taken.
  void Replace(std::shared_ptr<const FemModel> model, FixedAxes fixed, std::span<const int> parent);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace arthro::simulation
