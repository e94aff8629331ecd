#include "authoring/panorama/graph/refinement/refine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <Eigen/Cholesky>
#include <ceres/ceres.h>

#include "authoring/panorama/graph/refinement/camera_prior.h"
#include "authoring/panorama/graph/refinement/pair_term.h"

namespace arthro::authoring {
namespace {

constexpr double kMedianOfChi2 = 7.344;  // for eight degrees of freedom
constexpr double kPriorLoss = 4.0;       // deviations from which on a frame's prior loses weight
// Disagreement of pairs above which the prior itself is wrong.
constexpr double kMostDisagreement = 1.25;
constexpr double kWider = 4.0;
constexpr double kWidest = 0.1;

class PairCost final : public ceres::SizedCostFunction<8, 8, 8> {
 public:
  PairCost(const PairTerm& term, const Eigen::Matrix3d& a0, const Eigen::Matrix3d& b0)
      : term_(term), a0_(a0), b0_(b0) {}

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    using RowMajor8 = Eigen::Matrix<double, 8, 8, Eigen::RowMajor>;
    const Eigen::Map<const Vector8> xa(x[0]), xb(x[1]);
    Vector8 whitened;
    Matrix8 by_a, by_b;
    double* const ja = jacobians ? jacobians[0] : nullptr;
    double* const jb = jacobians ? jacobians[1] : nullptr;
    if (!term_.Evaluate(MoveInChart(a0_, xa), MoveInChart(b0_, xb), a0_, b0_, &whitened, nullptr,
                        ja ? &by_a : nullptr, jb ? &by_b : nullptr))
      return false;
    Eigen::Map<Vector8>(residuals, 8) = whitened;
    if (ja) Eigen::Map<RowMajor8>(ja, 8, 8) = by_a;
    if (jb) Eigen::Map<RowMajor8>(jb, 8, 8) = by_b;
    return true;
  }

 private:
  const PairTerm& term_;
  const Eigen::Matrix3d a0_, b0_;
};

class CameraCost final : public ceres::SizedCostFunction<2, 8> {
 public:
  CameraCost(const CameraPrior& prior, const Eigen::Matrix3d& origin)
      : prior_(prior), origin_(origin) {}

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    Eigen::Vector2d residual;
    Eigen::Matrix<double, 2, 8> by_frame;
    double* const j = jacobians ? jacobians[0] : nullptr;
    if (!prior_.Evaluate(MoveInChart(origin_, Eigen::Map<const Vector8>(x[0])), origin_, &residual,
                         j ? &by_frame : nullptr))
      return false;
    Eigen::Map<Eigen::Vector2d>(residuals, 2) = residual;
    if (j) Eigen::Map<Eigen::Matrix<double, 2, 8, Eigen::RowMajor>>(j, 2, 8) = by_frame;
    return true;
  }

 private:
  const CameraPrior prior_;
  const Eigen::Matrix3d origin_;
};

// State between the iterations of one refinement.
class Refinement {
 public:
  Refinement(const std::vector<PairEstimate>& pairs, const std::vector<cv::Matx33d>& start,
             const RefineOptions& options)
      : options_(options), normalisation_(NormalisationOf(pairs)) {
    for (const cv::Matx33d& m : start) places_.push_back(normalisation_.Normalise(m));
    joined_.assign(start.size(), false);
    for (const PairEstimate& pair : pairs) {
      terms_.emplace_back(pair, normalisation_, options.pair_floor);
      joined_[At(pair.a)] = joined_[At(pair.b)] = true;
    }
  }

  // Squared whitened residual of every pair; infinity when it cannot be evaluated.
  std::vector<double> Squares(std::vector<double>* error_px) const {
    std::vector<double> squares;
    for (const PairTerm& term : terms_) {
      const Eigen::Matrix3d &a = places_[At(term.a())], &b = places_[At(term.b())];
      Vector8 whitened, px;
      const bool valid = term.Evaluate(a, b, a, b, &whitened, &px, nullptr, nullptr);
      const double none = std::numeric_limits<double>::infinity();
      squares.push_back(valid ? whitened.squaredNorm() : none);
      if (error_px) error_px->push_back(valid ? px.norm() / 2 : none);
    }
    return squares;
  }

