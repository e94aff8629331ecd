#include "authoring/panorama/pairs/robust_homography.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>

#include <fmt/format.h>

#include "authoring/panorama/pairs/pair_estimate.h"
#include "simulation/core/random.h"

namespace arthro::authoring {
namespace {

using Points = std::vector<cv::Point2d>;

// Tolerances, in thresholds, for the perspective that a similarity and an affine map cannot
// represent.
constexpr double kSimilaritySlack = 6, kAffineSlack = 3;
constexpr int kWidened = 6;  // number of similarities that are extended
constexpr double kNearest =
    0.15;  // distance of two sampled points, in mean distances from the middle
constexpr double kMostScale = 2.5;  // scale between frames
constexpr double kLeastSpread =
    0.06;                        // spread of the inliers across their line, in shares of the reach
constexpr double kMostArea = 6;  // factor of area between frames
constexpr double kConfidence = 0.999;  // probability that a sample without outliers was drawn

// Normalises the points to mean 0 and mean distance 1.
cv::Matx33d Normalisation(const Points& points) {
  cv::Point2d middle;
  for (const auto& p : points) middle += p;
  middle *= 1.0 / static_cast<double>(points.size());
  double distance = 0;
  for (const auto& p : points) distance += cv::norm(p - middle);
  distance /= static_cast<double>(points.size());
  const double s = distance > 0 ? 1 / distance : 1;
  return {s, 0, -s * middle.x, 0, s, -s * middle.y, 0, 0, 1};
}

Points Mapped(const cv::Matx33d& h, const Points& points) {
  Points out;
  out.reserve(points.size());
  for (const auto& p : points) out.push_back(Apply(h, p));
  return out;
}

double SquaredError(const cv::Matx33d& h, const cv::Point2d& a, const cv::Point2d& b) {
  const double w = h(2, 0) * a.x + h(2, 1) * a.y + h(2, 2);
  if (!(w > 0.1)) return std::numeric_limits<double>::infinity();  // folded over, or nearly so
  const double x = (h(0, 0) * a.x + h(0, 1) * a.y + h(0, 2)) / w - b.x;
  const double y = (h(1, 0) * a.x + h(1, 1) * a.y + h(1, 2)) / w - b.y;
  return x * x + y * y;
}

std::vector<int> Within(const cv::Matx33d& h, const Points& a, const Points& b, double limit) {
  std::vector<int> close;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (SquaredError(h, a[i], b[i]) < limit * limit) close.push_back(static_cast<int>(i));
  return close;
}

// Sum of squared errors in units of `limit`, each at most 1: smaller is better.
double TruncatedCost(const cv::Matx33d& h, const Points& a, const Points& b, double limit) {
  double cost = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    cost += std::min(1.0, SquaredError(h, a[i], b[i]) / (limit * limit));
  return cost;
}

bool FitTo(PlaneMap kind, const Points& a, const Points& b, const std::vector<int>& which,
           cv::Matx33d& h) {
  Points pa, pb;
  for (const int i : which) {
    pa.push_back(a[static_cast<std::size_t>(i)]);
    pb.push_back(b[static_cast<std::size_t>(i)]);
  }
  return FitPlaneMap(kind, pa, pb, h);
}

struct Hypothesis {
  cv::Matx33d h;
  double cost = 0;
};

std::vector<Hypothesis> SampleSimilarities(const Points& a, const Points& b, double limit,
                                           const FeatureOptions& options) {
  std::vector<Hypothesis> best;
  Random draw(static_cast<std::uint64_t>(options.seed));
  double trials = options.max_trials;
  for (int trial = 0; trial < trials; ++trial) {
    const std::size_t i = draw.Below(a.size()), j = draw.Below(a.size());
    const std::complex<double> da(a[j].x - a[i].x, a[j].y - a[i].y);
    const std::complex<double> db(b[j].x - b[i].x, b[j].y - b[i].y);
    if (std::abs(da) < kNearest || std::abs(db) < kNearest) continue;
    const std::complex<double> turn = db / da;
    if (std::abs(turn) > kMostScale || std::abs(turn) < 1 / kMostScale) continue;
    const double c = turn.real(), s = turn.imag();
    const cv::Matx33d h(c, -s, b[i].x - c * a[i].x + s * a[i].y, s, c,
                        b[i].y - s * a[i].x - c * a[i].y, 0, 0, 1);
    const double cost = TruncatedCost(h, a, b, limit);
    if (best.size() == kWidened && cost >= best.back().cost) continue;
    const auto at = std::find_if(best.begin(), best.end(),
                                 [&](const Hypothesis& other) { return cost < other.cost; });
    const bool is_best = at == best.begin();
    best.insert(at, {h, cost});
    if (best.size() > kWidened) best.pop_back();
    if (is_best) {  // more agreement needs fewer samples
      const double share = 1 - cost / static_cast<double>(a.size());
      const double miss = std::log(std::max(1e-12, 1 - share * share));
      trials = std::min<double>(options.max_trials, std::log(1 - kConfidence) / miss + 20);
    }
  }
  return best;
}

// Extends to an affine, then a perspective map, each fitted to the inliers of the one before.
cv::Matx33d Widen(const cv::Matx33d& similarity, const Points& a, const Points& b, double limit) {
  cv::Matx33d h = similarity, next;
  constexpr struct {
    PlaneMap kind;
    double slack;
  } kSteps[] = {{PlaneMap::kSimilarity, kSimilaritySlack},
                {PlaneMap::kAffine, kSimilaritySlack},
                {PlaneMap::kAffine, kAffineSlack},
                {PlaneMap::kHomography, kAffineSlack},
                {PlaneMap::kHomography, 1.5},
                {PlaneMap::kHomography, 1.0}};
  for (const auto& [kind, slack] : kSteps) {
    const auto close = Within(h, a, b, slack * limit);
    if (close.size() < 6) break;
    if (!FitTo(kind, a, b, close, next)) break;
    h = next;
  }
  return h;
}

// Number of parameters that the matches justify: cost in units of the noise, plus log n per
// parameter.
PlaneMap KindThatPays(const Points& a, const Points& b, const std::vector<int>& inliers,
                      double limit, cv::Matx33d& h) {
  constexpr struct {
    PlaneMap kind;
    int parameters;
  } kKinds[] = {{PlaneMap::kHomography, 8}, {PlaneMap::kAffine, 6}, {PlaneMap::kSimilarity, 4}};
  const double n = static_cast<double>(inliers.size());
  PlaneMap best_kind = PlaneMap::kHomography;
  double best = std::numeric_limits<double>::infinity(), variance = 0;
  for (const auto& [kind, parameters] : kKinds) {
    cv::Matx33d fitted;
    if (!FitTo(kind, a, b, inliers, fitted)) continue;
    double cost = 0;
    for (const int i : inliers)
      cost += std::min(limit * limit, SquaredError(fitted, a[static_cast<std::size_t>(i)],
                                                   b[static_cast<std::size_t>(i)]));
    if (variance == 0) variance = std::max(cost / (2 * n), 1e-6 * limit * limit);
    const double price = cost / variance + parameters * std::log(n);
    if (price >= best) continue;
    best = price;
    best_kind = kind;
    h = fitted;
  }
  return best_kind;
}

// Returns a reason when the inliers do not determine a map of the plane, or when no camera makes
// that map; otherwise empty.
std::string Degeneracy(const Points& a, const std::vector<int>& inliers, const cv::Matx33d& h,
                       double reach) {
  cv::Point2d middle;
  for (const int i : inliers) middle += a[static_cast<std::size_t>(i)];
  middle *= 1.0 / static_cast<double>(inliers.size());
  double xx = 0, xy = 0, yy = 0;
  for (const int i : inliers) {
    const cv::Point2d d = a[static_cast<std::size_t>(i)] - middle;
    xx += d.x * d.x;
    xy += d.x * d.y;
    yy += d.y * d.y;
    // Factor of area at that point: positive, and near 1.
    const cv::Point2d& p = a[static_cast<std::size_t>(i)];
    const double w = h(2, 0) * p.x + h(2, 1) * p.y + h(2, 2);
    const double area = cv::determinant(h) / (w * w * w);
    if (!(area > 1 / kMostArea && area < kMostArea))
      return "the matches fold or stretch the frame in a way that no camera does";
  }
  const double n = static_cast<double>(inliers.size());
  const double mean = 0.5 * (xx + yy) / n, half = std::hypot(0.5 * (xx - yy), xy) / n;
  if (std::sqrt(std::max(0.0, mean - half)) < kLeastSpread * reach)
    return "the matches lie along one line";
  return "";
}

}  // namespace

cv::Matx<double, 2, 8> PointByHomography(const cv::Matx33d& h, const cv::Point2d& a) {
  const double w = h(2, 0) * a.x + h(2, 1) * a.y + h(2, 2);
  const double x = (h(0, 0) * a.x + h(0, 1) * a.y + h(0, 2)) / w;
  const double y = (h(1, 0) * a.x + h(1, 1) * a.y + h(1, 2)) / w;
  const double u = a.x / w, v = a.y / w, one = 1 / w;
  return {u, v, one, 0, 0, 0, -x * u, -x * v, 0, 0, 0, u, v, one, -y * u, -y * v};
}

bool FitPlaneMap(PlaneMap kind, const Points& a, const Points& b, cv::Matx33d& h) {
  const std::size_t fewest = kind == PlaneMap::kSimilarity ? 2 : kind == PlaneMap::kAffine ? 3 : 4;
  if (a.size() < fewest || a.size() != b.size()) return false;
  if (kind == PlaneMap::kSimilarity) {
    cv::Point2d ma, mb;
    for (std::size_t i = 0; i < a.size(); ++i) ma += a[i], mb += b[i];
    ma *= 1.0 / static_cast<double>(a.size());
    mb *= 1.0 / static_cast<double>(a.size());
    double c = 0, s = 0, power = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const cv::Point2d p = a[i] - ma, q = b[i] - mb;
      c += p.dot(q);
      s += p.cross(q);
      power += p.dot(p);
    }
    if (!(power > 0)) return false;
    c /= power;
    s /= power;
    h = {c, -s, mb.x - c * ma.x + s * ma.y, s, c, mb.y - s * ma.x - c * ma.y, 0, 0, 1};
    return true;
  }
  // Affine: two independent rows.
  cv::Matx33d normal = cv::Matx33d::zeros();
  cv::Vec3d right_x = cv::Vec3d::all(0), right_y = cv::Vec3d::all(0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const cv::Vec3d p(a[i].x, a[i].y, 1);
    normal += p * p.t();
    right_x += b[i].x * p;
    right_y += b[i].y * p;
  }
  cv::Vec3d row_x, row_y;
  if (!cv::solve(normal, right_x, row_x, cv::DECOMP_CHOLESKY) ||
      !cv::solve(normal, right_y, row_y, cv::DECOMP_CHOLESKY))
    return false;
  h = {row_x[0], row_x[1], row_x[2], row_y[0], row_y[1], row_y[2], 0, 0, 1};
  if (kind == PlaneMap::kAffine) return true;

