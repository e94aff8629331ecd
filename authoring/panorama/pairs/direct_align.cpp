#include "authoring/panorama/pairs/direct_align.h"

#include "authoring/panorama/pairs/direct_solver.h"
#include "authoring/panorama/pairs/verify_pair.h"

namespace arthro::authoring {

std::optional<PairEstimate> AlignDirect(const DirectPyramid& a, const DirectPyramid& b, int ia,
                                        int ib, const cv::Matx33d& start_b_from_a,
                                        const DirectOptions& options, std::string* why_not) {
  const auto refuse = [&](std::string why) {
    if (why_not) *why_not = std::move(why);
    return std::nullopt;
  };
  if (!a.HasTexture() || !b.HasTexture()) return refuse("no texture to compare");
  PairEstimate pair;
  pair.a = ia, pair.b = ib;
  pair.source = PairSource::kDirect;
  pair.b_from_a = start_b_from_a * (1 / start_b_from_a(2, 2));
  // Coarse level: large errors are a shift and a rotation; the perspective of the start is kept.
  {
    DirectSolver solver(a.level(2), b.level(2));
    if (!solver.Solve(Motion::kSimilarity, options.most_iterations, 0.2, pair.b_from_a) ||
        !solver.Solve(Motion::kAffine, options.most_iterations, 0.2, pair.b_from_a) ||
        !solver.Solve(Motion::kHomography, options.most_iterations, 0.1, pair.b_from_a))
      return refuse("the frames do not overlap where they should");
  }
  for (int k = 1; k >= 0; --k) {
    DirectSolver solver(a.level(k), b.level(k));
    if (!solver.Solve(Motion::kHomography, options.most_iterations, k == 0 ? 0.01 : 0.03,
                      pair.b_from_a))
      return refuse("the frames do not overlap where they should");
  }
  const PairVerdict verdict = VerifyPair(a, b, options, pair);
  if (!verdict.is_accepted) return refuse(verdict.why_not);
  return pair;
}

}  // namespace arthro::authoring
