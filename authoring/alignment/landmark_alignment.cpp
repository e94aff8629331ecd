#include "authoring/alignment/landmark_alignment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <ceres/ceres.h>
#include <ceres/rotation.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "simulation/core/geometry/box3.h"

namespace arthro::authoring {
namespace {

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;

constexpr double kCauchyScale = 2.0;  // standard errors at which a pair begins to lose weight
// Spread across a line, as a share of that along it, below which the turn is not known.
constexpr double kCollinear = 0.01;
constexpr double kLeastScale = 0.2, kMostScale = 5.0;  // multiples of the present scale
constexpr std::size_t kMostTriples = 1000;
constexpr int kRefined = 3;  // best candidates that are fitted to all pairs

Vector From(const glm::dvec3& x) { return {x.x, x.y, x.z}; }
glm::dvec3 From(const Vector& x) { return {x.x(), x.y(), x.z()}; }

// A pair that takes part, with the whitening matrix of its error.
struct Term {
  std::size_t pair = 0;
  Vector model, scene;
  Matrix whiten;
};

struct Similarity {
  double scale = 1;
  Matrix rotation = Matrix::Identity();
  Vector position = Vector::Zero();  // middle of the model, portal frame
};

// Whitens an error whose standard deviations across and along the line of sight are given.
Matrix WhiteningOf(const ScenePoint& scene, double model_sigma) {
  const double across = std::hypot(scene.lateral_sigma, model_sigma);
  const double along = std::hypot(scene.range_sigma, model_sigma);
  const glm::dvec3 line = scene.x_in_portal - scene.eye;
  constexpr double kLeast = 1e-6;  // m
  Matrix whiten = Matrix::Identity() / std::max(across, kLeast);
  if (glm::length(line) > 0) {
    const Vector d = From(glm::normalize(line));
    whiten += d * d.transpose() * (1 / std::max(along, kLeast) - 1 / std::max(across, kLeast));
  }
  return whiten;
}

Vector ErrorOf(const Term& term, const Similarity& pose, const Vector& middle) {
  return pose.scale * (pose.rotation * (term.model - middle)) + pose.position - term.scene;
}

double SquaredSigmas(const Term& term, const Similarity& pose, const Vector& middle) {
  return (term.whiten * ErrorOf(term, pose, middle)).squaredNorm();
}

double CauchyCost(double squared) {
  return kCauchyScale * kCauchyScale * std::log1p(squared / (kCauchyScale * kCauchyScale));
}

// Closed form of three pairs [Umeyama 1991]; nothing for three on a line.
std::optional<Similarity> FromTriple(const std::array<const Term*, 3>& terms, double scale,
                                     bool solves_scale, const Vector& middle) {
  Vector from = Vector::Zero(), to = Vector::Zero();
  for (const Term* term : terms) from += term->model / 3, to += term->scene / 3;
  Matrix product = Matrix::Zero();
  double spread = 0;
  for (const Term* term : terms) {
    product += (term->scene - to) * (term->model - from).transpose();
    spread += (term->model - from).squaredNorm();
  }
  const Eigen::JacobiSVD<Matrix> svd(product, Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (!(svd.singularValues()[1] > kCollinear * kCollinear * svd.singularValues()[0]))
    return std::nullopt;
  Vector sign(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1);
  Similarity pose;
  pose.rotation = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  pose.scale = scale;
  if (solves_scale) {
    pose.scale = svd.singularValues().dot(sign) / spread;
    if (!(pose.scale >= kLeastScale * scale && pose.scale <= kMostScale * scale))
      return std::nullopt;
  }
  pose.position = to + pose.scale * (pose.rotation * (middle - from));
  return pose;
}

// Candidates of triples, the best first. Of many triples a regular selection is taken.
std::vector<Similarity> Candidates(const std::vector<Term>& terms, double scale, bool solves_scale,
                                   const Vector& middle, int& count) {
  const std::size_t n = terms.size();
  const std::size_t all = n * (n - 1) * (n - 2) / 6;
  const std::size_t stride = (all + kMostTriples - 1) / kMostTriples;
  std::vector<std::pair<double, Similarity>> found;
  std::size_t number = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      for (std::size_t k = j + 1; k < n; ++k) {
        if (number++ % stride != 0) continue;
        const auto pose =
            FromTriple({&terms[i], &terms[j], &terms[k]}, scale, solves_scale, middle);
        if (!pose) continue;
        double cost = 0;
        for (const Term& term : terms) cost += CauchyCost(SquaredSigmas(term, *pose, middle));
        found.emplace_back(cost, *pose);
      }
  count = static_cast<int>(found.size());
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Similarity> best;
  for (const auto& [cost, pose] : found)
    if (best.size() < kRefined) best.push_back(pose);
  return best;
}

// Error of one pair after a small turn, the motion of the model's middle and a change of scale.
struct PairCost {
  const Term& term;
  Vector arm;  // scale * rotation * (model - middle) at the start
  template <class T>
  bool operator()(const T* motion, const T* log_scale, T* residual) const {
    const T from[3] = {T(arm.x()), T(arm.y()), T(arm.z())};
    T turned[3];
    ceres::AngleAxisRotatePoint(motion, from, turned);
    const T scale = exp(log_scale[0]);
    Eigen::Matrix<T, 3, 1> error;
    for (int axis = 0; axis < 3; ++axis)
      error[axis] = scale * turned[axis] + motion[3 + axis] - T(term.scene[axis]);
    Eigen::Map<Eigen::Matrix<T, 3, 1>>{residual} = term.whiten.cast<T>() * error;
    return true;
  }
};

struct Fitted {
  Similarity pose;
  double cost = std::numeric_limits<double>::max();
  int iterations = 0;
};

Fitted Fit(const std::vector<Term>& terms, const Similarity& start, bool solves_scale,
           const Vector& middle) {
  std::array<double, 6> motion{0, 0, 0, start.position.x(), start.position.y(), start.position.z()};
  double log_scale = 0;
  ceres::Problem problem;
  for (const Term& term : terms)
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PairCost, 3, 6, 1>(new PairCost{
                                 term, start.scale * (start.rotation * (term.model - middle))}),
                             new ceres::CauchyLoss(kCauchyScale), motion.data(), &log_scale);
  if (!solves_scale) problem.SetParameterBlockConstant(&log_scale);
  ceres::Solver::Options how;
  how.linear_solver_type = ceres::DENSE_QR;
  how.num_threads = 1;
  how.max_num_iterations = 50;
  how.function_tolerance = 1e-10;
  how.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(how, &problem, &summary);
  Fitted fitted;
  double axis_angle[3] = {motion[0], motion[1], motion[2]};
  Matrix turn;
  ceres::AngleAxisToRotationMatrix(axis_angle, turn.data());  // column by column, as Eigen's
  fitted.pose.rotation = turn * start.rotation;
  fitted.pose.position = {motion[3], motion[4], motion[5]};
  fitted.pose.scale = start.scale * std::exp(log_scale);
  fitted.cost = summary.final_cost;
  fitted.iterations = static_cast<int>(summary.iterations.size()) - 1;
  return fitted;
}

// Best fit from the candidates to all of `terms`; nothing where no triple gives a pose.
std::optional<Fitted> BestFit(const std::vector<Term>& terms, double scale, bool solves_scale,
                              const Vector& middle, LandmarkAlignment& alignment) {
  std::optional<Fitted> best;
  int count = 0;
  for (const Similarity& start : Candidates(terms, scale, solves_scale, middle, count)) {
    const Fitted fitted = Fit(terms, start, solves_scale, middle);
    alignment.iterations += fitted.iterations;
    if (!best || fitted.cost < best->cost) best = fitted;
  }
  alignment.candidates += count;
  return best;
}

// Standard errors by the inverse of the normal equations; larger where the residuals are larger
// than the errors that were stated.
void PredictErrors(const std::vector<Term>& terms, const Similarity& pose, bool solves_scale,
                   const Vector& middle, LandmarkAlignment& alignment) {
  const int unknowns = solves_scale ? 7 : 6;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
  double sum = 0;
  for (const Term& term : terms) {
    const Vector arm = pose.scale * (pose.rotation * (term.model - middle));
    Eigen::MatrixXd jacobian(3, unknowns);
    Matrix cross;
    cross << 0, -arm.z(), arm.y(), arm.z(), 0, -arm.x(), -arm.y(), arm.x(), 0;
    jacobian.leftCols<3>() = -cross;
    jacobian.middleCols<3>(3) = Matrix::Identity();
    if (solves_scale) jacobian.col(6) = arm;
    jacobian = (term.whiten * jacobian).eval();
    normal += jacobian.transpose() * jacobian;
    sum += SquaredSigmas(term, pose, middle);
  }
  const int freedom = 3 * static_cast<int>(terms.size()) - unknowns;
  const Eigen::MatrixXd covariance = std::max(1.0, sum / freedom) * normal.inverse();
  alignment.rotation_sigma = std::sqrt(covariance.topLeftCorner<3, 3>().trace());
  alignment.worst_rotation_sigma = std::sqrt(
      Eigen::SelfAdjointEigenSolver<Matrix>(covariance.topLeftCorner<3, 3>()).eigenvalues()[2]);
  alignment.position_sigma = std::sqrt(covariance.block<3, 3>(3, 3).trace());
  if (solves_scale) alignment.scale_sigma = std::sqrt(covariance(6, 6));
}

Pose PoseOf(const Similarity& pose, const Vector& middle) {
  glm::dmat3 rotation;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) rotation[column][row] = pose.rotation(row, column);
  return {From(pose.position - pose.scale * (pose.rotation * middle)),
          glm::normalize(glm::quat_cast(rotation)), pose.scale};
}

}  // namespace

