#include "authoring/relief/motion/bundle/bundle.h"

#include <cmath>
#include <optional>

#include <Eigen/Dense>
#include <ceres/ceres.h>
#include <glog/logging.h>

namespace arthro::authoring {
namespace {

constexpr double kLossAt = 1.0;  // px, where the Cauchy loss begins to flatten

// With a factor of the focal length as the last unknown, or without.
struct PixelError {
  const LensProfile& lens;
  const Eigen::Vector2d pixel;

  // Rotation as a quaternion (x, y, z, w).
  template <class T>
  bool operator()(const T* rotation, const T* centre, const T* point, T* error) const {
    const Eigen::Map<const Eigen::Quaternion<T>> turn(rotation);
    const Eigen::Map<const Eigen::Matrix<T, 3, 1>> c(centre), x(point);
    const Eigen::Matrix<T, 3, 1> local = turn.conjugate() * (x - c);
    T at[2];
    if constexpr (std::is_same_v<T, double>)
      lens.Project(local.data(), at);
    else
      lens.ProjectJet(local.data(), at);
    error[0] = at[0] - pixel.x();
    error[1] = at[1] - pixel.y();
    return true;
  }

  template <class T>
  bool operator()(const T* rotation, const T* centre, const T* point, const T* focal,
                  T* error) const {
    if (!(*this)(rotation, centre, point, error)) return false;
    error[0] = (error[0] + pixel.x() - lens.cx()) * focal[0] + lens.cx() - pixel.x();
    error[1] = (error[1] + pixel.y() - lens.cy()) * focal[0] + lens.cy() - pixel.y();
    return true;
  }
};

// A wandering head turns little from one frame to the next.
struct HeadStep {
  const double sigma;  // rad

  template <class T>
  bool operator()(const T* before, const T* after, T* error) const {
    error[0] = (after[0] - before[0]) / sigma;
    return true;
  }
};

// The part of the way from tip to pivot that does not lie along the shaft.
struct PivotError {
  const double view_angle, sigma;

  template <class T>
  bool operator()(const T* rotation, const T* centre, const T* pivot, const T* head_turn,
                  T* error) const {
    using std::cos;
    using std::sin;
    const Eigen::Map<const Eigen::Quaternion<T>> turn(rotation);
    const Eigen::Map<const Eigen::Matrix<T, 3, 1>> c(centre), p(pivot);
    const Eigen::Matrix<T, 3, 1> shaft(sin(view_angle) * sin(head_turn[0]),
                                       sin(view_angle) * cos(head_turn[0]), T(cos(view_angle)));
    const Eigen::Matrix<T, 3, 1> u = turn * shaft, way = p - c;
    const Eigen::Matrix<T, 3, 1> across = way - u * u.dot(way);
    for (int i = 0; i < 3; ++i) error[i] = across[i] / sigma;
    return true;
  }
};

// Keeps the warnings of steps that failed off standard error: the solver tries again with a shorter
// step, and its summary tells the outcome.
void SilenceWarnings() {
  static const bool is_silent = (FLAGS_minloglevel = google::GLOG_ERROR, true);
  static_cast<void>(is_silent);
}

ceres::Solver::Options SolverOptions(int iterations) {
  SilenceWarnings();
  ceres::Solver::Options options;
  options.max_num_iterations = iterations;
  options.function_tolerance = 1e-6;
  options.max_trust_region_radius = 1e8;  // keeps points near infinity from a singular matrix
  options.num_threads = 1;                // sums in one order: the same bytes each time
  options.logging_type = ceres::SILENT;
  return options;
}

class StopCallback : public ceres::IterationCallback {
 public:
  explicit StopCallback(const std::atomic<bool>* stop) : stop_(stop) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    return stop_ && stop_->load(std::memory_order_relaxed) ? ceres::SOLVER_ABORT
                                                           : ceres::SOLVER_CONTINUE;
  }

 private:
  const std::atomic<bool>* stop_;
};

// Holds the largest coordinate of the camera furthest from `fixed`: tracks know no scale.
void FixScale(std::size_t fixed, Reconstruction& scene, std::optional<ceres::SubsetManifold>& kept,
              ceres::Problem& problem) {
  Eigen::Vector3d* furthest = nullptr;
  double most = 0;
  const Eigen::Vector3d origin = scene.poses[fixed]->centre;
  for (auto& pose : scene.poses) {
    if (!pose || !problem.HasParameterBlock(pose->centre.data())) continue;
    const double distance = (pose->centre - origin).norm();
    if (distance > most) most = distance, furthest = &pose->centre;
  }
  if (!furthest) return;
  int axis = 0;
  (*furthest - origin).cwiseAbs().maxCoeff(&axis);
  kept.emplace(3, std::vector<int>{axis});
  problem.SetManifold(furthest->data(), &*kept);
}

// Ties each posed camera of the problem to the portal that its shaft passes.
void AddPivot(Reconstruction& scene, std::vector<Eigen::Quaterniond>& turns,
              ceres::LossFunction& loss, PivotPrior& pivot, ceres::Problem& problem) {
  constexpr double kHeadStep = 0.14;  // rad (8°) per frame
  std::optional<std::size_t> last;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    if (!scene.poses[i] || !problem.HasParameterBlock(turns[i].coeffs().data())) continue;
    double* const head_turn = &pivot.head_turns[i];
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PivotError, 3, 4, 3, 3, 1>(
                                 new PivotError{pivot.view_angle, pivot.sigma}),
                             &loss, turns[i].coeffs().data(), scene.poses[i]->centre.data(),
                             pivot.points[static_cast<std::size_t>(pivot.point_of[i])].data(),
                             head_turn);
    if (!pivot.head_wanders)
      problem.SetParameterBlockConstant(head_turn);
    else if (last)
      problem.AddResidualBlock(new ceres::AutoDiffCostFunction<HeadStep, 1, 1, 1>(new HeadStep{
                                   kHeadStep * std::sqrt(static_cast<double>(i - *last))}),
                               nullptr, &pivot.head_turns[*last], head_turn);
    last = i;
  }
}

}  // namespace

