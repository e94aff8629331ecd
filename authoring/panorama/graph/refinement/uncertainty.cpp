#include "authoring/panorama/graph/refinement/uncertainty.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>

#include "authoring/panorama/graph/refinement/camera_prior.h"
#include "authoring/panorama/graph/refinement/pair_term.h"
#include "authoring/panorama/graph/refinement/selected_inverse.h"

namespace arthro::authoring {
namespace {

// Two degrees of freedom at 1 - 0.05 / 4: eight numbers move the nine points like four free ones.
constexpr double kChi2OfWorst = 8.76;
constexpr double kFixed = 1e9;  // in normalised units: known to 3e-5
constexpr double kNotPlaced = std::numeric_limits<double>::infinity();

struct Linearised {
  Matrix8 by_a, by_b;
  bool is_valid = false;
};

// Derivatives of a frame's points by the frame's own eight numbers and by the plane's.
struct PointRows {
  std::vector<Eigen::Matrix<double, 2, 8>> by_frame, by_plane;
};

PointRows RowsOf(const Eigen::Matrix3d& place, const std::vector<cv::Point2d>& points,
                 const Normalisation& normalisation) {
  PointRows rows;
  for (const cv::Point2d& point : points) {
    const Eigen::Vector3d y = normalisation.Normalise(point), p = place * y;
    rows.by_frame.push_back(ChartDerivative(place, y, p));
    const Eigen::Vector3d q = p / p.z();
    rows.by_plane.push_back(ChartDerivative(Eigen::Matrix3d::Identity(), q, q));
  }
  return rows;
}

}  // namespace

Uncertainty EstimateUncertainty(const std::vector<PairEstimate>& pairs,
                                const std::vector<double>& weights,
                                const std::vector<cv::Matx33d>& plane_from_frame, int fixed_frame,
                                const std::vector<cv::Point2d>& points, double pair_floor_px,
                                const std::optional<Pinhole>& camera, double camera_deviation) {
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  Uncertainty result;
  result.error_px.assign(plane_from_frame.size(), kNotPlaced);
  result.pair_checked.assign(pairs.size(), 0.0);
  const Normalisation normalisation = NormalisationOf(pairs);
  std::vector<Eigen::Matrix3d> places;
  places.reserve(plane_from_frame.size());
  for (const cv::Matx33d& m : plane_from_frame) places.push_back(normalisation.Normalise(m));

  // Rows of the frames with any pair.
  std::vector<Linearised> linear(pairs.size());
  std::vector<int> row_of(places.size(), -1);
  int unknowns = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const PairTerm term(pairs[i], normalisation, pair_floor_px);
    const Eigen::Matrix3d &a = places[at(term.a())], &b = places[at(term.b())];
    Vector8 whitened;
    linear[i].is_valid = weights[i] > 0 && term.Evaluate(a, b, a, b, &whitened, nullptr,
                                                         &linear[i].by_a, &linear[i].by_b);
    if (!linear[i].is_valid) continue;
    linear[i].by_a *= std::sqrt(weights[i]);
    linear[i].by_b *= std::sqrt(weights[i]);
    for (const int frame : {term.a(), term.b()})
      if (row_of[at(frame)] < 0) row_of[at(frame)] = 8 * unknowns++;
  }
  if (unknowns == 0) {
    if (fixed_frame >= 0 && at(fixed_frame) < places.size()) result.error_px[at(fixed_frame)] = 0;
    return result;
  }

