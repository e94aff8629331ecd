#include "authoring/panorama/compose/layout.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "simulation/core/error.h"

namespace arthro::authoring {
namespace {

// Number of cells of all frames together: 8 bytes each in the memory of the first pass.
constexpr double kMostCells = 8e6;
constexpr int kSmallestCell = 4;      // px; the second pass holds finer detail
constexpr int kLongestSide = 30000;   // px; cv::remap uses 16-bit coordinates
constexpr double kBeyondOthers = 30;  // times the median area
constexpr double kUsualError = 2;     // px: a frame with this expected error has half the weight

using Outline = std::vector<cv::Point2d>;

// Border of the lens's visible area, with its corners kept and curves cut into short chords.
Outline OutlineOf(const cv::Mat& mask) {
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  const auto largest = std::max_element(contours.begin(), contours.end(), [](auto& a, auto& b) {
    return cv::contourArea(a) < cv::contourArea(b);
  });
  if (largest == contours.end()) return {};
  std::vector<cv::Point> kept;
  cv::approxPolyDP(*largest, kept, 0.7, true);
  if (kept.size() < 3) return {};
  return Outline(kept.begin(), kept.end());
}

double W(const cv::Matx33d& h, const cv::Point2d& p) {
  return h(2, 0) * p.x + h(2, 1) * p.y + h(2, 2);
}

cv::Point2d Map(const cv::Matx33d& h, const cv::Point2d& p) {
  const double w = W(h, p);
  return {(h(0, 0) * p.x + h(0, 1) * p.y + h(0, 2)) / w,
          (h(1, 0) * p.x + h(1, 1) * p.y + h(1, 2)) / w};
}

double Area(const Outline& outline) {
  double area = 0;
  for (std::size_t i = 0; i < outline.size(); ++i)
    area += outline[i].cross(outline[(i + 1) % outline.size()]);
  return area / 2;
}

// Reason why this homography cannot be drawn; empty when it can. Makes its last row positive.
std::string Reject(cv::Matx33d& h, const Outline& outline, const cv::Point2d& middle,
                   double most_stretch) {
  for (const double value : h.val)
    if (!std::isfinite(value)) return "its place is not a number";
  if (W(h, middle) < 0) h = -h;
  const double at_middle = W(h, middle);
  if (!(at_middle > 0) || std::abs(cv::determinant(h)) < 1e-12 * std::pow(cv::norm(h), 3))
    return "its place is degenerate";
  if (cv::determinant(h) < 0) return "its place mirrors it";
  // Scales the area of a pixel by w^-3.
  for (const cv::Point2d& p : outline)
    if (!(W(h, p) > at_middle / std::cbrt(most_stretch)))
      return fmt::format("it would be stretched more than {:g} times at its rim", most_stretch);
  h *= 1.0 / at_middle;
  return {};
}

// The frame with the most frontal view of the panorama's plane has its optical axis nearly on the
// panorama's. The two coincide when the plane is that of a frame, as registration chooses it.
RectifiedView ViewOfPlane(const Layout& layout, const RectifiedView& view) {
  const LaidFrame* straightest = nullptr;
  double least = std::numeric_limits<double>::max();
  for (const LaidFrame& frame : layout.frames) {
    const cv::Matx33d& h = frame.composed_from_rectified;
    const double slant = std::hypot(h(2, 0), h(2, 1));
    if (slant >= least) continue;
    least = slant;
    straightest = &frame;
  }
  const cv::Matx33d& h = straightest->composed_from_rectified;
  const cv::Point2d centre(view.cx, view.cy), axis = Map(h, centre);
  // Panorama px per rectified px at that point.
  const double zoom = std::sqrt(std::abs(cv::determinant(h)) / std::pow(std::abs(W(h, centre)), 3));
  return {layout.size.width, layout.size.height, view.focal_px * zoom, axis.x, axis.y};
}

}  // namespace

Layout LayOut(const cv::Mat& mask, const RectifiedView& view,
              const std::vector<FrameResult>& frames, const ComposeOptions& options) {
  Layout layout;
  const Outline outline = OutlineOf(mask);
  if (outline.empty()) return layout;
  const cv::Moments moments = cv::moments(mask, true);
  const cv::Point2d middle(moments.m10 / moments.m00, moments.m01 / moments.m00);

  // Selects frames that can be drawn at all, then those of a size similar to the others'.
  std::vector<double> areas;
  for (const FrameResult& frame : frames) {
    if (!frame.is_placed || frame.component != 0) continue;
    LaidFrame laid{frame.index, frame.panorama_from_rectified, outline, {}};
    const std::string reason =
        Reject(laid.composed_from_rectified, outline, middle, options.most_stretch);
    if (!reason.empty()) {
      layout.left_out.push_back({frame.index, reason});
      continue;
    }
    for (cv::Point2d& p : laid.outline) p = Map(laid.composed_from_rectified, p);
    const double error = frame.expected_error_px / kUsualError;
    if (std::isfinite(error)) {
      laid.trust = 1 / (1 + error * error);
      laid.expected_error_px = frame.expected_error_px;
    }
    areas.push_back(std::abs(Area(laid.outline)));
    layout.frames.push_back(std::move(laid));
  }
  if (layout.frames.empty()) return layout;
  std::vector<double> sorted = areas;
  std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
  const double usual = sorted[sorted.size() / 2];
  std::vector<LaidFrame> kept;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    if (areas[i] <= usual * kBeyondOthers && areas[i] >= usual / kBeyondOthers)
      kept.push_back(std::move(layout.frames[i]));
    else
      layout.left_out.push_back(
          {layout.frames[i].index,
           fmt::format("its area is {:.3g} times that of the usual frame", areas[i] / usual)});
  }
  std::sort(kept.begin(), kept.end(), [](auto& a, auto& b) { return a.index < b.index; });
  layout.frames = std::move(kept);