  // Runs one robust solve with a loss from `loss_at` on, a whitened norm. Returns its iterations.
  // `prior` may be null.
  int Solve(int fixed_frame, double loss_at, const CameraPrior* prior, RefineSolver solver) {
    const std::vector<double> squares = Squares(nullptr);
    std::vector<Vector8> moves(places_.size(), Vector8::Zero());
    ceres::Problem problem;
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      const PairTerm& term = terms_[i];
      if (!std::isfinite(squares[i])) continue;
      problem.AddResidualBlock(new PairCost(term, places_[At(term.a())], places_[At(term.b())]),
                               new ceres::CauchyLoss(loss_at), moves[At(term.a())].data(),
                               moves[At(term.b())].data());
    }
    if (problem.NumResidualBlocks() == 0) return 0;
    double* const fixed = moves[At(fixed_frame)].data();
    if (prior) {
      for (std::size_t i = 0; i < places_.size(); ++i)
        if (problem.HasParameterBlock(moves[i].data()))
          problem.AddResidualBlock(new CameraCost(*prior, places_[i]),
                                   new ceres::CauchyLoss(kPriorLoss), moves[i].data());
      // The prior determines the plane up to a similarity: four of the fixed frame's numbers.
      if (problem.HasParameterBlock(fixed))
        problem.SetManifold(fixed, new ceres::SubsetManifold(8, {0, 1, 2, 5}));
    } else if (problem.HasParameterBlock(fixed)) {
      problem.SetParameterBlockConstant(fixed);
    }
    ceres::Solver::Options how;
    how.linear_solver_type =
        solver == RefineSolver::kSparse ? ceres::SPARSE_NORMAL_CHOLESKY : ceres::DENSE_QR;
    how.max_num_iterations = options_.refine_iterations;
    how.num_threads = 1;  // one thread: the order of sums, and so every bit, stays the same
    how.logging_type = ceres::SILENT;
    how.function_tolerance = 1e-9;
    how.parameter_tolerance = 1e-10;
    ceres::Solver::Summary summary;
    ceres::Solve(how, &problem, &summary);
    if (!summary.IsSolutionUsable()) return 0;
    cost_ = summary.final_cost;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const Eigen::Matrix3d moved = MoveInChart(places_[i], moves[i]);
      if (moved.allFinite()) places_[i] = moved / moved.norm() * std::sqrt(3.0);
    }
    return static_cast<int>(summary.iterations.size());
  }

  // Moves all frames to the plane that satisfies the camera's rule best: shear, height and the two
  // numbers of perspective, by damped Gauss-Newton. Numbers that frames of one direction leave free
  // stay unchanged.
  void Straighten(const Pinhole& camera) {
    const CameraPrior rule(camera, normalisation_, 1.0);
    const auto plane_of = [](const Eigen::Vector4d& p) {
      Eigen::Matrix3d plane;
      plane << 1, p[0], 0, 0, 1 + p[1], 0, p[2], p[3], 1;
      return plane;
    };
    const auto residuals_of = [&](const Eigen::Vector4d& p) {
      Eigen::VectorXd all = Eigen::VectorXd::Zero(2 * static_cast<Eigen::Index>(places_.size()));
      const Eigen::Matrix3d plane = plane_of(p);
      for (std::size_t i = 0; i < places_.size(); ++i) {
        Eigen::Vector2d one = Eigen::Vector2d::Zero();
        if (joined_[i] && rule.Evaluate(plane * places_[i], places_[i], &one, nullptr))
          all.segment<2>(2 * static_cast<Eigen::Index>(i)) = one;
      }
      return all;
    };
    Eigen::Vector4d p = Eigen::Vector4d::Zero();
    Eigen::VectorXd here = residuals_of(p);
    double damping = 1e-3;
    for (int step = 0; step < 30; ++step) {
      constexpr double kStep = 1e-6;
      Eigen::MatrixXd jacobian(here.size(), 4);
      for (int j = 0; j < 4; ++j)
        jacobian.col(j) = (residuals_of(p + kStep * Eigen::Vector4d::Unit(j)) - here) / kStep;
      Eigen::Matrix4d normal = jacobian.transpose() * jacobian;
      normal += damping * (normal.trace() / 4 + 1e-12) * Eigen::Matrix4d::Identity();
      const Eigen::Vector4d move = -normal.ldlt().solve(jacobian.transpose() * here);
      if (!move.allFinite()) break;
      const Eigen::VectorXd there = residuals_of(p + move);
      if (there.squaredNorm() < here.squaredNorm()) {
        p += move;
        here = there;
        damping = std::max(1e-9, damping * 0.2);
        if (move.norm() < 1e-9) break;
      } else {
        damping *= 10;
        if (damping > 1e6) break;
      }
    }
    for (Eigen::Matrix3d& place : places_) {
      place = plane_of(p) * place;
      place *= std::sqrt(3.0) / place.norm();
    }
  }

  double cost() const { return cost_; }  // cost of the last solve
  const Normalisation& normalisation() const { return normalisation_; }
  const std::vector<Eigen::Matrix3d>& places() const { return places_; }
  void SetPlaces(const std::vector<Eigen::Matrix3d>& places) { places_ = places; }

  cv::Matx33d PlaceOf(std::size_t i) const { return normalisation_.Denormalise(places_[i]); }

 private:
  static std::size_t At(int i) { return static_cast<std::size_t>(i); }

  const RefineOptions options_;
  const Normalisation normalisation_;
  std::vector<Eigen::Matrix3d> places_;
  std::vector<PairTerm> terms_;
  std::vector<bool> joined_;
  double cost_ = 0;
};

