#include "authoring/lens/fit/lens_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <Eigen/Dense>
#include <ceres/ceres.h>

#include "authoring/lens/fit/lens_residual.h"

namespace arthro::authoring {
namespace {

constexpr double kRobustScale = 1.0;   // px; a residual beyond it pulls with constant force
constexpr double kOutlier = 5.0;       // times the robust sigma
constexpr double kLeastOutlier = 0.6;  // px; smaller residuals are never outliers

std::vector<double> ParametersOf(const LensNumbers& lens, bool has_aspect) {
  std::vector<double> values = {lens.focal, lens.cx, lens.cy};
  if (has_aspect) values.push_back(lens.aspect);
  for (int n = 0; n < OwnParametersOf(lens.model); ++n) values.push_back(lens.own[n]);
  return values;
}

void Store(const std::vector<double>& values, bool has_aspect, LensNumbers& lens) {
  lens.focal = values[0];
  lens.cx = values[1];
  lens.cy = values[2];
  if (has_aspect) lens.aspect = values[3];
  for (int n = 0; n < OwnParametersOf(lens.model); ++n)
    lens.own[n] = values[n + (has_aspect ? 4 : 3)];
}

// One fit: the points that are used, and their cost.
class Solver {
 public:
  Solver(const std::vector<TargetView>& views, LensFit& fit, const FitOptions& options)
      : views_(views), fit_(fit), options_(options), lens_(ParametersOf(fit.lens, options.aspect)) {
    for (std::size_t v = 0; v < views.size(); ++v)
      for (const LatticePoint& point : views[v].points)
        terms_.push_back({std::make_unique<LensResidual>(fit.lens.model, options.aspect,
                                                         cv::Point2d(point.i, point.j), point.pixel,
                                                         fit.lens.aspect),
                          v, true});
  }

  bool Solve(bool robust) {
    if (!IsDefinedEverywhere()) return false;
    ceres::Problem::Options ownership;
    ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres::Problem problem(ownership);
    auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    for (Term& term : terms_)
      if (term.used)
        problem.AddResidualBlock(term.cost.get(),
                                 robust ? new ceres::HuberLoss(kRobustScale) : nullptr,
                                 lens_.data(), fit_.poses[term.view].data());
    for (BoardPose& pose : fit_.poses)
      if (problem.HasParameterBlock(pose.data())) ordering->AddElementToGroup(pose.data(), 0);
    if (!problem.HasParameterBlock(lens_.data())) return false;
    ordering->AddElementToGroup(lens_.data(), 1);
    if (options_.own_poses_only) problem.SetParameterBlockConstant(lens_.data());
    const int own = static_cast<int>(lens_.size()) - OwnParametersOf(fit_.lens.model);
    if (fit_.lens.model == FitModel::kDoubleSphere) {
      problem.SetParameterLowerBound(lens_.data(), own, -0.95);
      problem.SetParameterUpperBound(lens_.data(), own, 1);
      problem.SetParameterLowerBound(lens_.data(), own + 1, 0);
      problem.SetParameterUpperBound(lens_.data(), own + 1, 1);
    }
    ceres::Solver::Options solve;
    solve.linear_solver_type = ceres::DENSE_SCHUR;
    solve.linear_solver_ordering = ordering;
    solve.num_threads = 1;  // one thread: the same bytes on every run
    solve.max_num_iterations = 30;
    solve.function_tolerance = 1e-8;
    solve.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(solve, &problem, &summary);
    return summary.IsSolutionUsable();
  }

  // A pinhole model, for example, has no pixel for a point beside the camera.
  bool IsDefinedEverywhere() const {
    return std::all_of(terms_.begin(), terms_.end(), [this](const Term& term) {
      return !term.used || std::isfinite(ResidualOf(term));
    });
  }

  // Keeps points within a few robust sigmas; true when that changed the selection.
  bool LeaveOutOutliers() {
    std::vector<double> sizes;
    for (const Term& term : terms_) sizes.push_back(ResidualOf(term));
    std::vector<double> sorted = sizes;
    std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
    // The median length of a two-dimensional normal vector is 1.18 sigma.
    const double limit = std::max(kLeastOutlier, kOutlier * sorted[sorted.size() / 2] / 1.1774);
    bool changed = false;
    for (std::size_t n = 0; n < terms_.size(); ++n) {
      const bool used = sizes[n] <= limit;
      changed |= used != terms_[n].used;
      terms_[n].used = used;
    }
    return changed;
  }

