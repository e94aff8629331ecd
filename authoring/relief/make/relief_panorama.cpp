#include "authoring/relief/make/relief_panorama.h"

#include <algorithm>

#include <fmt/format.h>

#include "simulation/core/units.h"

namespace arthro::authoring {

PanoramaResult PanoramaFromRelief(const ReliefResult& relief, const Lens& lens) {
  const ReliefReport& from = relief.report;
  PanoramaResult result;
  result.picture = relief.picture;
  PanoramaReport& report = result.report;
  report.footage = from.footage;
  report.lens = lens;
  report.panorama.width = relief.picture.width;
  report.panorama.height = relief.picture.height;
  report.over_relief = EnlargedProjection(from.projection, relief.picture_scale);
  report.relief_radius = from.radius;
  report.detector = "relief";
  report.warnings = from.warnings;
  report.stages = from.stages;
  report.peak_memory_mb = from.peak_memory_mb;
  report.options = from.options;
  int placed = 0;
  double sum = 0;
  for (const PosedFrame& frame : from.frames) {
    FrameReport row;
    row.index = frame.index;
    row.source = frame.source;
    row.is_placed = frame.is_posed;
    row.is_usable = frame.is_posed || frame.tracks > 0;
    row.reason = frame.reason;
    row.component = frame.is_posed ? 0 : -1;
    row.inliers = frame.inliers;
    row.rms_px = frame.rms_px;
    row.expected_error_px = frame.expected_error_px;
    report.frames.push_back(row);
    if (!frame.is_posed) continue;
    ++placed;
    sum += frame.expected_error_px;
    report.max_error_px = std::max(report.max_error_px, frame.expected_error_px);
  }
  report.mean_error_px = sum / std::max(1, placed);
  report.summary = fmt::format(
      "{} of {} frames over a measured relief; {:.0f} % of the tissue in view was measured", placed,
      from.frames.size(), 100 * from.measured_share);
  return result;
}

double ExpectedErrorAngle(const PanoramaReport& report) {
  const double px_per_rad = report.over_relief
                                ? report.over_relief->px_per_deg * DegreesFromRadians(1)
                                : report.rectified.focal_px;
  return px_per_rad > 0 ? report.mean_error_px / px_per_rad : 0;
}

}  // namespace arthro::authoring