  // Normal equations. A small diagonal keeps frames with too few constraints solvable; their error
  // comes out very large, as it should.
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int row, int col, const Matrix8& block) {
    for (int r = 0; r < 8; ++r)
      for (int c = 0; c < 8; ++c) entries.emplace_back(row + r, col + c, block(r, c));
  };
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!linear[i].is_valid) continue;
    const int ra = row_of[at(pairs[i].a)], rb = row_of[at(pairs[i].b)];
    if (ra >= 0) add(ra, ra, linear[i].by_a.transpose() * linear[i].by_a);
    if (rb >= 0) add(rb, rb, linear[i].by_b.transpose() * linear[i].by_b);
    if (ra >= 0 && rb >= 0) {
      const Matrix8 cross = linear[i].by_a.transpose() * linear[i].by_b;
      add(ra, rb, cross);
      add(rb, ra, cross.transpose());
    }
  }
  for (int i = 0; i < 8 * unknowns; ++i) entries.emplace_back(i, i, 1e-4);
  const bool has_prior = camera && camera_deviation > 0;
  if (has_prior) {
    const CameraPrior prior(*camera, normalisation, camera_deviation);
    for (std::size_t i = 0; i < places.size(); ++i) {
      Eigen::Vector2d residual;
      Eigen::Matrix<double, 2, 8> j;
      if (row_of[i] >= 0 && prior.Evaluate(places[i], places[i], &residual, &j))
        add(row_of[i], row_of[i], j.transpose() * j);
    }
  }
  // Constraint on the fixed frame: all of it, or only the numbers that the prior leaves free.
  if (fixed_frame >= 0 && row_of[at(fixed_frame)] >= 0)
    for (const int k : {0, 1, 2, 5, 3, 4, 6, 7}) {
      if (has_prior && (k == 3 || k == 4 || k > 5)) continue;
      const int row = row_of[at(fixed_frame)] + k;
      entries.emplace_back(row, row, kFixed);
    }
  Eigen::SparseMatrix<double> normal(8 * unknowns, 8 * unknowns);
  normal.setFromTriplets(entries.begin(), entries.end());
  const SelectedInverse inverse(normal);
  if (!inverse.is_valid()) return result;

  // Best homography of the plane, g = inv(sum Q^T Q) sum Q^T J_i x_i.
  Matrix8 gauge_normal = Matrix8::Zero();
  Eigen::MatrixXd gauge_rows = Eigen::MatrixXd::Zero(8 * unknowns, 8);
  std::vector<PointRows> rows(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (row_of[i] < 0 && static_cast<int>(i) != fixed_frame) continue;
    rows[i] = RowsOf(places[i], points, normalisation);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const auto& q = rows[i].by_plane[k];
      gauge_normal += q.transpose() * q;
      if (row_of[i] >= 0)
        gauge_rows.middleRows<8>(row_of[i]) += rows[i].by_frame[k].transpose() * q;
    }
  }
  const Matrix8 gauge_inverse =
      (gauge_normal + 1e-12 * gauge_normal.trace() * Matrix8::Identity()).inverse();
  gauge_rows *= gauge_inverse;                                // B^T
  const Eigen::MatrixXd solved = inverse.Solve(gauge_rows);   // inv(N) B^T = cov(x, g)
  const Matrix8 gauge_cov = gauge_rows.transpose() * solved;  // cov(g)

  for (std::size_t i = 0; i < places.size(); ++i) {
    if (rows[i].by_frame.empty()) continue;
    Matrix8 own = Matrix8::Zero(), cross = Matrix8::Zero();
    if (row_of[i] >= 0) {
      own = inverse.Block<8>(row_of[i], row_of[i]);
      cross = solved.middleRows<8>(row_of[i]);
    }
    double worst = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const auto &j = rows[i].by_frame[k], &q = rows[i].by_plane[k];
      const Eigen::Matrix2d mixed = j * cross * q.transpose();
      const Eigen::Matrix2d cov =
          j * own * j.transpose() - mixed - mixed.transpose() + q * gauge_cov * q.transpose();
      const double half = 0.5 * cov.trace();
      const double spread = std::hypot(0.5 * (cov(0, 0) - cov(1, 1)), cov(0, 1));
      worst = std::max(worst, half + spread);
    }
    result.error_px[i] = std::sqrt(std::max(0.0, worst) * kChi2OfWorst) * normalisation.scale;
    if (!std::isfinite(result.error_px[i])) result.error_px[i] = kNotPlaced;
  }

  // Redundancy [Baarda 1968]: 1 - trace(J inv(N) J^T) / 8.
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!linear[i].is_valid) continue;
    const int ra = row_of[at(pairs[i].a)], rb = row_of[at(pairs[i].b)];
    const Matrix8 &ja = linear[i].by_a, &jb = linear[i].by_b;
    double used = 0;
    if (ra >= 0) used += (ja * inverse.Block<8>(ra, ra) * ja.transpose()).trace();
    if (rb >= 0) used += (jb * inverse.Block<8>(rb, rb) * jb.transpose()).trace();
    if (ra >= 0 && rb >= 0) used += 2 * (ja * inverse.Block<8>(ra, rb) * jb.transpose()).trace();
    result.pair_checked[i] = std::clamp(1.0 - used / 8.0, 0.0, 1.0);
  }
  return result;
}

}  // namespace arthro::authoring