  void Finish() {
    Store(lens_, options_.aspect, fit_.lens);
    double sum = 0;
    fit_.points_used = fit_.points_left_out = 0;
    for (const Term& term : terms_) {
      if (!term.used) {
        ++fit_.points_left_out;
        continue;
      }
      ++fit_.points_used;
      sum += std::pow(ResidualOf(term), 2);
    }
    fit_.rms_px = fit_.points_used > 0 ? std::sqrt(sum / fit_.points_used) : 0;
    fit_.parameters = static_cast<int>(lens_.size());
    fit_.has_aspect = options_.aspect;
    if (!options_.own_poses_only) FindCovariance(sum);
  }

 private:
  struct Term {
    std::unique_ptr<LensResidual> cost;
    std::size_t view;
    bool used;
  };

  double ResidualOf(const Term& term) const {
    const double* parameters[2] = {lens_.data(), fit_.poses[term.view].data()};
    double residual[2];
    if (!term.cost->Evaluate(parameters, residual, nullptr))
      return std::numeric_limits<double>::infinity();
    return std::hypot(residual[0], residual[1]);
  }

  // Block of the inverse normal matrix that belongs to the lens: the poses are eliminated view by
  // view.
  void FindCovariance(double sum) {
    const int n = static_cast<int>(lens_.size());
    Eigen::MatrixXd reduced = Eigen::MatrixXd::Zero(n, n);
    for (std::size_t v = 0; v < views_.size(); ++v) {
      Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n), b = Eigen::MatrixXd::Zero(n, 6);
      Eigen::Matrix<double, 6, 6> c = Eigen::Matrix<double, 6, 6>::Zero();
      for (const Term& term : terms_) {
        if (term.view != v || !term.used) continue;
        Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor> by_lens(2, n);
        Eigen::Matrix<double, 2, 6, Eigen::RowMajor> by_pose;
        const double* parameters[2] = {lens_.data(), fit_.poses[v].data()};
        double residual[2];
        double* jacobians[2] = {by_lens.data(), by_pose.data()};
        if (!term.cost->Evaluate(parameters, residual, jacobians)) continue;
        a += by_lens.transpose() * by_lens;
        b += by_lens.transpose() * by_pose;
        c += by_pose.transpose() * by_pose;
      }
      const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> solver(c);
      if (solver.info() == Eigen::Success && solver.vectorD().minCoeff() > 0)
        reduced += a - b * solver.solve(b.transpose());
    }
    const int freedom = 2 * fit_.points_used - n - 6 * static_cast<int>(views_.size());
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(reduced);
    if (freedom <= 0 || eigen.info() != Eigen::Success ||
        !(eigen.eigenvalues()[0] > 1e-14 * eigen.eigenvalues()[n - 1]))
      return void(fit_.covariance.resize(0, 0));
    fit_.covariance = sum / freedom * eigen.eigenvectors() *
                      eigen.eigenvalues().cwiseInverse().asDiagonal() *
                      eigen.eigenvectors().transpose();
  }

