#include "authoring/panorama/assemble_report.h"

#include <algorithm>
#include <map>
#include <string>

#include <fmt/format.h>

namespace arthro::authoring {
namespace {

PinholeView PlainView(const RectifiedView& view) {
  return {view.width, view.height, view.focal_px, view.cx, view.cy};
}

void AddWarning(PanoramaReport& report, const std::string& sentence) {
  if (std::find(report.warnings.begin(), report.warnings.end(), sentence) == report.warnings.end())
    report.warnings.push_back(sentence);
}

std::string Summary(const PanoramaReport& report) {
  int placed = 0, usable = 0, elsewhere = 0;
  for (const FrameReport& frame : report.frames) {
    placed += frame.is_placed;
    usable += frame.is_usable;
    elsewhere += frame.is_usable && !frame.is_placed && frame.component > 0;
  }
  const int all = static_cast<int>(report.frames.size());
  std::string words =
      placed == usable
          ? fmt::format("all {} usable frames are in the panorama", usable)
          : fmt::format("partial: {} of {} usable frames are in the panorama", placed, usable);
  if (elsewhere > 0)
    words += fmt::format(", {} in {} separate piece{}", elsewhere, report.pieces.size(),
                         report.pieces.size() == 1 ? "" : "s");
  if (usable < all)
    words += fmt::format("; {} of the clip's {} frames were not used", all - usable, all);
  return words;
}

}  // namespace

PanoramaReport AssembleReport(const PreparedClip& clip, const std::vector<FrameResult>& placed,
                              const RegisterReport& registration,
                              const std::vector<ComposedPiece>& pieces,
                              const std::set<int>& excluded) {
  PanoramaReport report;
  const FootageLens& lens = clip.lens;
  report.lens = lens.lens;
  report.is_lens_guessed = lens.is_guessed;
  report.wanders_px = lens.wanders;
  report.rectified = PlainView(clip.view);
  report.drift_px = registration.drift_px;
  report.text_boxes = clip.text_boxes;
  // With a guessed pinhole the rectified picture is the whole raw picture, not the part inside the
  // round window.
  cv::Matx33d view_from_rectified = cv::Matx33d::eye();
  if (lens.is_guessed) {
    Lens& raw = report.lens;
    raw.width = clip.info.width;
    raw.height = clip.info.height;
    for (double* x : {&raw.cx, &raw.circle.cx}) *x += lens.part.x;
    for (double* y : {&raw.cy, &raw.circle.cy}) *y += lens.part.y;
    report.rectified = {raw.width, raw.height, clip.view.focal_px, raw.cx, raw.cy};
    view_from_rectified(0, 2) = clip.view.cx - raw.cx;
    view_from_rectified(1, 2) = clip.view.cy - raw.cy;
  }

  std::map<int, cv::Matx33d> composed_from_plane;
  for (const ComposedPiece& piece : pieces) {
    composed_from_plane[piece.component] = piece.composed.composed_from_panorama;
    if (piece.component == 0) report.panorama = PlainView(piece.composed.view);
  }
  report.frames = clip.reports;
  for (FrameReport& row : report.frames)
    if (row.is_usable && excluded.contains(row.index)) {
      row.is_usable = false;
      row.reason = "left out by hand";
    }
  for (const FrameResult& result : placed) {
    FrameReport& row = report.frames[static_cast<std::size_t>(result.index)];
    row.component = result.component;
    row.is_placed = result.is_placed && result.component == 0;
    row.inliers = result.inliers;
    row.rms_px = result.rms_px;
    row.expected_error_px = result.expected_error_px;
    row.reason = result.reason;
    if (result.component < 0) continue;
    cv::Matx33d h = result.panorama_from_rectified * view_from_rectified;
    if (const auto composed = composed_from_plane.find(result.component);
        composed != composed_from_plane.end())
      h = composed->second * h;
    h *= 1.0 / h(2, 2);
    std::copy(h.val, h.val + 9, row.panorama_from_rectified.begin());
    if (result.component > 0)
      row.reason = fmt::format("it belongs to piece {}, which does not join the panorama",
                               result.component + 1);
  }

  int count = 0;
  for (const FrameReport& row : report.frames) {
    if (!row.is_placed) continue;
    ++count;
    report.mean_error_px += row.expected_error_px;
    report.max_error_px = std::max(report.max_error_px, row.expected_error_px);
  }
  if (count > 0) report.mean_error_px /= count;
  for (const auto& [component, frames] : FramesByComponent(placed)) {
    if (component == 0) continue;
    PieceReport& row = report.pieces.emplace_back();
    row.component = component;
    row.frames = frames;
    for (const ComposedPiece& piece : pieces)
      if (piece.component == component) row.panorama = PlainView(piece.composed.view);
  }

  for (const auto& warning : clip.warnings) AddWarning(report, warning);
  for (const auto& warning : registration.warnings) AddWarning(report, warning);
  for (const ComposedPiece& piece : pieces)
    for (const FrameLeftOut& left_out : piece.report.left_out)
      AddWarning(report, fmt::format("frame {} is placed but not drawn: {}", left_out.index,
                                     left_out.reason));
  report.summary = Summary(report);
  report.is_partial = report.summary.starts_with("partial");
  return report;
}

}  // namespace arthro::authoring
