#include "authoring/panorama/compose/compose.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "authoring/panorama/compose/cell_blend.h"
#include "authoring/panorama/compose/consensus.h"
#include "authoring/panorama/compose/detail_blend.h"
#include "authoring/panorama/compose/layout.h"
#include "authoring/panorama/compose/light_model.h"
#include "authoring/panorama/compose/part_progress.h"
#include "authoring/panorama/compose/shares.h"
#include "simulation/core/option_fields.h"
#include "simulation/core/process_cost.h"

namespace arthro::authoring {
namespace {

// Adds the processor time until its end to a field of the report.
class CpuTimer {
 public:
  explicit CpuTimer(double& total) : total_(total), start_(ProcessCpuMs()) {}
  ~CpuTimer() { total_ += ProcessCpuMs() - start_; }
  CpuTimer(const CpuTimer&) = delete;
  CpuTimer& operator=(const CpuTimer&) = delete;

 private:
  double& total_;
  double start_;
};

// Position in the layout by index in the footage; -1: not in it.
int PositionOf(const Layout& layout, int index) {
  const auto found = std::lower_bound(layout.frames.begin(), layout.frames.end(), index,
                                      [](const LaidFrame& f, int i) { return f.index < i; });
  if (found == layout.frames.end() || found->index != index) return -1;
  return static_cast<int>(found - layout.frames.begin());
}

// Alpha: 255 inside the union of the frames, falling to 0 over `feather` px towards its border.
// Returns the imaged share of the picture.
double WriteAlpha(const Layout& layout, const std::vector<char>& is_seen, double feather,
                  cv::Mat& rgba) {
  cv::Mat imaged(layout.size, CV_8U, cv::Scalar(0));
  cv::Mat cells(layout.cells, CV_8U, cv::Scalar(0));  // shown of a surface
  constexpr int kShift = 4;                           // fractional bits of fillPoly
  std::vector<std::vector<cv::Point>> polygon(1);
  for (std::size_t f = 0; f < layout.frames.size(); ++f) {
    if (!is_seen[f]) continue;
    if (!layout.frames[f].surface.empty()) {
      cv::Mat part = cells(layout.frames[f].cells);
      cv::max(part, layout.frames[f].surface.is_shown, part);
      continue;
    }
    polygon[0].clear();
    for (const cv::Point2d& p : layout.frames[f].outline)
      polygon[0].emplace_back(static_cast<int>(std::lround(p.x * (1 << kShift))),
                              static_cast<int>(std::lround(p.y * (1 << kShift))));
    cv::fillPoly(imaged, polygon, cv::Scalar(255), cv::LINE_8, kShift);
  }
  if (cv::countNonZero(cells) > 0) {
    cv::Mat large;
    cv::resize(cells, large, layout.cells * layout.cell, 0, 0, cv::INTER_LINEAR);
    cv::max(imaged, large(cv::Rect({0, 0}, layout.size)) >= 128, imaged);
  }
  const double share = cv::countNonZero(imaged) / static_cast<double>(imaged.total());
  const int reach = static_cast<int>(std::lround(feather));
  cv::Mat alpha = imaged;
  if (reach > 0) {
    // Half of a square window is imaged at a straight border, all of it further inside.
    const cv::Size window(2 * reach + 1, 2 * reach + 1);
    cv::boxFilter(imaged, alpha, -1, window, {-1, -1}, true, cv::BORDER_CONSTANT);
    cv::Mat table(1, 256, CV_8U);
    for (int i = 0; i < 256; ++i)
      table.at<uchar>(i) = i >= 254 ? 255 : cv::saturate_cast<uchar>(2 * (i - 128));
    cv::LUT(alpha, table, alpha);
    alpha.setTo(0, imaged == 0);
  }
  const int from_to[] = {0, 3};
  cv::mixChannels(&alpha, 1, &rgba, 1, from_to, 1);
  return share;
}

// Growing panorama with a pixel per cell: frames as they are read, later the blended cells.
class Preview {
 public:
  Preview(const Layout& layout, const ComposeOptions& options, const ComposeObserver& observer)
      : every_(options.preview_every), observer_(observer) {
    if (observer_) rgba_ = cv::Mat(layout.cells, CV_8UC4, cv::Scalar::all(0));
  }

