#include "authoring/relief/surface/close_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <Eigen/CholmodSupport>
#include <opencv2/imgproc.hpp>

#include "authoring/relief/median.h"
#include "simulation/scene/relief_origin.h"

namespace arthro::authoring {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

// Difference of the logarithm between neighbours of half a degree, beyond which the surface is
// steeper than about 75° and counts as a step.
constexpr double kStep = 0.035;
constexpr double kLeastTension = 1e-5;  // share of the tension that stays across a step
constexpr int kStepRounds = 3;          // repeats of the search for steps
constexpr int kLag = 16;                // cells, over which the surface's own variation is measured
constexpr double kMostVariation = 0.25;  // change of ln r over that lag; more is a step
constexpr double kLeastVariance = 1e-6;  // neighbours differ by 0.1 % of the radius at least
constexpr int kLeastIsland = 40;         // measured cells that hang together; fewer are a mistake
// Share of the surface's usual slope that the membrane does not foresee.
constexpr double kUnforeseen = 0.5;
// Number of cells that share the error of one match: the window of correlation, halved both ways.
constexpr double kSharedError = 9;
constexpr int kSamples = 32;  // draws from the posterior: its deviation within 13 %

// One unknown per cell, row by row.
class Membrane {
 public:
  Membrane(const OpenSurface& open, const Progress& progress)
      : open_(open), progress_(progress), size_(open.matched.size()) {
    target_.assign(Count(), 0);
    weight_.assign(Count(), 0);
    is_measured_.assign(Count(), false);
    for (int y = 0; y < size_.height; ++y)
      for (int x = 0; x < size_.width; ++x) {
        const float r = open.matched.at<float>(y, x), s = open.sigma.at<float>(y, x);
        if (!(r > 0) || !(s > 0)) continue;
        const double deviation = s / r;
        target_[At(x, y)] = std::log(r);
        weight_[At(x, y)] = 1 / (kSharedError * deviation * deviation);
        is_measured_[At(x, y)] = true;
      }
    DropIslands();
    AddEstimate();
  }

  bool IsEmpty() const {
    return std::none_of(is_measured_.begin(), is_measured_.end(), [](bool m) { return m; });
  }

  ClosedSurface Close() {
    FindTension();
    // Steps are those of matching at first, then those of the closed surface.
    Eigen::VectorXd x = Matched();
    for (int round = 0; round < kStepRounds; ++round) {
      Step(0.2 * round);
      CutSteps(x);
      x = Solve();
    }
    return Closed(x, Deviations());
  }

 private:
  std::size_t Count() const { return static_cast<std::size_t>(size_.area()); }
  std::size_t At(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width) +
           static_cast<std::size_t>(x);
  }

  void Step(double done) const { progress_.Step("closing the surface", done); }

  void AddEstimate() {
    if (open_.estimate.empty()) return;
    is_estimated_.assign(Count(), false);
    for (int y = 0; y < size_.height; ++y)
      for (int x = 0; x < size_.width; ++x) {
        const std::size_t i = At(x, y);
        const float r = open_.estimate.at<float>(y, x), s = open_.estimate_sigma.at<float>(y, x);
        if (is_measured_[i] || !(r > 0) || !(s > 0)) continue;
        const double deviation = s / r;
        target_[i] = std::log(r);
        weight_[i] = 1 / (kSharedError * deviation * deviation);
        is_estimated_[i] = true;
      }
  }

  // Logarithm of the matched radius, smoothed against single wrong cells; gaps take the nearest.
  Eigen::VectorXd Matched() const {
    cv::Mat known = open_.matched > 0, filled = open_.matched.clone(), distance, labels;
    cv::distanceTransform(~known, distance, labels, cv::DIST_L2, 5, cv::DIST_LABEL_PIXEL);
    std::vector<float> by_label(Count() + 1, 0);
    for (int y = 0; y < size_.height; ++y)
      for (int x = 0; x < size_.width; ++x)
        if (known.at<std::uint8_t>(y, x))
          by_label[static_cast<std::size_t>(labels.at<int>(y, x))] = filled.at<float>(y, x);
    for (int y = 0; y < size_.height; ++y)
      for (int x = 0; x < size_.width; ++x)
        filled.at<float>(y, x) = by_label[static_cast<std::size_t>(labels.at<int>(y, x))];
    cv::medianBlur(filled, filled, 5);
    Eigen::VectorXd x(static_cast<Eigen::Index>(Count()));
    for (int row = 0; row < size_.height; ++row)
      for (int column = 0; column < size_.width; ++column)
        x[static_cast<Eigen::Index>(At(column, row))] =
            std::log(std::max(filled.at<float>(row, column), 1e-9f));
    return x;
  }