// Factor by which covariances are too small, from the median disagreement of the pairs: half of
// them may be wrong. Never below 1, since a tree of pairs agrees perfectly by construction.
double FactorOf(std::vector<double> squares, std::size_t frames) {
  if (squares.empty()) return 1;
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  // Corrects for the residual that the frames' degrees of freedom absorb.
  const double pairs = static_cast<double>(squares.size());
  const double free = (pairs - static_cast<double>(frames) + 1) / pairs;
  if (!std::isfinite(*middle) || free <= 0.02) return 1;
  return std::max(1.0, *middle / (kMedianOfChi2 * free));
}

}  // namespace

Refined Refine(const std::vector<PairEstimate>& pairs, const std::vector<cv::Matx33d>& start,
               int fixed_frame, const RefineOptions& options, const std::optional<Pinhole>& camera,
               RefineSolver solver) {
  Refinement refinement(pairs, start, options);
  std::vector<bool> is_joined(start.size(), false);
  for (const PairEstimate& pair : pairs)
    is_joined[static_cast<std::size_t>(pair.a)] = is_joined[static_cast<std::size_t>(pair.b)] =
        true;
  const auto frames =
      static_cast<std::size_t>(std::count(is_joined.begin(), is_joined.end(), true));

  // A start from a tree of pairs is off at loops, so the first iteration has a wide loss. Later
  // iterations scale the covariances by the residuals.
  Refined refined;
  double factor = std::max(25.0, FactorOf(refinement.Squares(nullptr), frames));
  for (int round = 0; round < 3; ++round) {
    const double loss_at = options.loss_scale * std::sqrt(8.0 * factor);
    refined.iterations += refinement.Solve(fixed_frame, loss_at, nullptr, solver);
    factor = FactorOf(refinement.Squares(nullptr), frames);
  }

  // Then applies the rule of a calibrated scope, as tightly as the pairs allow.
  if (camera && options.camera_deviation > 0 && frames > 2) {
    const std::vector<Eigen::Matrix3d> free = refinement.places();
    for (double deviation = options.camera_deviation; deviation < kWidest; deviation *= kWider) {
      refinement.Straighten(*camera);
      const CameraPrior prior(*camera, refinement.normalisation(), deviation);
      for (int round = 0; round < 2; ++round)
        refined.iterations += refinement.Solve(
            fixed_frame, options.loss_scale * std::sqrt(8.0 * factor), &prior, solver);
      const double held = FactorOf(refinement.Squares(nullptr), frames);
      if (held <= kMostDisagreement * factor) {
        refined.camera_deviation = deviation;
        factor = held;
        break;
      }
      refinement.SetPlaces(free);
    }
  }

  refined.variance_factor = factor;
  for (const double square : refinement.Squares(&refined.pair_error_px))
    refined.pair_surprise.push_back(std::sqrt(square / (8.0 * factor)));
  for (std::size_t i = 0; i < start.size(); ++i)
    refined.plane_from_frame.push_back(is_joined[i] ? refinement.PlaceOf(i) : start[i]);
  return refined;
}

double CameraMisfit(const std::vector<PairEstimate>& pairs, int fixed_frame,
                    const RefineOptions& options, const Pinhole& camera, double pair_factor,
                    std::vector<cv::Matx33d>* places) {
  Refinement refinement(pairs, *places, options);
  const double loss_at = options.loss_scale * std::sqrt(8.0 * pair_factor);
  refinement.Solve(fixed_frame, loss_at, nullptr, RefineSolver::kSparse);
  refinement.Straighten(camera);
  const CameraPrior prior(camera, refinement.normalisation(), options.camera_deviation);
  refinement.Solve(fixed_frame, loss_at, &prior, RefineSolver::kSparse);
  for (std::size_t i = 0; i < places->size(); ++i) (*places)[i] = refinement.PlaceOf(i);
  return refinement.cost();
}

}  // namespace arthro::authoring
