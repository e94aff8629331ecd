#include "authoring/panorama/graph/frame_pairs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "authoring/panorama/graph/links/parallel.h"
#include "authoring/panorama/pairs/coarse_align.h"
#include "authoring/panorama/pairs/direct_align.h"
#include "authoring/panorama/pairs/feature_pairs.h"
#include "authoring/panorama/pairs/verify_pair.h"

namespace arthro::authoring {
namespace {

// Range of a search without prediction: every rotation, and half to twice the size.
constexpr double kSearchZoom = 0.35;
constexpr std::size_t kCandidatesTried = 2;

// Error of a pair caused by light that moves with the scope: it shades bumps differently in every
// frame and biases the alignment. The bias shows in a low similarity of the two frames. On clips
// with known truth the error of a pair grows as the -4.2th power of its similarity: 0.09 px at 1,
// 0.25 px at 0.78, 1.1 px at 0.55, 5 px at 0.38. The pair's own statistics do not contain it, so it
// is added to the covariance: inv(inv(I) + s^2).
constexpr double kTwinError = 0.09;  // px
constexpr double kPower = -4.2;
constexpr double kLeastSimilarity = 0.2;

void AddShadingError(PairEstimate& pair) {
  const double error = kTwinError * std::pow(std::max(pair.similarity, kLeastSimilarity), kPower);
  const auto sum = cv::Matx<double, 8, 8>::eye() + pair.information * (error * error);
  const cv::Matx<double, 8, 8> information = pair.information * sum.inv();
  pair.information = (information + information.t()) * 0.5;
}

}  // namespace

FramePairs::FramePairs(const std::vector<WorkingFrame>& frames, const RegisterOptions& options,
                       const Progress& progress)
    : options_(options),
      pyramids_(frames.size()),
      features_(frames.size()),
      unusable_(frames.size()) {
  ForEachIndex(static_cast<int>(frames.size()), options.threads, progress, "looking at frames",
               [&](int index) {
                 const auto i = static_cast<std::size_t>(index);
                 pyramids_[i].emplace(frames[i], options.direct);
                 if (options.method != PairMethod::kDirect)
                   features_[i].emplace(DetectFeatures(frames[i], options.features));
                 if (!pyramids_[i]->HasTexture())
                   unusable_[i] = "shows no texture that could be aligned with another frame";
               });
}

std::optional<PairEstimate> FramePairs::Make(const PairRequest& request,
                                             std::string* why_not) const {
  std::optional<PairEstimate> pair;
  if (options_.method != PairMethod::kDirect) pair = ByFeatures(request, why_not);
  if (!pair && options_.method != PairMethod::kFeatures) pair = Direct(request, why_not);
  if (pair) AddShadingError(*pair);
  return pair;
}

std::optional<PairEstimate> FramePairs::ByFeatures(const PairRequest& request,
                                                   std::string* why_not) const {
  const auto a = static_cast<std::size_t>(request.a), b = static_cast<std::size_t>(request.b);
  const bool is_predicted = request.effort == PairEffort::kPredicted;
  // A predicted pair needs no points: direct alignment starts from the prediction.
  if (is_predicted && options_.method == PairMethod::kFeaturesThenDirect) return std::nullopt;
  auto pair = MatchFeatures(*features_[a], *features_[b], request.a, request.b, options_.features,
                            why_not, is_predicted ? &request.predicted_b_from_a : nullptr);
  if (!pair) return std::nullopt;
  if (options_.method == PairMethod::kFeatures) {
    // Points alone; the pixels only verify the result.
    const PairVerdict verdict = VerifyPair(*pyramids_[a], *pyramids_[b], options_.direct, *pair);
    if (verdict.is_accepted) return pair;
    if (why_not) *why_not = verdict.why_not;
    return std::nullopt;
  }
  auto refined = AlignDirect(*pyramids_[a], *pyramids_[b], request.a, request.b, pair->b_from_a,
                             options_.direct, why_not);
  if (!refined) return std::nullopt;
  refined->source = PairSource::kFeatures;
  refined->inliers = pair->inliers;
  refined->rms_px = pair->rms_px;
  return refined;
}

std::optional<PairEstimate> FramePairs::Direct(const PairRequest& request,
                                               std::string* why_not) const {
  const DirectPyramid& a = *pyramids_[static_cast<std::size_t>(request.a)];
  const DirectPyramid& b = *pyramids_[static_cast<std::size_t>(request.b)];
  const bool is_predicted = request.effort == PairEffort::kPredicted;
  if (is_predicted) {
    auto pair = AlignDirect(a, b, request.a, request.b, request.predicted_b_from_a, options_.direct,
                            why_not);
    if (pair) return pair;
  }
  DirectOptions direct = options_.direct;
  if (request.effort == PairEffort::kSearch) {
    direct.rotation_reach = std::numbers::pi;
    direct.zoom_reach = kSearchZoom;
  }
  const auto candidates =
      CoarseCandidates(a, b, is_predicted ? &request.predicted_b_from_a : nullptr, direct);
  for (std::size_t i = 0; i < std::min(candidates.size(), kCandidatesTried); ++i) {
    auto pair = AlignDirect(a, b, request.a, request.b, candidates[i].b_from_a, direct, why_not);
    if (pair) return pair;
  }
  return std::nullopt;
}

}  // namespace arthro::authoring
