#include "authoring/panorama/graph/links/loop_candidates.h"

#include <algorithm>
#include <cmath>

#include "authoring/panorama/graph/links/pair_graph.h"

namespace arthro::authoring {
namespace {

struct Candidate {
  int a, b;
  double score;
  cv::Matx33d b_from_a;
};

constexpr double kMostVariance = 400;  // px^2: above it all loops are equally useful
constexpr double kUsualGrowth =
    3.0;  // growth of a pair's error with the share that the frames do not have in common
constexpr double kUsualError = 0.1;  // px, for frames with full overlap

// Growth of a pair's error with the unshared area, error = e0 exp(k (1 - overlap)), estimated from
// the pairs so far. The median of k over pairs is robust against false ones.
class ErrorGuess {
 public:
  explicit ErrorGuess(const std::vector<PairEstimate>& pairs) {
    std::vector<double> growth;
    for (const PairEstimate& pair : pairs) {
      const double apart = 1 - pair.overlap, deviation = PairDeviation(pair, kUsualError);
      if (apart > 0.05 && std::isfinite(deviation))
        growth.push_back(std::log(deviation / kUsualError) / apart);
    }
    if (growth.empty()) return;
    const auto middle = growth.begin() + static_cast<std::ptrdiff_t>(growth.size() / 2);
    std::nth_element(growth.begin(), middle, growth.end());
    growth_ = std::clamp(*middle, 1.0, 8.0);
  }
  double Variance(double overlap) const {
    const double error = kUsualError * std::exp(growth_ * (1 - overlap));
    return error * error;
  }

 private:
  double growth_ = kUsualGrowth;
};

cv::Point2d CentreOf(const cv::Matx33d& place, const cv::Point2d& centre) {
  const cv::Vec3d q = place * cv::Vec3d(centre.x, centre.y, 1);
  return {q[0] / q[2], q[1] / q[2]};
}

}  // namespace

std::vector<PairRequest> LoopCandidates(const std::vector<cv::Matx33d>& plane_from_frame,
                                        const std::vector<int>& piece, const PairBook& book,
                                        const FrameWindow& window, const LoopLimits& limits) {
  const int frames = static_cast<int>(plane_from_frame.size());
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  const VarianceMap map(frames, book.pairs());
  const ErrorGuess guess(book.pairs());

  // Distance of a window's rim from its centre in the plane: windows further apart do not overlap.
  std::vector<cv::Point2d> centre(at(frames));
  std::vector<double> reach(at(frames), 0);
  std::vector<cv::Matx33d> frame_from_plane(at(frames));
  for (int i = 0; i < frames; ++i) {
    const cv::Matx33d& place = plane_from_frame[at(i)];
    centre[at(i)] = CentreOf(place, window.centre);
    frame_from_plane[at(i)] = place.inv();
    for (int k = 0; k < 8; ++k) {
      const cv::Point2d rim =
          window.centre +
          cv::Point2d(std::cos(k * CV_PI / 4), std::sin(k * CV_PI / 4)) * window.radius;
      reach[at(i)] = std::max(reach[at(i)], cv::norm(CentreOf(place, rim) - centre[at(i)]));
    }
  }

  std::vector<Candidate> candidates;
  for (int a = 0; a < frames; ++a) {
    if (piece[at(a)] < 0) continue;
    std::vector<double> variance;  // computed when first needed
    for (int b = a + 1; b < frames; ++b) {
      if (piece[at(b)] != piece[at(a)] || book.WasTried(a, b)) continue;
      if (!(cv::norm(centre[at(a)] - centre[at(b)]) < reach[at(a)] + reach[at(b)])) continue;
      const cv::Matx33d b_from_a = frame_from_plane[at(b)] * plane_from_frame[at(a)];
      const double overlap = OverlapOf(window, b_from_a);
      if (overlap < limits.smallest_overlap) continue;
      if (variance.empty()) variance = map.From(a);
      const double gain = std::min(variance[at(b)], kMostVariance) / guess.Variance(overlap);
      if (gain < limits.least_gain) continue;
      candidates.push_back({a, b, gain, b_from_a * (1 / b_from_a(2, 2))});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& x, const Candidate& y) { return x.score > y.score; });

  // Takes the best first, without redundant ones: (a, b) excludes its neighbours from this round.
  std::vector<PairRequest> requests;
  std::vector<int> of_frame(at(frames), 0);
  for (const Candidate& c : candidates) {
    if (static_cast<int>(requests.size()) >= limits.most_pairs) break;
    if (of_frame[at(c.a)] >= limits.most_per_frame || of_frame[at(c.b)] >= limits.most_per_frame)
      continue;
    const bool is_beside =
        std::any_of(requests.begin(), requests.end(), [&](const PairRequest& other) {
          return c.b - c.a > 2 && std::abs(other.a - c.a) + std::abs(other.b - c.b) <= 1;
        });
    if (is_beside) continue;
    requests.push_back({c.a, c.b, PairEffort::kPredicted, c.b_from_a});
    ++of_frame[at(c.a)];
    ++of_frame[at(c.b)];
  }
  return requests;
}

}  // namespace arthro::authoring
