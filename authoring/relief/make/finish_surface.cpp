#include "authoring/relief/make/finish_surface.h"

#include <limits>

#include <opencv2/imgproc.hpp>

#include "authoring/relief/surface/brightness_range.h"

namespace arthro::authoring {
namespace {

constexpr int kHighlight = 21;  // px, of the lens's picture: wider gaps of a mask are tool or rim

// Finds the cells that each view sees without its highlights. Cells that are a highlight in every
// frame count as seen, since highlights hide no tissue.
void See(const MeasuredRelief& made, int threads, const Progress& progress,
         FinishedSurface& finished) {
  const auto seen_by = [&](const std::vector<SurfaceView>& views, cv::Mat& seen) {
    auto visible =
        VisibleCells(views, made.lens, finished.cells, finished.closed.radius, threads, progress);
    seen = cv::Mat::zeros(finished.cells.size, CV_8U);
    for (const cv::Mat& one : visible) seen |= one;
    return visible;
  };
  std::vector<SurfaceView> whole = finished.views;
  const cv::Mat highlight = cv::getStructuringElement(cv::MORPH_ELLIPSE, {kHighlight, kHighlight});
  for (SurfaceView& view : whole) {
    cv::Mat mask;
    cv::morphologyEx(view.mask, mask, cv::MORPH_CLOSE, highlight);
    view.mask = mask;
  }
  cv::Mat seen;
  finished.visible = seen_by(finished.views, seen);
  const auto with_highlights = seen_by(whole, finished.is_seen);
  const cv::Mat only_highlights = finished.is_seen & ~seen;
  for (std::size_t v = 0; v < whole.size(); ++v)
    finished.visible[v] |= with_highlights[v] & only_highlights;
}

}  // namespace

FinishedSurface FinishSurface(const MeasuredRelief& made, const ReliefOptions& options,
                              const Progress& progress) {
  FinishedSurface finished;
  const SweptSurface& surface = made.surface;
  finished.confidence = ConfidenceOf(surface, made.lens.focal_px(), options.least_parallax);
  finished.cells = CellDirections(surface.projection, surface.radius.size());
  OpenSurface open{surface.radius, SigmaOfMeasured(surface, made.lens.focal_px()), {}, {}};
  open.sigma.setTo(std::numeric_limits<float>::quiet_NaN(),
                   ~(finished.confidence >= options.least_confidence));
  finished.closed = CloseSurface(open, progress);
  if (finished.closed.radius.empty()) return finished;
  finished.views = ViewsOf(made.clip.frames, made.motion.scene, 0);
  const auto see = [&] { See(made, options.threads, progress, finished); };
  see();
  if (!options.use_brightness || !options.close) return finished;

  std::vector<cv::Mat> pictures;
  for (const SurfaceView& view : finished.views)
    pictures.push_back(made.clip.pictures[static_cast<std::size_t>(view.frame)]);
  const BrightnessRange lit =
      RangeFromBrightness(finished.views, pictures, made.lens, finished.cells, finished.closed,
                          finished.visible, options.threads, progress);
  if (cv::countNonZero(lit.radius > 0) == 0) return finished;
  open.estimate = lit.radius;
  open.estimate_sigma = lit.sigma;
  finished.closed = CloseSurface(open, progress);
  see();
  return finished;
}

}  // namespace arthro::authoring
