// Fit and check of the pairs of one tied frame (place_ties.h).
#include <algorithm>
#include <cmath>
#include <complex>

#include <fmt/format.h>

#include "authoring/panorama/pairs/pair_estimate.h"
#include "authoring/panorama/ties/place_ties.h"
#include "simulation/core/error.h"

namespace arthro::authoring {
namespace {

using Complex = std::complex<double>;
using Points = std::vector<cv::Point2d>;

constexpr double kLeastSpread = 0.05;  // share of the window's diameter
constexpr double kMostError = 0.05;    // share of the window's diameter, at its rim
constexpr double kMostZoom = 3;        // a scope that moves in changes the size of tissue less
// Residual of a right pair: the error of two clicks, three deviations of it, and what a similarity
// misses of the perspective between two frames, as a share of the spread of the points.
constexpr double kDeviations = 3, kPerspective = 0.03;

Complex Number(const cv::Point2d& p) { return {p.x, p.y}; }

// Least squares over the pairs that are not left out: b = factor a + shift in the complex plane.
TieFit Fit(const Points& a, const Points& b, const std::vector<bool>& left_out = {}) {
  TieFit fit;
  Complex middle_a = 0, middle_b = 0;
  const auto is_used = [&](std::size_t i) { return left_out.empty() || !left_out[i]; };
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!is_used(i)) continue;
    ++fit.pairs;
    middle_a += Number(a[i]);
    middle_b += Number(b[i]);
  }
  middle_a /= fit.pairs;
  middle_b /= fit.pairs;
  Complex product = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!is_used(i)) continue;
    const Complex from_middle = Number(a[i]) - middle_a;
    product += std::conj(from_middle) * (Number(b[i]) - middle_b);
    fit.square_sum += std::norm(from_middle);
  }
  const Complex factor = fit.square_sum > 0 ? product / fit.square_sum : Complex(0);
  const Complex shift = middle_b - factor * middle_a;
  fit.b_from_a = {factor.real(),
                  -factor.imag(),
                  shift.real(),
                  factor.imag(),
                  factor.real(),
                  shift.imag(),
                  0,
                  0,
                  1};
  fit.scale = std::abs(factor);
  fit.middle = {middle_a.real(), middle_a.imag()};
  double square = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (is_used(i)) square += std::norm(factor * Number(a[i]) + shift - Number(b[i]));
  fit.rms_px = std::sqrt(square / fit.pairs);
  return fit;
}

double Spread(const Points& points) {
  double most = 0;
  for (const cv::Point2d& p : points)
    for (const cv::Point2d& q : points) most = std::max(most, cv::norm(p - q));
  return most;
}

double MostRms(const Points& b) {
  return kDeviations * std::sqrt(2.0) * kClickDeviation + kPerspective * Spread(b);
}

// Names the pair whose omission alone makes the others agree.
std::string WrongPair(const Points& a, const Points& b, const std::vector<std::string>& names) {
  if (a.size() < 4) return "";
  constexpr double kClearly = 2;  // times better than the omission of any other pair
  std::size_t wrong = 0;
  TieFit best;
  double least = INFINITY, second = INFINITY;
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::vector<bool> left_out(a.size(), false);
    left_out[i] = true;
    const TieFit fit = Fit(a, b, left_out);
    second = std::min(second, std::max(least, fit.rms_px));
    if (fit.rms_px >= least) continue;
    wrong = i;
    best = fit;
    least = fit.rms_px;
  }
  if (least > MostRms(b) || second < kClearly * std::max(least, kClickDeviation)) return "";
  return fmt::format("{} misses the place that the other pairs give by {:.0f} px", names[wrong],
                     cv::norm(Apply(best.b_from_a, a[wrong]) - b[wrong]));
}

}  // namespace

double TieError(const TieFit& fit, const cv::Point2d& point_in_a) {
  const cv::Point2d off = point_in_a - fit.middle;
  const double variance = 2 * kClickDeviation * kClickDeviation * (1 + fit.scale * fit.scale);
  return std::sqrt(variance * (1.0 / fit.pairs + off.dot(off) / fit.square_sum));
}

TieFit FitTies(const Points& a, const Points& b, const std::vector<std::string>& names,
               double window_px) {
  const auto refuse = [](const std::string& sentence) { throw Error(Code::kBadData, sentence); };
  if (a.size() < 2) refuse("it has one pair of points; a place needs two or more");
  for (const Points* points : {&a, &b})
    if (Spread(*points) < kLeastSpread * window_px)
      refuse(
          fmt::format("its pairs lie within {:.0f} px of one another; choose points that are "
                      "further apart",
                      Spread(*points)));
  const TieFit fit = Fit(a, b);
  if (fit.rms_px > MostRms(b)) {
    const std::string wrong = WrongPair(a, b, names);
    if (!wrong.empty()) refuse(wrong + "; mend or remove it");
    refuse(
        fmt::format("its {} pairs contradict one another by {:.0f} px, and none of them alone "
                    "can be told to be wrong; click them anew, or add a pair",
                    a.size(), fit.rms_px));
  }
  if (fit.scale > kMostZoom || fit.scale * kMostZoom < 1)
    refuse(
        fmt::format("its pairs show the tissue at {:.2g} times the size, which no two frames of "
                    "a clip do; one of them is wrong",
                    fit.scale));
  const cv::Point2d rim = fit.middle + cv::Point2d(window_px / 2, 0);
  if (const double error = TieError(fit, rim); error > kMostError * window_px)
    refuse(
        fmt::format("its pairs would give the place to {:.0f} px only; choose points that are "
                    "further apart, or add pairs",
                    error));
  return fit;
}

}  // namespace arthro::authoring