  void Show(const FrameCells& cells, const cv::Rect& box, double done) {
    if (!observer_) return;
    for (int y = 0; y < box.height; ++y)
      for (int x = 0; x < box.width; ++x) {
        if (cells.blend_weight.at<uchar>(y, x) < 64) continue;
        auto& pixel = rgba_.at<cv::Vec4b>(box.y + y, box.x + x);
        const auto& colour = cells.colour.at<cv::Vec3w>(y, x);
        for (int c = 0; c < 3; ++c) {
          const double own = colour[c] / kGreySteps;
          pixel[c] = cv::saturate_cast<uchar>(pixel[3] ? 0.5 * (own + pixel[c]) : own);
        }
        pixel[3] = 255;
      }
    if (++shown_ % every_ == 0) observer_(rgba_, done);
  }

  void Show(const cv::Mat& slow, const cv::Mat& is_known, double done) {
    if (!observer_) return;
    for (int y = 0; y < rgba_.rows; ++y)
      for (int x = 0; x < rgba_.cols; ++x) {
        const auto& colour = slow.at<cv::Vec3f>(y, x);
        auto& pixel = rgba_.at<cv::Vec4b>(y, x);
        for (int c = 0; c < 3; ++c) pixel[c] = cv::saturate_cast<uchar>(colour[c]);
        pixel[3] = is_known.at<uchar>(y, x) ? 255 : 0;
      }
    observer_(rgba_, done);
  }

 private:
  int every_ = 1, shown_ = 0;
  const ComposeObserver& observer_;
  cv::Mat rgba_;
};

class Composer {
 public:
  Composer(const FrameSource& source, const FramePicture& picture, const Layout& layout,
           const ComposeOptions& options, ComposeReport& report, const Progress& progress)
      : source_(source),
        picture_(picture),
        layout_(layout),
        options_(options),
        report_(report),
        looking_(PartOf(progress, 0, kLooked)),
        lighting_(PartOf(progress, kLooked, kLit)),
        choosing_(PartOf(progress, kLit, kChosen)),
        drawing_(PartOf(progress, kChosen, kDrawn)),
        finishing_(PartOf(progress, kDrawn, 1)),
        cells_(layout.frames.size()),
        is_seen_(layout.frames.size(), 0) {
    for (const LaidFrame& frame : layout.frames)
      rays_.emplace_back(frame, layout.cell, picture.view);
  }

  // First pass: each frame's colours on the cells.
  void Look(Preview& preview) {
    const CpuTimer timer(report_.first_pass_ms);
    cv::Mat raw, rectified;
    for (int index = 0; source_(index, raw);) {
      const int f = PositionOf(layout_, index);
      looking_.Step("look at frames", f < 0 ? 0.0 : Share(f));
      if (f < 0 || is_seen_[f]) continue;
      try {
        picture_.draw(raw, rectified);
      } catch (const Error& error) {  // one faulty frame does not stop a clip
        report_.left_out.push_back({index, error.sentence()});
        continue;
      }
      cells_[f] = CellsOf(rectified, TissueMask(rectified, picture_.mask), picture_.mask,
                          layout_.frames[f], layout_.cell);
      is_seen_[f] = 1;
      ++report_.frames_seen;
      preview.Show(cells_[f], layout_.frames[f].cells, 0.4 * Share(f));
    }
  }

  void TakeLightOut() {
    const CpuTimer timer(report_.light_ms);
    light_ = EstimateLight(cells_, rays_, layout_, options_, lighting_);
    const ToneCurve tone(light_);
    double least = 0, most = 0;
    bool is_first = true;
    for (std::size_t f = 0; f < cells_.size(); ++f) {
      if (!is_seen_[f]) continue;
      lighting_.Step("even light", Share(f));
      EvenLight(cells_[f], rays_[f], layout_.frames[f].cells, light_, static_cast<int>(f), tone);
      const double gain = light_.frames[f].gain;
      least = is_first ? gain : std::min(least, gain);
      most = is_first ? gain : std::max(most, gain);
      is_first = false;
    }
    report_.gain_spread = std::exp(most - least);
  }

  // Chooses the frames of each cell and computes the low frequencies.
  void Decide(Preview& preview) {
    const CpuTimer timer(report_.seams_ms);
    consensus_ = FindConsensus(cells_, rays_, layout_, options_, choosing_);
    report_.outlier_share = consensus_.outlier_share;
    report_.light_residue = consensus_.residue;
    const double known = cv::countNonZero(consensus_.is_known);
    const double glaring = cv::countNonZero(consensus_.is_known == 128);
    report_.hole_share = known > 0 ? glaring / known : 0;
    shares_ = ShareCells(cells_, rays_, layout_, options_, choosing_);
    slow_ = BlendCells(cells_, shares_, consensus_, layout_, choosing_);
    preview.Show(slow_, consensus_.is_known, 0.5);
  }