glm::dvec3 SpreadOf(std::span<const glm::dvec3> points) {
  if (points.empty()) return glm::dvec3(0.0);
  Vector mean = Vector::Zero();
  for (const glm::dvec3& x : points) mean += From(x) / static_cast<double>(points.size());
  Matrix product = Matrix::Zero();
  for (const glm::dvec3& x : points)
    product += (From(x) - mean) * (From(x) - mean).transpose() / static_cast<double>(points.size());
  const Vector values = Eigen::SelfAdjointEigenSolver<Matrix>(product).eigenvalues();
  const auto root = [](double value) { return std::sqrt(std::max(value, 0.0)); };
  return {root(values[2]), root(values[1]), root(values[0])};
}

bool IsOnLine(std::span<const glm::dvec3> points) {
  const glm::dvec3 spread = SpreadOf(points);
  return !(spread.y > kCollinear * spread.x);
}

LandmarkAlignment AlignLandmarks(std::span<const LandmarkPair> pairs, const Pose& present,
                                 const SurfaceMesh& model, const LandmarkOptions& options) {
  LandmarkAlignment alignment;
  alignment.portal_from_tissue = present;
  alignment.residuals.resize(pairs.size());
  Box3 box = kEmptyBox;
  for (const glm::dvec3& x : model.vertices) box = Union(box, {x, x});
  if (box.empty()) box = {};
  const Vector middle = From(0.5 * (box.low + box.high));
  const double model_size = glm::length(box.high - box.low);
  const bool solves_scale = options.scale == AlignScale::kSolve;

  std::vector<Term> terms;
  std::vector<glm::dvec3> used;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (pairs[i].is_left_out) continue;
    terms.push_back({i, From(pairs[i].x_in_tissue), From(pairs[i].scene.x_in_portal),
                     WhiteningOf(pairs[i].scene, options.model_sigma * present.scale)});
    used.push_back(pairs[i].x_in_tissue);
  }
  const auto end = [&](AlignVerdict verdict) {
    alignment.verdict = verdict;
    DescribeAlignment(pairs, model_size, solves_scale ? std::nullopt : std::optional(present.scale),
                      alignment);
    return alignment;
  };
  if (terms.size() < 3) return end(AlignVerdict::kTooFew);
  if (IsOnLine(used)) return end(AlignVerdict::kCollinear);
  auto best = BestFit(terms, present.scale, solves_scale, middle, alignment);
  if (!best) return end(AlignVerdict::kCollinear);

  // Pairs that are off by more than their errors explain are left out, the worst first; each
  // removal is followed by another fit, since a wrong pair moves the pose away from good ones.
  const std::size_t all = terms.size();
  while (true) {
    const auto worst =
        std::max_element(terms.begin(), terms.end(), [&](const Term& a, const Term& b) {
          return SquaredSigmas(a, best->pose, middle) < SquaredSigmas(b, best->pose, middle);
        });
    if (!(SquaredSigmas(*worst, best->pose, middle) > options.outlier * options.outlier)) break;
    alignment.residuals[worst->pair].is_wrong = true;
    terms.erase(worst);
    if (terms.size() < 3 || 2 * terms.size() <= all) return end(AlignVerdict::kInconsistent);
    best = BestFit(terms, present.scale, solves_scale, middle, alignment);
    if (!best) return end(AlignVerdict::kInconsistent);
  }

  alignment.portal_from_tissue = PoseOf(best->pose, middle);
  PredictErrors(terms, best->pose, solves_scale, middle, alignment);
  for (const Term& term : terms) alignment.residuals[term.pair].is_used = true;
  double sum = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    LandmarkResidual& residual = alignment.residuals[i];
    const glm::dvec3 x = alignment.portal_from_tissue * pairs[i].x_in_tissue;
    const Term term{i, From(pairs[i].x_in_tissue), From(pairs[i].scene.x_in_portal),
                    WhiteningOf(pairs[i].scene, options.model_sigma * present.scale)};
    residual.distance = glm::distance(x, pairs[i].scene.x_in_portal);
    residual.px = ResidualPx(pairs[i].scene, x);
    residual.sigmas = std::sqrt(SquaredSigmas(term, best->pose, middle));
    if (residual.is_used) sum += residual.distance * residual.distance;
  }
  alignment.rms = std::sqrt(sum / static_cast<double>(terms.size()));
  return end(AlignVerdict::kAligned);
}

}  // namespace arthro::authoring
