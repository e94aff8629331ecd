#include "authoring/panorama/graph/register.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "authoring/panorama/graph/frame_pairs.h"
#include "authoring/panorama/graph/links/pair_graph.h"
#include "simulation/core/error.h"
#include "simulation/core/process_cost.h"

namespace arthro::authoring {
namespace {

// OpenCV's own threads would compete with ours and change the order of sums.
class OneOpenCvThread {
 public:
  OneOpenCvThread() : before_(cv::getNumThreads()) { cv::setNumThreads(1); }
  ~OneOpenCvThread() { cv::setNumThreads(before_); }
  OneOpenCvThread(const OneOpenCvThread&) = delete;
  OneOpenCvThread& operator=(const OneOpenCvThread&) = delete;

 private:
  int before_;
};

void CheckFrames(const std::vector<WorkingFrame>& frames) {
  for (const WorkingFrame& frame : frames)
    if (frame.grey.size() != frames[0].grey.size() || frame.scale != frames[0].scale)
      throw Error(Code::kBadArgument,
                  fmt::format("frame {} is {} x {} at scale {}, the first one {} x {} at scale {}; "
                              "all working frames must be alike",
                              frame.index, frame.grey.cols, frame.grey.rows, frame.scale,
                              frames[0].grey.cols, frames[0].grey.rows, frames[0].scale));
}

// Factor on the movement that another focal length would cause: pairs distorted by a wrong lens
// have correlated errors.
constexpr double kFocalCaution = 1.5;

void CheckFocal(const Lens& lens, const RectifiedView& view, const FrameWindow& window,
                const RefineOptions& options, std::vector<FrameResult>& results,
                RegisterReport& told) {
  const int frames = static_cast<int>(results.size());
  std::vector<cv::Matx33d> places;
  places.reserve(results.size());
  for (const FrameResult& result : results) places.push_back(result.panorama_from_rectified);
  for (int piece = 0; piece < told.components; ++piece) {
    std::vector<PairEstimate> own;
    for (const PairEstimate& pair : told.pairs)
      if (results[static_cast<std::size_t>(pair.a)].component == piece) own.push_back(pair);
    if (own.empty()) continue;
    const int root = CentralFrame(frames, own, own[0].a);
    if (piece == 0) told.focal = FitFocal(frames, own, root, lens, view, options);
    if (!told.focal.is_determined) return;
    const std::vector<double> moved = FocalErrors(
        places, own, root, FocalChange(lens, view, told.focal.factor), window.nine, options);
    for (std::size_t i = 0; i < results.size(); ++i)
      if (results[i].component == piece)
        results[i].expected_error_px =
            std::hypot(results[i].expected_error_px, kFocalCaution * moved[i]);
  }
}

// Limits beyond which an assumption fails; clips with known truth stay below a third of each.
constexpr double kMostDriftFactor = 9;
constexpr double kMostVarianceFactor = 2.5;

void Warn(const RegisterOptions& options, const Lens* lens, RegisterReport& told) {
  const double off = told.focal.factor - 1;
  const bool is_flat = told.camera_deviation <= options.refine.camera_deviation * 1.01;
  if (lens && std::abs(off) > kFocalIsWrong) {
    told.warnings.push_back(fmt::format(
        "the focal length fits better at {:.1f} px: {:.1f} % {} than the lens says; calibrate "
        "again, "
        "or correct the lens file",
        lens->focal_px * told.focal.factor, 100 * std::abs(off), off > 0 ? "more" : "less"));
  } else if (told.drift_factor > kMostDriftFactor || told.variance_factor > kMostVarianceFactor) {
    told.warnings.push_back(
        "loops miss by more than their pairs predict: check the lens file, above all its focal "
        "length");
  } else if (!is_flat) {
    told.warnings.push_back(
        "surfaces at different depths (parallax): no flat panorama is true to all frames; expect "
        "ghosts where they meet");
  }
  if (told.components > 1)
    told.warnings.push_back(fmt::format(
        "the clip falls into {} pieces that do not join; the panorama shows the largest",
        told.components));
}

}  // namespace

std::vector<FrameResult> Register(const std::vector<WorkingFrame>& frames,
                                  const RectifiedView& view, const cv::Mat& mask,
                                  const RegisterOptions& options, RegisterReport* report,
                                  const Progress& progress, const Lens* lens) {
  RegisterReport ignored;
  RegisterReport& told = report ? *report : ignored;
  told = {};
  std::vector<FrameResult> results(frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) results[i].index = frames[i].index;
  if (frames.empty()) return results;
  CheckFrames(frames);
  const OneOpenCvThread one_thread;

  double begin = ProcessCpuMs();
  const FramePairs maker(frames, options, progress);
  told.features_ms = ProcessCpuMs() - begin;

  begin = ProcessCpuMs();
  const FrameWindow window = WindowOf(view, mask);
  const PlacedGraph graph = PlaceFrames(
      maker.unusable(),
      [&](const PairRequest& request, std::string* why) { return maker.Make(request, why); },
      window,
      view.focal_px > 0 ? std::optional(Pinhole{view.focal_px, view.cx, view.cy}) : std::nullopt,
      options.graph, options.cycles, options.refine, options.threads, progress);
  told.refine_ms = graph.refine_ms;
  told.pairs_ms = ProcessCpuMs() - begin - graph.refine_ms;

  for (std::size_t i = 0; i < frames.size(); ++i) {
    FrameResult& result = results[i];
    result.component = graph.component[i];
    result.is_placed = result.component >= 0;
    result.reason = graph.reason[i];
    result.expected_error_px = graph.expected_error_px[i];
    result.panorama_from_rectified = graph.plane_from_frame[i];
    told.components = std::max(told.components, result.component + 1);
  }
  // A frame's own residual: weighted mean over its pairs.
  std::vector<double> square(frames.size(), 0), weight(frames.size(), 0);
  for (std::size_t i = 0; i < graph.pairs.size(); ++i) {
    const PairEstimate& pair = graph.pairs[i];
    ++(pair.source == PairSource::kFeatures ? told.feature_pairs : told.direct_pairs);
    for (const int frame : {pair.a, pair.b}) {
      const auto at = static_cast<std::size_t>(frame);
      square[at] += graph.pair_error_px[i] * graph.pair_error_px[i];
      weight[at] += 1;
      results[at].inliers += pair.inliers;
    }
  }
  for (std::size_t i = 0; i < frames.size(); ++i)
    if (weight[i] > 0) results[i].rms_px = std::sqrt(square[i] / weight[i]);
  told.pairs = graph.pairs;
  told.pairs_tried = graph.tried;
  told.pairs_kept = static_cast<int>(graph.pairs.size());
  told.pairs_dropped = graph.dropped;
  told.drift_px = graph.drift_px;
  told.closure_px = graph.closure_px;
  told.variance_factor = graph.variance_factor;
  told.drift_factor = graph.drift_factor;
  told.camera_deviation = graph.camera_deviation;
  if (lens && options.graph.stages == GraphStages::kRefinement) {
    begin = ProcessCpuMs();
    progress.Step("checking the lens", 0);
    CheckFocal(*lens, view, window, options.refine, results, told);
    told.refine_ms += ProcessCpuMs() - begin;
  }
  Warn(options, lens, told);
  return results;
}

}  // namespace arthro::authoring