  // Second pass: adds the detail.
  cv::Mat Draw() {
    const CpuTimer timer(report_.second_pass_ms);
    const ToneCurve tone(light_);
    DetailBlend detail(layout_);
    cv::Mat raw, rectified;
    for (int index = 0; source_(index, raw);) {
      const int f = PositionOf(layout_, index);
      drawing_.Step("blend", f < 0 ? 0.0 : Share(f));
      if (f < 0 || shares_[f].empty() || cv::countNonZero(shares_[f]) == 0) continue;
      picture_.draw(raw, rectified);
      const LaidFrame& frame = layout_.frames[f];
      DetailSource drawn{rectified, TissueMask(rectified, picture_.mask),
                         FilledCells(cells_[f], consensus_, frame.cells), shares_[f],
                         cv::Mat(frame.cells.size(), CV_32F)};
      for (int y = 0; y < frame.cells.height; ++y)
        for (int x = 0; x < frame.cells.width; ++x)
          drawn.gain.at<float>(y, x) = static_cast<float>(
              std::exp(-light_.Excess(f, rays_[f].At(frame.cells.x + x, frame.cells.y + y))));
      detail.Add(drawn, frame, tone, drawing_, Share(f));
      shares_[f].release();
      cells_[f] = {};
      ++report_.frames_contributing;
    }
    cv::Mat rgba(layout_.size, CV_8UC4, cv::Scalar::all(0));
    detail.Finish(slow_, rgba, finishing_);
    report_.covered_share = WriteAlpha(layout_, is_seen_, options_.feather, rgba);
    return rgba;
  }

 private:
  double Share(std::size_t f) const {
    return static_cast<double>(f) / static_cast<double>(layout_.frames.size());
  }

  const FrameSource& source_;
  const FramePicture& picture_;
  const Layout& layout_;
  const ComposeOptions& options_;
  ComposeReport& report_;
  // Ends of the parts as shares of the whole: two passes over the footage, and the work on cells
  // between them. A part that is done over and over, such as the light, goes forward only once.
  static constexpr double kLooked = 0.35, kLit = 0.43, kChosen = 0.52, kDrawn = 0.95;
  Progress looking_, lighting_, choosing_, drawing_, finishing_;
  std::vector<FrameCells> cells_;
  std::vector<char> is_seen_;
  std::vector<CellRays> rays_;
  LightModel light_;
  Consensus consensus_;
  std::vector<cv::Mat> shares_;
  cv::Mat slow_;
};

}  // namespace

ComposedPanorama Compose(const FrameSource& source, const Rectifier& rectifier,
                         const std::vector<FrameResult>& frames, const ComposeOptions& options,
                         ComposeReport* report, const Progress& progress,
                         const ComposeObserver& observer) {
  CheckOptions(options);
  const FramePicture picture{
      [&](const cv::Mat& raw, cv::Mat& drawn) { rectifier.Rectify(raw, drawn); }, rectifier.mask(),
      rectifier.view()};
  const Layout layout = LayOut(rectifier.mask(), rectifier.view(), frames, options);
  return ComposeLayout(source, picture, layout, options, report, progress, observer);
}

ComposedPanorama ComposeLayout(const FrameSource& source, const FramePicture& picture,
                               const Layout& layout, const ComposeOptions& options,
                               ComposeReport* report, const Progress& progress,
                               const ComposeObserver& observer) {
  CheckOptions(options);
  ComposeReport own;
  ComposeReport& told = report ? *report : own;
  told = {};
  ComposedPanorama panorama;
  told.left_out = layout.left_out;
  if (layout.frames.empty()) return panorama;
  told.scale = layout.scale;
  told.cell = layout.cell;
  Preview preview(layout, options, observer);
  Composer composer(source, picture, layout, options, told, progress);
  composer.Look(preview);
  if (told.frames_seen == 0) return panorama;
  composer.TakeLightOut();
  composer.Decide(preview);
  panorama.rgba = composer.Draw();
  panorama.composed_from_panorama = layout.composed_from_panorama;
  panorama.view = layout.view;
  if (observer) {
    cv::Mat small;
    cv::resize(panorama.rgba, small, layout.cells, 0, 0, cv::INTER_AREA);
    observer(small, 1.0);
  }
  return panorama;
}

}  // namespace arthro::authoring
