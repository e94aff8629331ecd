#include "authoring/panorama/ties/place_ties.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "authoring/panorama/graph/frame_pairs.h"
#include "authoring/panorama/graph/links/pair_graph.h"
#include "simulation/core/error.h"

namespace arthro::authoring {
namespace {

constexpr double kLeastOverlap = 0.3;  // share of the window, for the refinement by pixels
constexpr std::size_t kMostNeighbours = 4;
constexpr double kPairFloor = 0.05;  // px, as in cycle_check.cpp

class TiePlacer {
 public:
  TiePlacer(const PreparedClip& clip, const cv::Matx33d& composed_from_plane,
            const RegisterOptions& options, std::vector<FrameResult>& placed,
            const Progress& progress)
      : clip_(clip),
        plane_from_composed_(composed_from_plane.inv()),
        options_(options),
        placed_(placed),
        before_(placed),
        window_(WindowOf(clip.view, clip.mask)),
        progress_(progress) {}

  TiedFrame Place(int index, const std::vector<std::pair<std::size_t, FrameTie>>& ties) {
    const FrameResult& base = Base(index);
    // The pairs in the plane, then in the frame of the panorama that lies nearest to them.
    std::vector<cv::Point2d> own, in_plane;
    std::vector<std::string> names;
    for (const auto& [number, tie] : ties) {
      names.push_back(fmt::format("pair {} of frame {}", number, index));
      own.push_back(Rectified(tie.pixel, names.back()));
      in_plane.push_back(InPlane(tie, names.back()));
    }
    const FrameResult& other = Nearest(in_plane);
    const cv::Matx33d other_from_plane = other.panorama_from_rectified.inv();
    std::vector<cv::Point2d> in_other;
    in_other.reserve(in_plane.size());
    for (const cv::Point2d& p : in_plane) in_other.push_back(Apply(other_from_plane, p));
    TieFit fit;
    try {
      fit = FitTies(own, in_other, names, 2 * window_.radius);
    } catch (const Error& error) {
      throw Error(error.code(),
                  fmt::format("frame {} was not placed by its pairs: {}", index, error.sentence()));
    }
    TiedFrame tied{index, fit.pairs, fit.rms_px, 0, false};
    cv::Matx33d place = other.panorama_from_rectified * fit.b_from_a;
    double error = 0;
    for (const cv::Point2d& p : window_.nine) error = std::max(error, TieError(fit, p));
    error = std::hypot(error, other.expected_error_px);
    tied.is_refined = Refine(index, own, in_plane, fit, place, error);
    tied.expected_error_px = error;
    Adopt(base, place, fit, error);
    return tied;
  }

 private:
  const FrameResult& Base(int index) const {
    const auto here = std::find_if(before_.begin(), before_.end(),
                                   [&](const FrameResult& r) { return r.index == index; });
    if (here != before_.end() && here->component != 0) return *here;
    std::string why = "it is in the panorama already; remove its pairs";
    if (here == before_.end()) {
      why = fmt::format("the clip has {} frames", clip_.reports.size());
      if (index < static_cast<int>(clip_.reports.size())) {
        const FrameReport& row = clip_.reports[static_cast<std::size_t>(index)];
        why = row.is_usable ? "it is left out by hand" : "it is not used (" + row.reason + ")";
      }
    }
    throw Error(Code::kBadData, fmt::format("frame {} cannot be placed by pairs: {}", index, why));
  }

  cv::Point2d Rectified(const glm::dvec2& raw, const std::string& name) const {
    const glm::dvec2 pixel(raw.x - clip_.lens.part.x, raw.y - clip_.lens.part.y);
    const auto ray = RayFromPixel(clip_.lens.lens, pixel);
    const bool is_inside = pixel.x >= -0.5 && pixel.y >= -0.5 &&
                           pixel.x <= clip_.lens.part.width - 0.5 &&
                           pixel.y <= clip_.lens.part.height - 0.5;
    if (!ray || !(ray->z > 0) || !is_inside)
      throw Error(Code::kBadData,
                  fmt::format("{} lies at ({:.0f}, {:.0f}), outside of what the lens shows; mend "
                              "it",
                              name, raw.x, raw.y));
    const RectifiedView& view = clip_.view;
    return {view.cx + view.focal_px * ray->x / ray->z, view.cy + view.focal_px * ray->y / ray->z};
  }

  cv::Point2d InPlane(const FrameTie& tie, const std::string& name) const {
    if (tie.panorama)
      return Apply(plane_from_composed_, {tie.panorama->pixel.x, tie.panorama->pixel.y});
    for (const FrameResult& other : before_)
      if (other.index == tie.other->frame && other.is_placed && other.component == 0)
        return Apply(other.panorama_from_rectified, Rectified(tie.other->pixel, name));
    throw Error(Code::kBadData,
                fmt::format("{} joins it to frame {}, which is not in the panorama; choose a frame "
                            "that is",
                            name, tie.other->frame));
  }

  const FrameResult& Nearest(const std::vector<cv::Point2d>& in_plane) const {
    cv::Point2d middle(0, 0);
    for (const cv::Point2d& p : in_plane)
      middle += p * (1.0 / static_cast<double>(in_plane.size()));
    const FrameResult* nearest = nullptr;
    double least = 0;
    for (const FrameResult& other : before_) {
      if (!other.is_placed || other.component != 0) continue;
      const double off =
          cv::norm(Apply(other.panorama_from_rectified.inv(), middle) - window_.centre);
      if (nearest == nullptr || off < least) nearest = &other, least = off;
    }
    return *nearest;  // a panorama has two frames
  }