  // Few measured cells that stand apart from all others by a step are wrong matches.
  void DropIslands() {
    std::vector<int> island(Count(), -1), members;
    for (std::size_t first = 0; first < Count(); ++first) {
      if (!is_measured_[first] || island[first] >= 0) continue;
      members.assign(1, static_cast<int>(first));
      island[first] = static_cast<int>(first);
      for (std::size_t k = 0; k < members.size(); ++k) {
        const int x = members[k] % size_.width, y = members[k] / size_.width;
        for (const auto& [dx, dy] :
             {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
          if (x + dx < 0 || y + dy < 0 || x + dx >= size_.width || y + dy >= size_.height) continue;
          const std::size_t next = At(x + dx, y + dy);
          if (!is_measured_[next] || island[next] >= 0 ||
              std::abs(target_[next] - target_[At(x, y)]) > kStep)
            continue;
          island[next] = static_cast<int>(first);
          members.push_back(static_cast<int>(next));
        }
      }
      if (members.size() >= static_cast<std::size_t>(kLeastIsland)) continue;
      for (const int i : members) {
        is_measured_[static_cast<std::size_t>(i)] = false;
        weight_[static_cast<std::size_t>(i)] = 0;
      }
    }
  }

  // Tension from the mean squared difference of measured cells that lie kLag cells apart: of two
  // neighbours the errors would dominate. For a membrane of tension 1/t² that difference is
  // t²/π (ln kLag + 1.62) [Spitzer 1976].
  void FindTension() {
    double sum = 0;
    int count = 0;
    for (int y = 0; y < size_.height; ++y)
      for (int x = 0; x < size_.width; ++x)
        for (const auto& [dx, dy] : {std::pair(kLag, 0), std::pair(0, kLag)}) {
          if (x + dx >= size_.width || y + dy >= size_.height) continue;
          const std::size_t a = At(x, y), b = At(x + dx, y + dy);
          if (!is_measured_[a] || !is_measured_[b]) continue;
          const double difference = target_[a] - target_[b];
          if (std::abs(difference) > kMostVariation) continue;
          sum += difference * difference;
          ++count;
        }
    constexpr int kEnough = 50;
    constexpr double kUsual = 0.05;  // for a surface with too few measured cells
    const double square = count < kEnough ? kUsual * kUsual : sum / count;
    slope_ = std::sqrt(square) / kLag;
    tension_ = 1 / std::max(square * CV_PI / (std::log(kLag) + 1.62), kLeastVariance);
  }

  void CutSteps(const Eigen::VectorXd& x) {
    right_.assign(Count(), 0);
    down_.assign(Count(), 0);
    const auto tension = [&](std::size_t a, std::size_t b) {
      const double step =
          (x[static_cast<Eigen::Index>(a)] - x[static_cast<Eigen::Index>(b)]) / kStep;
      const double share = 1 / (1 + step * step * step * step);
      return tension_ * std::max(share * share, kLeastTension);
    };
    for (int y = 0; y < size_.height; ++y)
      for (int column = 0; column < size_.width; ++column) {
        const std::size_t i = At(column, y);
        if (column + 1 < size_.width) right_[i] = tension(i, At(column + 1, y));
        if (y + 1 < size_.height) down_[i] = tension(i, At(column, y + 1));
      }
  }

  Eigen::VectorXd Solve() {
    const auto n = static_cast<Eigen::Index>(Count());
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(Count() * 5);
    Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(n), right = Eigen::VectorXd::Zero(n);
    const auto join = [&](std::size_t a, std::size_t b, double w) {
      const auto i = static_cast<int>(a), j = static_cast<int>(b);
      diagonal[i] += w;
      diagonal[j] += w;
      entries.emplace_back(j, i, -w);  // the lower half
    };
    for (int y = 0; y < size_.height; ++y)
      for (int x = 0; x < size_.width; ++x) {
        const std::size_t i = At(x, y);
        if (x + 1 < size_.width) join(i, At(x + 1, y), right_[i]);
        if (y + 1 < size_.height) join(i, At(x, y + 1), down_[i]);
        diagonal[static_cast<Eigen::Index>(i)] += weight_[i];
        right[static_cast<Eigen::Index>(i)] = weight_[i] * target_[i];
      }
    for (Eigen::Index i = 0; i < n; ++i)
      entries.emplace_back(static_cast<int>(i), static_cast<int>(i), diagonal[i]);
    Sparse matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    if (!is_analysed_) factor_.analyzePattern(matrix);
    is_analysed_ = true;
    factor_.factorize(matrix);
    return factor_.solve(right);
  }

  // Posterior standard deviations, from samples: A⁻¹ Jᵀ n has the covariance A⁻¹ for normal n.
  std::vector<double> Deviations() {
    std::vector<double> sum(Count(), 0);
    std::mt19937_64 random(1);
    // Box and Muller's method: std::normal_distribution differs between libraries.
    double kept = 0;
    bool has_kept = false;
    const auto normal = [&] {
      if (has_kept) {
        has_kept = false;
        return kept;
      }
      const double u = (static_cast<double>(random() >> 11) + 0.5) / 9007199254740992.0;
      const double v = static_cast<double>(random() >> 11) / 9007199254740992.0;
      const double length = std::sqrt(-2 * std::log(u)), angle = 6.283185307179586 * v;
      kept = length * std::sin(angle);
      has_kept = true;
      return length * std::cos(angle);
    };
    Eigen::VectorXd right(static_cast<Eigen::Index>(Count()));
    for (int sample = 0; sample < kSamples; ++sample) {
      Step(0.2 * kStepRounds + 0.4 * sample / kSamples);
      right.setZero();
      for (int y = 0; y < size_.height; ++y)
        for (int x = 0; x < size_.width; ++x) {
          const std::size_t i = At(x, y);
          const auto join = [&](std::size_t other, double w) {
            const double pull = std::sqrt(w) * normal();
            right[static_cast<Eigen::Index>(i)] += pull;
            right[static_cast<Eigen::Index>(other)] -= pull;
          };
          if (weight_[i] > 0)
            right[static_cast<Eigen::Index>(i)] += std::sqrt(weight_[i]) * normal();
          if (x + 1 < size_.width) join(At(x + 1, y), right_[i]);
          if (y + 1 < size_.height) join(At(x, y + 1), down_[i]);
        }
      const Eigen::VectorXd drawn = factor_.solve(right);
      for (std::size_t i = 0; i < Count(); ++i) {
        const double value = drawn[static_cast<Eigen::Index>(i)];
        sum[i] += value * value;
      }
    }
    for (double& value : sum) value = std::sqrt(value / kSamples);
    return sum;
  }

  ClosedSurface Closed(const Eigen::VectorXd& x, const std::vector<double>& deviations) const {
    ClosedSurface closed{cv::Mat(size_, CV_32F), cv::Mat(size_, CV_32F), cv::Mat(size_, CV_8U)};
    cv::Mat deviation(size_, CV_32F);
    for (int row = 0; row < size_.height; ++row)
      for (int column = 0; column < size_.width; ++column)
        deviation.at<float>(row, column) = static_cast<float>(deviations[At(column, row)]);
    cv::medianBlur(deviation, deviation, 3);  // a few samples leave noise
    cv::Mat unknown(size_, CV_8U, cv::Scalar(255)), distance;
    for (int row = 0; row < size_.height; ++row)
      for (int column = 0; column < size_.width; ++column)
        if (weight_[At(column, row)] > 0) unknown.at<std::uint8_t>(row, column) = 0;
    cv::distanceTransform(unknown, distance, cv::DIST_L2, 5);
    for (int row = 0; row < size_.height; ++row)
      for (int column = 0; column < size_.width; ++column) {
        const std::size_t i = At(column, row);
        const double radius = std::exp(x[static_cast<Eigen::Index>(i)]);
        closed.radius.at<float>(row, column) = static_cast<float>(radius);
        const ReliefOrigin origin = is_measured_[i] ? ReliefOrigin::kMeasured
                                    : !is_estimated_.empty() && is_estimated_[i]
                                        ? ReliefOrigin::kBrightness
                                        : ReliefOrigin::kInterpolated;
        closed.origin.at<std::uint8_t>(row, column) = static_cast<std::uint8_t>(origin);
        const double away = kUnforeseen * slope_ * distance.at<float>(row, column);
        closed.sigma.at<float>(row, column) =
            is_measured_[i]
                ? open_.sigma.at<float>(row, column)
                : static_cast<float>(radius * std::hypot(deviation.at<float>(row, column), away));
      }
    return closed;
  }

  const OpenSurface& open_;
  const Progress& progress_;
  cv::Size size_;
  std::vector<double> target_, weight_;  // per cell: logarithm of the radius, and its weight
  std::vector<bool> is_measured_, is_estimated_;
  double tension_ = 1, slope_ = 0;    // slope: rms change of ln r per cell
  std::vector<double> right_, down_;  // tension to the next cell
  Eigen::CholmodSimplicialLLT<Sparse, Eigen::Lower> factor_;
  bool is_analysed_ = false;
};

}  // namespace

ClosedSurface CloseSurface(const OpenSurface& open, const Progress& progress) {
  if (open.matched.empty()) return {};
  Membrane membrane(open, progress);
  return membrane.IsEmpty() ? ClosedSurface{} : membrane.Close();
}

}  // namespace arthro::authoring