Eigen::Vector3d ShaftInCamera(double view_angle, double head_turn) {
  return {std::sin(view_angle) * std::sin(head_turn), std::sin(view_angle) * std::cos(head_turn),
          std::cos(view_angle)};
}

double AdjustBundle(const std::vector<Track>& tracks, const LensProfile& lens,
                    const BundleOptions& options, Reconstruction& scene, PivotPrior* pivot) {
  std::vector<Eigen::Quaterniond> turns(scene.poses.size());
  for (std::size_t i = 0; i < scene.poses.size(); ++i)
    if (scene.poses[i]) turns[i] = Eigen::Quaterniond(scene.poses[i]->world_from_camera);

  ceres::Problem::Options ownership;
  ownership.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::EigenQuaternionManifold manifold;
  std::optional<ceres::SubsetManifold> scale_manifold;
  ceres::CauchyLoss loss(kLossAt), pivot_loss(3);
  ceres::Problem problem(ownership);
  for (TrackPoint& point : scene.points) {
    const Track& track = tracks[static_cast<std::size_t>(point.track)];
    for (std::size_t k = 0; k < track.seen.size(); ++k) {
      const auto frame = static_cast<std::size_t>(track.seen[k].frame);
      if (!point.uses[k] || !scene.poses[frame]) continue;
      auto* const error = new PixelError{lens, track.seen[k].pixel};
      double *const turn = turns[frame].coeffs().data(), *const centre =
                                                             scene.poses[frame]->centre.data();
      if (options.focal)
        problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PixelError, 2, 4, 3, 3, 1>(error),
                                 &loss, turn, centre, point.position.data(), options.focal);
      else
        problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PixelError, 2, 4, 3, 3>(error),
                                 &loss, turn, centre, point.position.data());
    }
  }
  const int pixel_residuals = problem.NumResiduals();
  if (pixel_residuals == 0) return 0;

  bool is_fixed = false;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    if (!scene.poses[i] || !problem.HasParameterBlock(turns[i].coeffs().data())) continue;
    problem.SetManifold(turns[i].coeffs().data(), &manifold);
    if (is_fixed || (options.fixed_frame >= 0 && options.fixed_frame != static_cast<int>(i)))
      continue;
    is_fixed = true;
    problem.SetParameterBlockConstant(turns[i].coeffs().data());
    problem.SetParameterBlockConstant(scene.poses[i]->centre.data());
    FixScale(i, scene, scale_manifold, problem);
  }
  if (pivot) AddPivot(scene, turns, pivot_loss, *pivot, problem);

  ceres::Solver::Options solver = SolverOptions(options.iterations);
  solver.linear_solver_type = ceres::SPARSE_SCHUR;
  StopCallback stopping(options.stop);
  solver.callbacks.push_back(&stopping);
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  for (std::size_t i = 0; i < turns.size(); ++i)
    if (scene.poses[i])
      scene.poses[i]->world_from_camera = turns[i].normalized().toRotationMatrix();

  // Residuals without the loss, of those that are not outliers.
  double squares = 0;
  int count = 0;
  constexpr double kOutlier = 4;  // px
  for (const TrackPoint& point : scene.points) {
    const Track& track = tracks[static_cast<std::size_t>(point.track)];
    for (std::size_t k = 0; k < track.seen.size(); ++k) {
      const auto& pose = scene.poses[static_cast<std::size_t>(track.seen[k].frame)];
      if (!point.uses[k] || !pose) continue;
      Eigen::Vector2d at;
      lens.Project(pose->InCamera(point.position).data(), at.data());
      const Eigen::Vector2d middle(lens.cx(), lens.cy());
      if (options.focal) at = middle + *options.focal * (at - middle);
      const double error = (at - track.seen[k].pixel).norm();
      if (!(error < kOutlier)) continue;
      squares += error * error;
      ++count;
    }
  }
  return std::sqrt(squares / std::max(1, count));
}

bool AdjustPose(const std::vector<Eigen::Vector3d>& points,
                const std::vector<Eigen::Vector2d>& pixels, const LensProfile& lens,
                CameraPose& pose) {
  Eigen::Quaterniond turn(pose.world_from_camera);
  std::vector<Eigen::Vector3d> copies = points;
  ceres::Problem::Options ownership;
  ownership.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::EigenQuaternionManifold manifold;
  ceres::CauchyLoss loss(kLossAt);
  ceres::Problem problem(ownership);
  for (std::size_t i = 0; i < copies.size(); ++i) {
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<PixelError, 2, 4, 3, 3>(new PixelError{lens, pixels[i]}),
        &loss, turn.coeffs().data(), pose.centre.data(), copies[i].data());
    problem.SetParameterBlockConstant(copies[i].data());
  }
  if (problem.NumResidualBlocks() < 6) return false;
  problem.SetManifold(turn.coeffs().data(), &manifold);
  ceres::Solver::Options solver = SolverOptions(30);
  solver.linear_solver_type = ceres::DENSE_QR;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  pose.world_from_camera = turn.normalized().toRotationMatrix();
  return summary.IsSolutionUsable();
}

}  // namespace arthro::authoring
