// Implementation of ImplicitSolver: the incremental potential
//   E(x) = Ψ(x) − f·x + Σ contact + ½ Σ m |x − y|²/dt²,   y = x₀ + dt v₀ (no last term when static)
// and Newton's method for it. One evaluation per step: the tangent at a step's end starts the next
// one. SI, the mesh's own frame.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <span>
#include <vector>

#include "simulation/tissue/factor/rotated_factor.h"
#include "simulation/tissue/solver/conjugate_gradients.h"
#include "simulation/tissue/solver/contact_springs.h"
#include "simulation/tissue/solver/implicit_solver.h"

namespace arthro::simulation {

// Time step for which the factor is made. It also serves other steps, because most of the stiffness
// far exceeds inertia.
inline constexpr double kUsualStep = 1.0 / 60;  // s

// Loads and constraints of a step.
struct Problem {
  std::span<const glm::dvec3> load;
  std::span<const ContactPoint> contacts;
  std::span<const glm::dvec3> target;  // empty: fixed axes stay
  double load_share = 1, target_share = 1;
  double dt = 0;  // 0: static
};

struct NewtonGoal {
  double tolerance = 1e-2;
  int max_newton = 2;
  int max_iterations = 200;
  int max_work = 1 << 30;  // see SolverOptions
  bool refactors = false;  // makes a new factor if the old one needs many iterations
  // Plain Newton: finds the equilibrium near the start, stable or not, instead of descending.
  bool follows = false;
  int patience = 1 << 30;  // iterations after which a tangent that is not positive definite ends it
};

// Newton iterations with the projected tangent after the true one was found not to be positive
// definite.
inline constexpr int kProjectedIterations = 3;

struct ImplicitSolver::Impl {
  Impl(std::shared_ptr<const FemModel> model_in, FixedAxes fixed_in,
       const SolverOptions& options_in);

  // Allocates memory for the model, its pattern and its fixed axes.
  void Fit();
  void FactorRest();

  // newton.cpp
  StepReport Newton(std::span<glm::dvec3> x, const Problem& problem, const NewtonGoal& goal);
  void Evaluate(std::span<const glm::dvec3> x, Law law, Tangent tangent);
  double Potential(std::span<const glm::dvec3> x, const Problem& problem, double& magnitude);
  void SetSprings(std::span<const glm::dvec3> x, bool renews_friction);
  double Gradient(std::span<const glm::dvec3> x, const Problem& problem);  // -> scale, N
  void FindDirection(std::span<const glm::dvec3> x, const Problem& problem, const NewtonGoal& goal,
                     double scale, double residual, bool leads, StepReport& report);
  bool SearchAlong(std::span<glm::dvec3> x, const Problem& problem, Law law, Tangent tangent);
  LinearSystem System() const;

  // shape_recovery.cpp
  void MakeRecovery();
  void FitRestShape(std::span<glm::dvec3> x) const;
  void RecoverShape(std::span<glm::dvec3> x, const Problem& problem);

  // factor_refresh.cpp
  int FactorNow(std::span<const glm::dvec3> x, bool of_true_tangent) noexcept;
  void AddSprings(BlockMatrix& to) const;

  void FinishReactions(const Problem& problem);
  void FillResults(std::span<const glm::dvec3> x, std::span<ContactResult> results);
  bool Take(const Problem& problem);  // false: invalid input

  std::shared_ptr<const FemModel> model;
  FixedAxes fixed;
  SolverOptions options;
  std::vector<glm::dvec3> is_free;
  double least_force = 0;   // N, below it a load counts as zero
  double force_noise = 0;   // N, rounding error of all elastic forces together
  double energy_noise = 0;  // J, rounding error of the elastic energy

  // State of the last evaluation.
  std::vector<glm::dvec3> at;
  Law at_law = Law::kStableNeoHookean;
  Tangent at_tangent = Tangent::kNone;
  bool is_evaluated = false;
  Assembly assembly;
  std::vector<glm::dvec3> force;
  BlockMatrix stiffness;

  // State of the present step.
  std::vector<ContactSpring> springs, tool_springs;
  std::vector<ToolHold> holds, tool_holds;
  std::vector<glm::dvec3> pressing;    // push per contact in the previous iteration
  std::vector<ContactPoint> contacts;  // copied: springs refer to them after the step
  std::vector<double> added;           // M/dt²
  double last_dt = 0;
  int last_work = 0;               // work of the step and of the tools since
  std::vector<glm::dvec3> goal_x;  // y
  std::vector<glm::dvec3> begin_x, good_x, good_v;
  std::vector<glm::dvec3> gradient, direction, right, lead, trial, reaction, unit_load;
  std::vector<glm::dmat3> rotation;
  CgVectors vectors;
  CgVectors tool_vectors;  // for ToolStiffness
  std::vector<glm::dvec3> tool_right;
  // Response of the tissue to each tool, kept as a start for the next step.
  std::array<std::vector<glm::dvec3>, 2> tool_left;
  bool is_recovering = false;  // from inverted elements
  bool was_refitted = false;   // this step replaced the body by its rest shape
  int recovery_rounds = 0, rounds_once_clean = 0;
  bool has_given_up = false;  // recovery ended with inverted elements, which are then accepted
  bool wants_factor = false;  // the last system needed many iterations
  bool was_shifted = false;   // the last factor failed: its tangent was far from positive definite
  bool needs_factor = false;  // the body was cut: the next system needs a new factor
  bool met_negative = false;  // the true tangent was not positive definite since Newton began
  int projected_left = 0;     // remaining Newton iterations with the projected tangent

  // Corotated law without sideways stiffness, and a factor that bounds its tangent everywhere.
  std::unique_ptr<const FemModel> recovery_model;
  std::unique_ptr<SparseFactor> recovery_factor;
  std::vector<glm::dvec3> recovery_force;

  std::unique_ptr<RotatedFactor> factor;
  int age = 0;

  // Factor in preparation: once begun, `job_*` and `spare` belong to the thread that runs it.
  enum class Job { kNone, kBegun, kDone, kFailed };
  std::atomic<Job> job{Job::kNone};
  std::unique_ptr<RotatedFactor> spare;
  std::shared_ptr<const FactorPlan> job_plan;  // plan of the factor at that time, and its parent()
  std::vector<int> job_plan_parent;
  FixedAxes job_fixed;
  bool job_is_shifted = false;  // the tangent was far from positive definite
  BlockMatrix job_stiffness;
  std::vector<double> job_added;
  std::vector<glm::dmat3> job_rotation;
  // Plan of the first factor after a cut: between Replace and Take it belongs to the thread that
  // runs it.
  struct PlanJob {
    std::shared_ptr<const FactorPlan> before, made;
    std::vector<int> parent;  // node of `before` of each node
    std::shared_ptr<const BlockPattern> pattern;
    FixedAxes fixed;
  } plan_job;
  std::shared_ptr<const FactorPlan> next_plan;  // null: not taken
  // Owned by the step.
  std::vector<int>
      job_parent;  // maps the body's nodes to the job's if cut since it began; else empty
  int job_age = 0;
};

}  // namespace arthro::simulation
