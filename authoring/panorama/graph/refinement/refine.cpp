#include "authoring/panorama/graph/refinement/refine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <ceres/ceres.h>

#include "authoring/panorama/graph/refinement/pair_term.h"

namespace arthro::authoring {
namespace {

constexpr double kMedianOfChi2 = 7.344;  // of eight degrees of freedom

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

// What is kept between the rounds of one refinement.
class Refinement {
 public:
  Refinement(const std::vector<PairEstimate>& pairs, const std::vector<cv::Matx33d>& start,
             const RefineOptions& options)
      : options_(options), normalisation_(NormalisationOf(pairs)) {
    for (const cv::Matx33d& m : start) places_.push_back(normalisation_.Normalise(m));
    for (const PairEstimate& pair : pairs)
      terms_.emplace_back(pair, normalisation_, options.pair_floor);
  }

  // Squared whitened residual of every pair; infinity where it cannot be evaluated.
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

  // One robust solve whose loss begins at `loss_at`, a whitened norm. Returns its iterations.
  int Solve(int fixed_frame, double loss_at, RefineSolver solver) {
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
    if (problem.HasParameterBlock(moves[At(fixed_frame)].data()))
      problem.SetParameterBlockConstant(moves[At(fixed_frame)].data());
    ceres::Solver::Options how;
    how.linear_solver_type =
        solver == RefineSolver::kSparse ? ceres::SPARSE_NORMAL_CHOLESKY : ceres::DENSE_QR;
    how.max_num_iterations = options_.most_iterations;
    how.num_threads = 1;  // the order of sums, and so every bit, stays the same
    how.logging_type = ceres::SILENT;
    how.function_tolerance = 1e-9;
    how.parameter_tolerance = 1e-10;
    ceres::Solver::Summary summary;
    ceres::Solve(how, &problem, &summary);
    if (!summary.IsSolutionUsable()) return 0;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const Eigen::Matrix3d moved = MoveInChart(places_[i], moves[i]);
      if (moved.allFinite()) places_[i] = moved / moved.norm() * std::sqrt(3.0);
    }
    return static_cast<int>(summary.iterations.size());
  }

  cv::Matx33d PlaceOf(std::size_t i) const { return normalisation_.Denormalise(places_[i]); }

 private:
  static std::size_t At(int i) { return static_cast<std::size_t>(i); }

  const RefineOptions options_;
  const Normalisation normalisation_;
  std::vector<Eigen::Matrix3d> places_;
  std::vector<PairTerm> terms_;
};

// By how much covariances are too small, from the middle of what pairs disagree: half of them may
// be wrong. Never below 1: agreement that is too good (a tree of pairs has none to disagree with)
// promises nothing.
double FactorOf(std::vector<double> squares, std::size_t frames) {
  if (squares.empty()) return 1;
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  // The share of the residual that the frames' own freedom has eaten is given back.
  const double pairs = static_cast<double>(squares.size());
  const double free = (pairs - static_cast<double>(frames) + 1) / pairs;
  if (!std::isfinite(*middle) || free <= 0.02) return 1;
  return std::max(1.0, *middle / (kMedianOfChi2 * free));
}

}  // namespace

Refined Refine(const std::vector<PairEstimate>& pairs, const std::vector<cv::Matx33d>& start,
               int fixed_frame, const RefineOptions& options, RefineSolver solver) {
  Refinement refinement(pairs, start, options);
  std::vector<bool> is_joined(start.size(), false);
  for (const PairEstimate& pair : pairs)
    is_joined[static_cast<std::size_t>(pair.a)] = is_joined[static_cast<std::size_t>(pair.b)] =
        true;
  const auto frames =
      static_cast<std::size_t>(std::count(is_joined.begin(), is_joined.end(), true));

  // A start from a tree of pairs is off where loops close, so the first round forgives more; the
  // later rounds know from the residuals how good the covariances are.
  Refined refined;
  double factor = std::max(25.0, FactorOf(refinement.Squares(nullptr), frames));
  for (int round = 0; round < 3; ++round) {
    const double loss_at = options.loss_scale * std::sqrt(8.0 * factor);
    refined.iterations += refinement.Solve(fixed_frame, loss_at, solver);
    factor = FactorOf(refinement.Squares(nullptr), frames);
  }

  refined.variance_factor = factor;
  for (const double square : refinement.Squares(&refined.pair_error_px))
    refined.pair_surprise.push_back(std::sqrt(square / (8.0 * factor)));
  for (std::size_t i = 0; i < start.size(); ++i)
    refined.plane_from_frame.push_back(is_joined[i] ? refinement.PlaceOf(i) : start[i]);
  return refined;
}

}  // namespace arthro::authoring
