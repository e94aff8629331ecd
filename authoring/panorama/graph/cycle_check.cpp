#include "authoring/panorama/graph/cycle_check.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "authoring/panorama/graph/links/pair_graph.h"
#include "simulation/core/at.h"

namespace arthro::authoring {
namespace {

struct Triangle {
  std::array<int, 3> pairs;
  double closure = 0;  // px
  bool closes = false;
};

// The target frame's pixel of `from`, for either direction of the pair's estimate.
cv::Point2d Walk(const PairEstimate& pair, int from, const cv::Point2d& point) {
  return Apply(pair.a == from ? pair.b_from_a : pair.b_from_a.inv(), point);
}

}  // namespace

CycleCheck CheckTriangles(int frames, const std::vector<PairEstimate>& pairs,
                          const CycleOptions& options) {
  CycleCheck check{std::vector<TriangleVote>(pairs.size()), std::vector<bool>(pairs.size(), false),
                   0, 0};
  std::vector<std::vector<std::pair<int, int>>> later(At(frames));  // (later frame, pair)
  std::vector<double> deviation;
  for (int i = 0; i < static_cast<int>(pairs.size()); ++i) {
    const PairEstimate& pair = pairs[At(i)];
    later[At(std::min(pair.a, pair.b))].push_back({std::max(pair.a, pair.b), i});
    deviation.push_back(PairDeviation(pair, 0.05));
  }
  for (auto& list : later) std::sort(list.begin(), list.end());

  std::vector<Triangle> triangles;
  for (int a = 0; a < frames; ++a)
    for (const auto& [b, ab] : later[At(a)])
      for (const auto& [c, bc] : later[At(b)]) {
        const auto ac =
            std::lower_bound(later[At(a)].begin(), later[At(a)].end(), std::pair{c, -1});
        if (ac == later[At(a)].end() || ac->first != c) continue;
        // Compares the way from a over b to c with the direct one from a to c: the control points
        // of ab are in view.
        const PairEstimate& first = pairs[At(ab)];
        Triangle triangle{{ab, bc, ac->second}, 0, false};
        for (const cv::Point2d& control : first.control_in_a) {
          const cv::Point2d start = first.a == a ? control : Walk(first, b, control);
          const cv::Point2d round = Walk(pairs[At(bc)], b, Walk(first, a, start));
          const cv::Point2d straight = Walk(pairs[At(ac->second)], a, start);
          triangle.closure =
              std::max(triangle.closure, std::hypot(round.x - straight.x, round.y - straight.y));
        }
        double variance = 0;
        for (const int pair : triangle.pairs) variance += deviation[At(pair)] * deviation[At(pair)];
        const double most = std::max(
            options.most_closure,
            std::min(options.closure_deviations * std::sqrt(variance), 5 * options.most_closure));
        triangle.closes = triangle.closure <= most;  // false for NaN
        triangles.push_back(triangle);
      }

  // Removes the worst pair with its triangles, until no pair spoils more triangles than it closes.
  std::vector<bool> is_gone(triangles.size(), false);
  while (true) {
    std::fill(check.votes.begin(), check.votes.end(), TriangleVote{});
    for (std::size_t t = 0; t < triangles.size(); ++t)
      if (!is_gone[t])
        for (const int pair : triangles[t].pairs)
          ++(triangles[t].closes ? check.votes[At(pair)].closes : check.votes[At(pair)].spoils);
    int worst = -1;
    for (int i = 0; i < static_cast<int>(pairs.size()); ++i) {
      const TriangleVote& vote = check.votes[At(i)];
      if (check.is_false[At(i)] || vote.spoils == 0 || vote.closes >= vote.spoils) continue;
      if (worst < 0) {
        worst = i;
        continue;
      }
      const TriangleVote& than = check.votes[At(worst)];
      const int excess = vote.spoils - vote.closes, than_excess = than.spoils - than.closes;
      const double similarity = pairs[At(i)].similarity, other = pairs[At(worst)].similarity;
      if (excess > than_excess || (excess == than_excess && similarity < other)) worst = i;
    }
    if (worst < 0) break;
    check.is_false[At(worst)] = true;
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (const int pair : triangles[t].pairs)
        if (pair == worst) is_gone[t] = true;
  }

  int kept = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (is_gone[t] || !triangles[t].closes) continue;
    check.worst_closure_px = std::max(check.worst_closure_px, triangles[t].closure);
    check.mean_closure_px += triangles[t].closure;
    ++kept;
  }
  if (kept > 0) check.mean_closure_px /= kept;
  return check;
}

}  // namespace arthro::authoring