  // Bounds of the frames, and the scale at which they fit the limit.
  cv::Point2d low(std::numeric_limits<double>::max(), std::numeric_limits<double>::max()),
      high = -low;
  for (const LaidFrame& frame : layout.frames)
    for (const cv::Point2d& p : frame.outline) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  const cv::Point2d extent = high - low + cv::Point2d(1, 1);
  double scale = std::min(1.0, std::sqrt(options.most_megapixels * 1e6 / (extent.x * extent.y)));
  scale = std::min(scale, kLongestSide / std::max(extent.x, extent.y));
  layout.scale = scale;
  layout.size = {std::max(1, static_cast<int>(extent.x * scale)),
                 std::max(1, static_cast<int>(extent.y * scale))};
  const double shift = 0.5 * scale - 0.5;  // pixel centres
  layout.composed_from_panorama = {
      scale, 0, shift - low.x * scale, 0, scale, shift - low.y * scale, 0, 0, 1};

  // Cell width: as small as memory allows.
  double pixels = 0;
  for (LaidFrame& frame : layout.frames) {
    frame.composed_from_rectified = layout.composed_from_panorama * frame.composed_from_rectified;
    cv::Point2d least = high, most = low;
    for (cv::Point2d& p : frame.outline) {
      least = {std::min(least.x, p.x), std::min(least.y, p.y)};
      most = {std::max(most.x, p.x), std::max(most.y, p.y)};
      p = Map(layout.composed_from_panorama, p);
    }
    pixels += (most.x - least.x + 1) * (most.y - least.y + 1) * scale * scale;
  }
  layout.cell = kSmallestCell;
  while (pixels / layout.cell / layout.cell > kMostCells) layout.cell *= 2;
  const int c = layout.cell;
  layout.cells = {(layout.size.width + c - 1) / c, (layout.size.height + c - 1) / c};
  for (LaidFrame& frame : layout.frames) {
    cv::Point least(layout.cells.width, layout.cells.height), most(0, 0);
    for (const cv::Point2d& p : frame.outline) {
      least.x = std::min(least.x, static_cast<int>(std::floor((p.x + 0.5) / c)));
      least.y = std::min(least.y, static_cast<int>(std::floor((p.y + 0.5) / c)));
      most.x = std::max(most.x, static_cast<int>(std::floor((p.x + 0.5) / c)) + 1);
      most.y = std::max(most.y, static_cast<int>(std::floor((p.y + 0.5) / c)) + 1);
    }
    frame.cells = cv::Rect(least, most) & cv::Rect({0, 0}, layout.cells);
  }
  layout.view = ViewOfPlane(layout, view);
  return layout;
}

}  // namespace arthro::authoring