  constexpr int kSteps = 10;
  for (int step = 0; step < kSteps; ++step) {
    cv::Matx<double, 8, 8> hessian = cv::Matx<double, 8, 8>::zeros();
    cv::Matx<double, 8, 1> gradient = cv::Matx<double, 8, 1>::zeros(), change;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const cv::Matx<double, 2, 8> j = PointByHomography(h, a[i]);
      const cv::Point2d error = b[i] - Apply(h, a[i]);
      hessian += j.t() * j;
      gradient += j.t() * cv::Vec2d(error.x, error.y);
    }
    if (!cv::solve(hessian, gradient, change, cv::DECOMP_CHOLESKY)) return false;
    for (int k = 0; k < 8; ++k) h.val[k] += change(k);
    const double size = cv::norm(change);
    if (!std::isfinite(size)) return false;
    if (size < 1e-11) break;
  }
  return true;
}

RobustHomography FindHomography(const Points& a, const Points& b, double reach,
                                const FeatureOptions& options) {
  RobustHomography result;
  if (a.size() < static_cast<std::size_t>(options.fewest_inliers)) {
    result.why_not = fmt::format("only {} points are similar", a.size());
    return result;
  }
  const cv::Matx33d norm_a = Normalisation(a), norm_b = Normalisation(b);
  const Points na = Mapped(norm_a, a), nb = Mapped(norm_b, b);
  const double limit = options.max_error * norm_b(0, 0);

  cv::Matx33d best = cv::Matx33d::eye();
  double best_cost = std::numeric_limits<double>::infinity();
  for (const Hypothesis& start : SampleSimilarities(na, nb, kSimilaritySlack * limit, options)) {
    const cv::Matx33d h = Widen(start.h, na, nb, limit);
    const double cost = TruncatedCost(h, na, nb, limit);
    if (cost >= best_cost) continue;
    best_cost = cost;
    best = h;
  }
  std::vector<int> inliers = Within(best, na, nb, limit);
  if (inliers.size() < static_cast<std::size_t>(options.fewest_inliers)) {
    result.why_not = fmt::format("only {} of {} matches agree", inliers.size(), a.size());
    return result;
  }
  result.kind = KindThatPays(na, nb, inliers, limit, best);
  inliers = Within(best, na, nb, limit);
  if (inliers.size() < static_cast<std::size_t>(options.fewest_inliers)) {
    result.why_not = fmt::format("only {} of {} matches agree", inliers.size(), a.size());
    return result;
  }
  result.why_not = Degeneracy(na, inliers, best, reach * norm_a(0, 0));
  if (!result.why_not.empty()) return result;
  cv::Matx33d h = norm_b.inv() * best * norm_a;
  h *= 1 / h(2, 2);
  double sum = 0;
  for (const int i : inliers)
    sum += SquaredError(best, na[static_cast<std::size_t>(i)], nb[static_cast<std::size_t>(i)]);
  result.rms = std::sqrt(sum / static_cast<double>(inliers.size())) / norm_b(0, 0);
  result.b_from_a = h;
  result.inliers = std::move(inliers);
  result.is_found = true;
  return result;
}

}  // namespace arthro::authoring
