#include "tests/support/depth_score.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "authoring/phantom/shape/noise.h"

namespace arthro::test {
namespace {

std::vector<double> Ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t i = 0; i < order.size();) {
    std::size_t j = i;
    while (j < order.size() && values[order[j]] == values[order[i]]) ++j;
    for (std::size_t k = i; k < j; ++k) ranks[order[k]] = 0.5 * static_cast<double>(i + j - 1);
    i = j;
  }
  return ranks;
}

// The estimate in the truth's unit.
std::vector<double> Fitted(const std::vector<double>& estimate, const std::vector<double>& truth,
                           bool fit_origin) {
  std::vector<double> ratios;
  double n = 0, e = 0, t = 0, ee = 0, et = 0;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    if (std::isnan(estimate[i]) || std::isnan(truth[i])) continue;
    ratios.push_back(truth[i] / estimate[i]);
    n += 1;
    e += estimate[i];
    t += truth[i];
    ee += estimate[i] * estimate[i];
    et += estimate[i] * truth[i];
  }
  double scale = 1, origin = 0;
  if (fit_origin) {
    scale = (n * et - e * t) / std::max(n * ee - e * e, 1e-30);
    origin = (t - scale * e) / n;
  } else if (!ratios.empty()) {
    const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
    std::nth_element(ratios.begin(), middle, ratios.end());
    scale = *middle;
  }
  std::vector<double> fitted(estimate);
  for (double& d : fitted) d = std::isnan(d) ? d : std::max(0.05, scale * d + origin);
  return fitted;
}

constexpr double kNominalMm = 20;  // one unit of a scene's distances
constexpr int kApproaches = 1000;

// How far along the line the surface is met; NaN where the line leaves the picture first.
double ContactAlong(const DepthScene& scene, const std::vector<double>& distance,
                    const glm::dvec3& from, const glm::dvec3& along) {
  constexpr double kStep = 0.01;
  for (double s = 0; s < 4; s += kStep) {
    const glm::dvec3 x = from + s * along;
    const auto pixel = scene.PixelOf(x);
    if (!pixel) continue;
    const double surface = distance[*pixel];
    if (std::isnan(surface)) continue;
    if (glm::length(x) >= surface) return s;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::string DepthScore::Text() const {
  return fmt::format(
      "AbsRel {:.3f}  RMSElog {:.3f}  d<1.25 {:.3f}  Spearman {:.3f}  contact {:.2f} mm", abs_rel,
      rmse_log, within_125, spearman, contact_mm);
}

double RankCorrelation(const std::vector<double>& a, const std::vector<double>& b) {
  const auto ra = Ranks(a), rb = Ranks(b);
  const double mean = 0.5 * static_cast<double>(a.size() - 1);
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (ra[i] - mean) * (rb[i] - mean);
    aa += (ra[i] - mean) * (ra[i] - mean);
    bb += (rb[i] - mean) * (rb[i] - mean);
  }
  return ab / std::sqrt(aa * bb);
}

std::vector<double> DistancesOf(const DepthMap& relief, const authoring::DepthOptions& options,
                                const authoring::DepthReport& report) {
  const double range = options.near_relief - options.far_relief;
  std::vector<double> distance;
  for (const float h : relief.relief) {
    const double nearness = (h - options.far_relief) / range;
    distance.push_back(report.distance_ratio > 0
                           ? report.distance_ratio - nearness * (report.distance_ratio - 1)
                           : 1 - nearness);
  }
  return distance;
}

DepthScore ScoreDepth(const std::vector<double>& estimate, const std::vector<double>& truth,
                      bool fit_origin) {
  const std::vector<double> fitted = Fitted(estimate, truth, fit_origin);
  DepthScore score;
  std::vector<double> found, known;
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    if (std::isnan(fitted[i]) || std::isnan(truth[i])) continue;
    found.push_back(estimate[i]);
    known.push_back(truth[i]);
    const double ratio = fitted[i] / truth[i];
    score.abs_rel += std::abs(ratio - 1);
    score.rmse_log += std::log(ratio) * std::log(ratio);
    score.within_125 += std::max(ratio, 1 / ratio) < 1.25 ? 1 : 0;
  }
  const double n = std::max<double>(1, static_cast<double>(found.size()));
  score.abs_rel /= n;
  score.rmse_log = std::sqrt(score.rmse_log / n);
  score.within_125 /= n;
  score.spearman = RankCorrelation(found, known);
  return score;
}

DepthScore ScoreScene(const std::vector<double>& estimate, const DepthScene& scene,
                      bool fit_origin) {
  DepthScore score = ScoreDepth(estimate, scene.distance, fit_origin);
  const std::vector<double> fitted = Fitted(estimate, scene.distance, fit_origin);
  const glm::dvec3 portal(0.6, 0.1, 0);  // beside the scope
  Random random(71);
  int met = 0;
  for (int i = 0; i < kApproaches; ++i) {
    const double x = random.Uniform(0.2, 0.8) * scene.picture.width,
                 y = random.Uniform(0.2, 0.8) * scene.picture.height;
    const auto pixel =
        static_cast<std::size_t>(y) * scene.picture.width + static_cast<std::size_t>(x);
    if (std::isnan(scene.distance[pixel])) continue;
    const glm::dvec3 target =
        scene.RayOf(static_cast<int>(x), static_cast<int>(y)) * scene.distance[pixel];
    const glm::dvec3 along = glm::normalize(target - portal);
    const double truth = ContactAlong(scene, scene.distance, portal, along),
                 found = ContactAlong(scene, fitted, portal, along);
    if (std::isnan(truth) || std::isnan(found)) continue;
    score.contact_mm += kNominalMm * std::abs(found - truth);
    ++met;
  }
  score.contact_mm /= std::max(1, met);
  return score;
}

}  // namespace arthro::test