  const WorkingFrame* WorkingOf(int index) const {
    for (const WorkingFrame& frame : clip_.frames)
      if (frame.index == index) return &frame;
    return nullptr;
  }

  // Aligns the frame's pixels with those of its neighbours, from the place that the pairs give. The
  // result counts where it agrees with the pairs.
  bool Refine(int index, const std::vector<cv::Point2d>& own,
              const std::vector<cv::Point2d>& in_plane, const TieFit& fit, cv::Matx33d& place,
              double& error) const {
    std::vector<std::pair<double, const FrameResult*>> neighbours;
    for (const FrameResult& other : before_) {
      if (!other.is_placed || other.component != 0) continue;
      const double overlap = OverlapOf(window_, other.panorama_from_rectified.inv() * place);
      if (overlap >= kLeastOverlap) neighbours.emplace_back(overlap, &other);
    }
    std::stable_sort(neighbours.begin(), neighbours.end(),
                     [](const auto& x, const auto& y) { return x.first > y.first; });
    neighbours.resize(std::min(neighbours.size(), kMostNeighbours));
    std::vector<WorkingFrame> frames = {*WorkingOf(index)};
    for (const auto& [overlap, other] : neighbours) frames.push_back(*WorkingOf(other->index));
    const FramePairs maker(frames, options_, progress_);
    std::optional<PairEstimate> best;
    for (std::size_t k = 0; k < neighbours.size(); ++k) {
      progress_.Step("placing frames by their pairs", 0.5);
      if (!maker.unusable()[0].empty() || !maker.unusable()[k + 1].empty()) continue;
      cv::Matx33d predicted = neighbours[k].second->panorama_from_rectified.inv() * place;
      predicted *= 1 / predicted(2, 2);
      std::string why_not;
      const auto pair =
          maker.Make({0, static_cast<int>(k) + 1, PairEffort::kPredicted, predicted}, &why_not);
      if (pair && (!best || pair->similarity > best->similarity)) best = pair;
    }
    if (!best) return false;
    const FrameResult& other = *neighbours[static_cast<std::size_t>(best->b) - 1].second;
    const cv::Matx33d refined = other.panorama_from_rectified * best->b_from_a;
    // A right alignment moves no clicked point by more than its click and the fit can be wrong.
    constexpr double kDeviations = 4;
    const cv::Matx33d other_from_plane = other.panorama_from_rectified.inv();
    for (std::size_t i = 0; i < own.size(); ++i) {
      const cv::Point2d off = Apply(best->b_from_a, own[i]) - Apply(other_from_plane, in_plane[i]);
      if (cv::norm(off) > kDeviations * std::hypot(TieError(fit, own[i]), fit.rms_px)) return false;
    }
    place = refined;
    error = std::hypot(other.expected_error_px, PairDeviation(*best, kPairFloor));
    return true;
  }

  // The frame, and with it the frames of its piece.
  void Adopt(const FrameResult& base, const cv::Matx33d& place, const TieFit& fit, double error) {
    const cv::Matx33d plane_from_piece = place * base.panorama_from_rectified.inv();
    for (std::size_t i = 0; i < before_.size(); ++i) {
      const bool is_tied = before_[i].index == base.index;
      if (!is_tied && (base.component < 0 || before_[i].component != base.component)) continue;
      FrameResult& result = placed_[i];
      if (!is_tied && result.component == 0) continue;  // another tie has brought it
      result.panorama_from_rectified =
          is_tied ? place : plane_from_piece * before_[i].panorama_from_rectified;
      result.panorama_from_rectified *= 1 / result.panorama_from_rectified(2, 2);
      result.expected_error_px = error;
      if (!is_tied) {
        const cv::Matx33d tied_from_frame =
            base.panorama_from_rectified.inv() * before_[i].panorama_from_rectified;
        double farthest = error;
        for (const cv::Point2d& p : window_.nine)
          farthest = std::max(farthest, TieError(fit, Apply(tied_from_frame, p)));
        result.expected_error_px = std::hypot(farthest, before_[i].expected_error_px);
      }
      result.component = 0;
      result.is_placed = true;
      result.reason.clear();
    }
  }

  const PreparedClip& clip_;
  cv::Matx33d plane_from_composed_;
  const RegisterOptions& options_;
  std::vector<FrameResult>& placed_;
  const std::vector<FrameResult> before_;
  FrameWindow window_;
  const Progress& progress_;
};

}  // namespace

std::vector<TiedFrame> PlaceTies(const PreparedClip& clip, const std::vector<FrameTie>& ties,
                                 const std::set<int>& excluded,
                                 const cv::Matx33d& composed_from_plane,
                                 const RegisterOptions& options, std::vector<FrameResult>& placed,
                                 const Progress& progress) {
  // Pairs of each frame, numbered from 1 as a person counts them.
  std::map<int, std::vector<std::pair<std::size_t, FrameTie>>> of_frame;
  for (const FrameTie& tie : ties)
    if (!excluded.contains(tie.frame)) {
      auto& own = of_frame[tie.frame];
      own.emplace_back(own.size() + 1, tie);
    }
  TiePlacer placer(clip, composed_from_plane, options, placed, progress);
  std::vector<TiedFrame> tied;
  for (const auto& [index, own] : of_frame) {
    progress.Step("placing frames by their pairs",
                  static_cast<double>(tied.size()) / static_cast<double>(of_frame.size()));
    tied.push_back(placer.Place(index, own));
  }
  return tied;
}

}  // namespace arthro::authoring