  const std::vector<TargetView>& views_;
  LensFit& fit_;
  const FitOptions& options_;
  std::vector<double> lens_;
  std::vector<Term> terms_;
};

std::vector<BoardRay> RaysOf(const TargetView& view, const Lens& lens) {
  std::vector<BoardRay> rays;
  for (const LatticePoint& point : view.points)
    if (const auto ray = RayFromPixel(lens, {point.pixel.x, point.pixel.y}))
      rays.push_back({cv::Point2d(point.i, point.j), cv::Vec3d(ray->x, ray->y, ray->z)});
  return rays;
}

// Poses of all views under a lens, and their error: the mean residual, each cut at 20 px.
std::optional<std::vector<BoardPose>> PosesUnder(const std::vector<TargetView>& views,
                                                 const LensNumbers& numbers, cv::Size picture,
                                                 double& cost) {
  constexpr double kCut = 20;
  const Lens lens = numbers.AsLens(picture);
  std::vector<BoardPose> poses;
  double sum = 0;
  int count = 0;
  for (const TargetView& view : views) {
    const auto rays = RaysOf(view, lens);
    const auto pose = PoseFromRays(rays);
    if (!pose) return std::nullopt;
    const std::vector<double> values = ParametersOf(numbers, false);
    for (const LatticePoint& point : view.points) {
      const LensResidual residual(numbers.model, false, cv::Point2d(point.i, point.j), point.pixel,
                                  numbers.aspect);
      const double* parameters[2] = {values.data(), pose->data()};
      double r[2];
      sum +=
          residual.Evaluate(parameters, r, nullptr) ? std::min(kCut, std::hypot(r[0], r[1])) : kCut;
      ++count;
    }
    poses.push_back(*pose);
  }
  cost = count > 0 ? sum / count : kCut;
  return poses;
}

}  // namespace

Lens LensNumbers::AsLens(cv::Size picture) const {
  Lens lens;
  lens.width = picture.width;
  lens.height = picture.height;
  lens.cx = cx;
  lens.cy = cy;
  lens.aspect = aspect;
  StoreModel(model, focal, own, lens);
  return lens;
}

std::optional<LensFit> StartFit(const std::vector<TargetView>& views, cv::Size picture,
                                const cv::Point2d& centre, double window_radius) {
  std::optional<LensFit> best;
  double lowest = 0;
  // Full fields of view from 15 to 200 degrees, each 20 % larger than the last.
  for (double degrees = 15; degrees <= 200; degrees *= 1.2) {
    LensFit fit;
    fit.lens.cx = centre.x;
    fit.lens.cy = centre.y;
    fit.lens.focal = window_radius / (2 * std::sin(degrees * CV_PI / 180 / 4));
    double cost = 0;
    const auto poses = PosesUnder(views, fit.lens, picture, cost);
    if (!poses || (best && cost >= lowest)) continue;
    lowest = cost;
    fit.poses = *poses;
    best = fit;
  }
  return best;
}

LensFit FitLens(const std::vector<TargetView>& views, FitModel model, const LensFit& start,
                const FitOptions& options) {
  LensFit fit = start;
  if (fit.lens.model != model) {
    fit.lens.model = model;
    fit.lens.own = StartOf(model, fit.lens.focal);
  }
  Solver solver(views, fit, options);
  fit.converged = solver.Solve(true);
  if (fit.converged) {
    solver.LeaveOutOutliers();
    fit.converged = solver.Solve(false);
  }
  solver.Finish();
  return fit;
}

double HeldOutRms(const std::vector<TargetView>& views, const LensFit& fit) {
  double sum = 0;
  int count = 0;
  for (const TargetView& view : views) {
    double cost = 0;
    const auto poses = PosesUnder({view}, fit.lens, {1, 1}, cost);
    if (!poses) return std::numeric_limits<double>::quiet_NaN();
    LensFit start = fit;
    start.poses = *poses;
    FitOptions options;
    options.own_poses_only = true;
    const LensFit alone = FitLens({view}, fit.lens.model, start, options);
    sum += alone.rms_px * alone.rms_px * alone.points_used;
    count += alone.points_used;
  }
  return count > 0 ? std::sqrt(sum / count) : std::numeric_limits<double>::quiet_NaN();
}

double RadiusSigma(const LensFit& fit, double theta) {
  RadialValue value;
  if (fit.covariance.rows() == 0 ||
      !EvaluateRadius(fit.lens.model, fit.lens.focal, fit.lens.own, theta, value))
    return std::numeric_limits<double>::infinity();
  Eigen::VectorXd by = Eigen::VectorXd::Zero(fit.covariance.rows());
  by[0] = value.by_focal;
  const int first_own = fit.has_aspect ? 4 : 3;
  for (int n = 0; n < OwnParametersOf(fit.lens.model); ++n) by[first_own + n] = value.by_own[n];
  return std::sqrt(std::max(0.0, by.dot(fit.covariance * by)));
}

}  // namespace arthro::authoring
