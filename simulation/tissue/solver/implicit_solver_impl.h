// The inside of ImplicitSolver: the incremental potential
//   E(x) = Ψ(x) − f·x + Σ contact + ½ Σ m |x − y|²/dt²,   y = x₀ + dt v₀ (no last term when static)
// and Newton's method on it. One evaluation a step: the tangent at a step's end is the next one's
// beginning. SI, the mesh's own frame.
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

// What a step is solved under.
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
  bool refactors = false;  // a new factor where the old one asks for many iterations
  // Plain Newton: to the equilibrium next to the start, stable or not, instead of downhill.
  bool follows = false;
  int patience = 1 << 30;  // iterations after which a tangent that was not positive ends it
};

// Newton iterations with the projected tangent after the true one was found not to be positive.
inline constexpr int kProjectedIterations = 3;

struct ImplicitSolver::Impl {
  Impl(std::shared_ptr<const FemModel> model_in, FixedAxes fixed_in,
       const SolverOptions& options_in);

  // Memory for the model, its pattern and its fixed axes.
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
  void LayRestShape(std::span<glm::dvec3> x) const;
  void RecoverShape(std::span<glm::dvec3> x, const Problem& problem);

  // compliance.cpp
  std::vector<ContactSpring> SpringsWithout(std::span<const ContactPoint> points) const;

  // factor_refresh.cpp
  void FactorNow(std::span<const glm::dvec3> x, bool of_true_tangent) noexcept;
  void AddSprings(BlockMatrix& to) const;

  void FinishReactions(const Problem& problem);
  void FillResults(std::span<const glm::dvec3> x, std::span<ContactResult> results);
  bool Take(const Problem& problem);  // false: it cannot be computed with

  std::shared_ptr<const FemModel> model;
  FixedAxes fixed;
  SolverOptions options;
  std::vector<glm::dvec3> is_free;
  double least_force = 0;   // N, what counts as no load at all
  double force_noise = 0;   // N, rounding of all elastic forces together
  double energy_noise = 0;  // J, rounding of the elastic energy

  // The last evaluation.
  std::vector<glm::dvec3> at;
  Law at_law = Law::kStableNeoHookean;
  Tangent at_tangent = Tangent::kNone;
  bool is_evaluated = false;
  Assembly assembly;
  std::vector<glm::dvec3> force;
  BlockMatrix stiffness;

  // The step's.
  std::vector<ContactSpring> springs, tool_springs;
  std::vector<ToolHold> holds, tool_holds;
  std::vector<glm::dvec3> pressing;    // push a contact, of the iteration before
  std::vector<ContactPoint> contacts;  // copied, so that Compliance can leave some out
  std::vector<double> added;           // M/dt²
  double last_dt = 0;
  std::vector<glm::dvec3> goal_x;  // y
  std::vector<glm::dvec3> begin_x, good_x, good_v;
  std::vector<glm::dvec3> gradient, direction, right, lead, trial, reaction, unit_load;
  std::vector<glm::dmat3> rotation;
  CgVectors vectors;
  std::array<CgVectors, 3> tool_vectors;  // of ToolStiffness
  std::array<std::vector<glm::dvec3>, 3> tool_right;
  // How the tissue follows each tool, from step to step: a good start for the next.
  std::array<std::array<std::vector<glm::dvec3>, 3>, 2> tool_left;
  bool is_recovering = false;  // from inverted elements
  bool was_laid = false;       // this step put the rest shape where the body was
  int recovery_rounds = 0, rounds_once_clean = 0;
  bool has_given_up = false;  // recovering ended with elements inverted: they are meant to be
  bool wants_factor = false;  // the last system asked for many iterations
  bool was_shifted = false;   // the last factor that was made failed for that
  bool needs_factor = false;  // the body was cut: the next system wants its own
  bool met_negative = false;  // since Newton began, the true tangent was not positive
  int projected_left = 0;     // Newton iterations that go on with the projected tangent

  // The corotated law without sideways stiffness, and a factor that bounds its tangent everywhere.
  std::unique_ptr<const FemModel> recovery_model;
  std::unique_ptr<SparseFactor> recovery_factor;
  std::vector<glm::dvec3> recovery_force;

  std::unique_ptr<RotatedFactor> factor;
  int age = 0;

  // A factor being made: while begun, `job_*` and `spare` belong to whoever runs it.
  enum class Job { kNone, kBegun, kDone, kFailed };
  std::atomic<Job> job{Job::kNone};
  std::unique_ptr<RotatedFactor> spare;
  std::shared_ptr<const FactorPlan> job_plan;  // of the factor then, and its parent()
  std::vector<int> job_plan_parent;
  FixedAxes job_fixed;
  bool job_is_shifted = false;  // the tangent was far from positive
  BlockMatrix job_stiffness;
  std::vector<double> job_added;
  std::vector<glm::dmat3> job_rotation;
  // These are the step's own.
  std::vector<int> job_parent;  // the body's nodes in the job's, where cut since it began; or empty
  int job_age = 0;
};

}  // namespace arthro::simulation
