#include "authoring/panorama/known_places.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "simulation/core/error.h"

namespace arthro::authoring {
namespace {

// The report's rectified picture is the whole raw one where the lens was guessed
// (assemble_report.cpp).
cv::Matx33d ReportedFromView(const PanoramaReport& known, const PreparedClip& clip) {
  cv::Matx33d move = cv::Matx33d::eye();
  if (!known.is_lens_guessed) return move;
  move(0, 2) = known.rectified.cx - clip.view.cx;
  move(1, 2) = known.rectified.cy - clip.view.cy;
  return move;
}

}  // namespace

std::vector<FrameResult> KnownPlaces(const PanoramaReport& known, const PreparedClip& clip,
                                     const std::set<int>& excluded) {
  if (known.over_relief)
    throw Error(Code::kBadData,
                "the report is of a panorama over a relief, whose frames have no places in one "
                "plane; make the panorama with --relief no");
  if (known.frames.size() != clip.reports.size())
    throw Error(Code::kBadData,
                fmt::format("the report has {} frames and the footage {}; give the report of this "
                            "footage with the same --every",
                            known.frames.size(), clip.reports.size()));
  constexpr double kSameFocal = 1e-6;  // share; a report keeps all digits
  if (std::abs(known.rectified.focal_px - clip.view.focal_px) > kSameFocal * clip.view.focal_px)
    throw Error(Code::kBadData,
                fmt::format("the report is of a rectified picture with a focal length of {:.1f} "
                            "px, and these options give {:.1f} px; give the lens and options of "
                            "the report",
                            known.rectified.focal_px, clip.view.focal_px));
  const cv::Matx33d reported_from_view = ReportedFromView(known, clip);
  std::vector<FrameResult> places;
  for (const FrameReport& row : clip.reports) {
    if (!row.is_usable || excluded.contains(row.index)) continue;
    const FrameReport& before = known.frames[static_cast<std::size_t>(row.index)];
    FrameResult& place = places.emplace_back();
    place.index = row.index;
    const bool is_tied = std::any_of(known.tied.begin(), known.tied.end(),
                                     [&](const TiedFrame& t) { return t.index == row.index; });
    place.component = is_tied ? -1 : before.component;
    place.is_placed = place.component >= 0;
    if (!place.is_placed) {
      place.reason = is_tied ? "it was tied in by hand before" : before.reason;
      continue;
    }
    place.panorama_from_rectified =
        cv::Matx33d(before.panorama_from_rectified.data()) * reported_from_view;
    place.inliers = before.inliers;
    place.rms_px = before.rms_px;
    place.expected_error_px = before.expected_error_px;
  }
  return places;
}

}  // namespace arthro::authoring
