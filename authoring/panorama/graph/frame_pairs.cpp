#include "authoring/panorama/graph/frame_pairs.h"

#include <numbers>

#include "authoring/panorama/graph/parallel.h"
#include "authoring/panorama/pairs/coarse_align.h"
#include "authoring/panorama/pairs/direct_align.h"

namespace arthro::authoring {
namespace {

// A search without any prediction: every turn, and half to twice the size.
constexpr double kSearchZoom = 0.35;
constexpr std::size_t kCandidatesTried = 2;

}  // namespace

FramePairs::FramePairs(const std::vector<WorkingFrame>& frames, const RegisterOptions& options,
                       const Progress& progress)
    : options_(options), pyramids_(frames.size()), unusable_(frames.size()) {
  ForEachIndex(static_cast<int>(frames.size()), options.threads, progress, "looking at frames",
               [&](int index) {
                 const auto i = static_cast<std::size_t>(index);
                 pyramids_[i].emplace(frames[i], options.direct);
                 if (!pyramids_[i]->HasTexture())
                   unusable_[i] = "shows no texture that another frame could be laid over";
               });
}

std::optional<PairEstimate> FramePairs::Make(const PairRequest& request,
                                             std::string* why_not) const {
  return Direct(request, why_not);
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
