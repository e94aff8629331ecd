#include "authoring/panorama/pairs/verify_pair.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "authoring/panorama/pairs/direct_solver.h"

namespace arthro::authoring {
namespace {

// Error that the statistics of one pair do not contain: the lens's error, relief, light that moves
// with the scope. Per coordinate of a control point, px.
constexpr double kModelError = 0.05;
// Certainty of a part that hardly any wrong pair reaches, whatever the certainty of the whole.
constexpr double kPlainPart = 1.6;
constexpr double kSureCertainty = 22, kSureSimilarity = 0.5;
// Bound on the factor of area between nearby views of one scope.
constexpr double kMostAreaRatio = 4.0;

Mat8 Symmetric(const Mat8& m) { return (m + m.t()) * 0.5; }

// Inverse covariance of the parameters: the response of the score, A, and the scatter B of the
// cells' scores give cov = A^-1 B A^-1.
bool ParameterInformation(const Evidence& e, Mat8& information) {
  const Mat8 A = e.normal * e.response;
  Mat8 B = e.scatter;
  const double floor = 1e-6 * cv::trace(B);
  for (int i = 0; i < 8; ++i) B(i, i) += floor;
  Mat8 inverse;
  if (cv::invert(B, inverse, cv::DECOMP_CHOLESKY) == 0) return false;
  information = Symmetric(A * inverse * A);
  return true;
}

// Growth of the variances when the two frames are less similar than their noise explains: moving
// light, blur, haze. Fitted to d' Λ d of true pairs of the synthetic sequences: it rises as exp(3.4
// - 4.4 similarity), from about 0.8 at 0.8 to 5 at 0.4. The factor before it covers the spread
// about that.
double Unlikeness(double similarity) {
  return std::max(0.7, 1.8 * std::exp(3.35 - 4.36 * similarity));
}

// Matrix M of d = M p: displacement of the control points' images by the parameters.
Mat8 ControlFromParameters(const cv::Matx33d& h, const Patch& patch, const FourPoints& control) {
  Mat8 M = Mat8::zeros();
  for (int i = 0; i < 4; ++i) {
    const cv::Point2d& c = control[i];
    const double w = h(2, 0) * c.x + h(2, 1) * c.y + h(2, 2);
    const cv::Point2d b = Apply(h, c);
    const double u = (c.x - patch.centre.x) / patch.reach_x,
                 v = (c.y - patch.centre.y) / patch.reach_y;
    const double du[8] = {1, u, v, 0, 0, 0, u * u, u * v};
    const double dv[8] = {0, 0, 0, 1, u, v, u * v, v * v};
    for (int j = 0; j < 8; ++j) {
      const double x = -du[j] * patch.reach_x, y = -dv[j] * patch.reach_y;
      M(2 * i, j) = ((h(0, 0) - b.x * h(2, 0)) * x + (h(0, 1) - b.x * h(2, 1)) * y) / w;
      M(2 * i + 1, j) = ((h(1, 0) - b.y * h(2, 0)) * x + (h(1, 1) - b.y * h(2, 1)) * y) / w;
    }
  }
  return M;
}

FourPoints ControlOf(const Patch& patch) {
  FourPoints control;
  for (int i = 0; i < 4; ++i)
    control[i] = {patch.centre.x + (i == 0 || i == 3 ? -1 : 1) * patch.reach_x,
                  patch.centre.y + (i < 2 ? -1 : 1) * patch.reach_y};
  return control;
}

// Convex, not mirrored, and of similar size, as for a scope that moved a little.
bool IsPlausible(const cv::Matx33d& h, const Patch& patch, const FourPoints& control) {
  FourPoints image;
  for (int i = 0; i < 4; ++i) {
    if (!(h(2, 0) * control[i].x + h(2, 1) * control[i].y + h(2, 2) > 0.2 * std::abs(h(2, 2))))
      return false;
    image[i] = Apply(h, control[i]);
  }
  double area = 0;
  for (int i = 0; i < 4; ++i) {
    const cv::Point2d p = image[(i + 1) % 4] - image[i],
                      q = image[(i + 2) % 4] - image[(i + 1) % 4];
    const double cross = p.x * q.y - p.y * q.x;
    if (!(cross > 0)) return false;
    area += 0.5 * (image[i].x * image[(i + 1) % 4].y - image[i].y * image[(i + 1) % 4].x);
  }
  const double ratio = area / (4 * patch.reach_x * patch.reach_y);
  return ratio > 1 / kMostAreaRatio && ratio < kMostAreaRatio;
}

}  // namespace

PairVerdict VerifyPair(const DirectPyramid& a, const DirectPyramid& b, const DirectOptions& options,
                       PairEstimate& pair) {
  PairVerdict verdict;
  const auto refuse = [&](std::string why) {
    verdict.why_not = std::move(why);
    return verdict;
  };
  if (!a.HasTexture() || !b.HasTexture()) return refuse("no texture to compare");
  const Evidence middle = DirectSolver(a.level(1), b.level(1)).Weigh(pair.b_from_a, false);
  const Evidence fine = DirectSolver(a.level(0), b.level(0)).Weigh(pair.b_from_a, true);
  verdict.weakest_part = middle.weakest_part;
  pair.overlap = verdict.overlap = middle.overlap;
  pair.similarity = verdict.similarity = middle.similarity;
  verdict.certainty = middle.certainty;
  if (verdict.overlap < options.smallest_overlap)
    return refuse(fmt::format("only {:.0f} % of the frame is shared", 100 * verdict.overlap));
  if (verdict.certainty < options.least_certainty)
    return refuse(fmt::format("the frames are not similar (certainty {:.1f}, {:.1f} required)",
                              verdict.certainty, options.least_certainty));
  // Each of nine equal parts has a third of the whole's certainty; a much lower one shows another
  // place. Pairs far above any wrong one observed (19 and 0.57) may have a part under debris.
  const bool is_sure = verdict.certainty > kSureCertainty && verdict.similarity > kSureSimilarity;
  const double asked =
      std::max(options.least_part_certainty,
               std::min(kPlainPart, options.least_part_share * verdict.certainty / 3));
  if (!is_sure && verdict.weakest_part < asked)
    return refuse(fmt::format("only part of the overlap is similar (certainty {:.1f})",
                              verdict.weakest_part));
  const FourPoints control = ControlOf(middle.patch);
  if (!IsPlausible(pair.b_from_a, middle.patch, control))
    return refuse("the frames would have to be folded or stretched");

  Mat8 information;
  const Evidence& best = fine;
  if (!ParameterInformation(best, information))
    return refuse("the shared texture does not fix the position");
  const FourPoints corners = ControlOf(best.patch);
  const Mat8 inverse_m = ControlFromParameters(pair.b_from_a, best.patch, corners).inv();
  information = Symmetric(inverse_m.t() * information * inverse_m);
  information *= 1 / Unlikeness(middle.similarity);
  // Adds the model's error to the statistical covariance.
  const Mat8 sum = Mat8::eye() + information * (kModelError * kModelError);
  information = Symmetric(information * sum.inv());
  const Mat8 covariance = information.inv(cv::DECOMP_SVD);
  for (int i = 0; i < 4; ++i)
    verdict.corner_sigma = std::max(
        verdict.corner_sigma,
        std::sqrt(std::max(0.0, covariance(2 * i, 2 * i) + covariance(2 * i + 1, 2 * i + 1))));
  if (!(verdict.corner_sigma < options.most_corner_sigma))
    return refuse(fmt::format("the shared texture fixes the position to {:.1f} px only",
                              verdict.corner_sigma));
  if (pair.source == PairSource::kDirect) {
    pair.control_in_a = corners;
    pair.information = information;
    pair.inliers = best.cells;
  }
  verdict.is_accepted = true;
  return verdict;
}

}  // namespace arthro::authoring
