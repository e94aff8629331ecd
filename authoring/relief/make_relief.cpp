#include "authoring/relief/make_relief.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Core>
#include <fmt/format.h>

#include "authoring/relief/measure_relief.h"
#include "authoring/relief/verdict.h"
#include "simulation/core/error.h"
#include "simulation/core/option_fields.h"
#include "simulation/core/process_cost.h"

namespace arthro::authoring {
namespace {

std::vector<PosedFrame> FramesOf(const MeasuredRelief& made) {
  std::vector<PosedFrame> frames;
  std::size_t used = 0;
  for (const ClipRow& row : made.clip.rows) {
    PosedFrame frame;
    frame.index = row.index;
    frame.source = row.source;
    frame.reason = row.reason;
    if (row.reason.empty() && used < made.motion.frames.size()) {
      const MotionFrame& motion = made.motion.frames[used];
      frame.reason = motion.reason;
      frame.tracks = motion.tracks;
      frame.inliers = motion.inliers;
      frame.rms_px = motion.rms_px;
      if (const auto& pose = made.motion.scene.poses[used]) {
        frame.is_posed = true;
        for (int r = 0; r < 3; ++r) {
          for (int c = 0; c < 3; ++c)
            frame.rotation[static_cast<std::size_t>(3 * r + c)] = pose->world_from_camera(r, c);
          frame.centre[static_cast<std::size_t>(r)] = pose->centre[r];
        }
        const PoseSigma sigma = SigmaOf(made.tracks, made.lens, made.motion.scene,
                                        static_cast<int>(used), frame.rms_px);
        frame.sigma_m = sigma.centre;
        frame.sigma_rad = sigma.rotation;
      }
      ++used;
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

DepthMap PlainMap(const cv::Mat& values) {
  DepthMap map(values.cols, values.rows);
  for (int y = 0; y < values.rows; ++y)
    std::copy_n(values.ptr<float>(y), values.cols,
                &map.relief[static_cast<std::size_t>(y) * static_cast<std::size_t>(values.cols)]);
  return map;
}

// Point of the surface at a pixel of the relief.
Eigen::Vector3d PointAt(const SweptSurface& surface, const glm::dvec2& pixel) {
  const int x = static_cast<int>(std::lround(pixel.x)), y = static_cast<int>(std::lround(pixel.y));
  const bool is_inside = x >= 0 && y >= 0 && x < surface.radius.cols && y < surface.radius.rows;
  const float radius = is_inside ? surface.radius.at<float>(y, x) : 0;
  if (!(radius > 0))
    throw Error(Code::kBadArgument,
                fmt::format("nothing was measured at pixel {:g},{:g} of the relief of {} x {} px; "
                            "name two pixels that have a value",
                            pixel.x, pixel.y, surface.radius.cols, surface.radius.rows));
  const glm::dvec3 d = DirectionFromPixel(surface.projection, pixel);
  return Eigen::Vector3d(d.x, d.y, d.z) * static_cast<double>(radius);
}

// The scale that makes the given distance true; applied to everything measured.
double ScaleFromLength(const KnownLength& length, const SweptSurface& surface) {
  const double distance = (PointAt(surface, length.from) - PointAt(surface, length.to)).norm();
  if (!(distance > 0))
    throw Error(Code::kBadArgument, "the two pixels of a known length must differ");
  return length.metres / distance;
}

void Describe(const cv::Mat& confidence, const SweptSurface& surface, double least,
              ReliefReport& report) {
  int seen = 0, confident = 0;
  for (int y = 0; y < confidence.rows; ++y)
    for (int x = 0; x < confidence.cols; ++x) {
      if (!(surface.radius.at<float>(y, x) > 0)) continue;
      const float c = confidence.at<float>(y, x);
      ++seen;
      confident += c >= least;
      ++report.confidence_histogram[static_cast<std::size_t>(std::clamp(10 * c, 0.0f, 9.0f))];
    }
  report.coverage = static_cast<double>(confident) / std::max(1, seen);
}

}  // namespace

ReliefResult MakeRelief(const ReliefRequest& request, const Progress& progress) {
  CheckOptions(request.options);
  const ReliefOptions& options = request.options;
  StageClock clock(progress, {{"read", 20},
                              {"prepare", 10},
                              {"tracks", 190},
                              {"poses", 110},
                              {"portal", 30},
                              {"sweep", 170}});
  ReliefResult result;
  ReliefReport& report = result.report;
  MeasuredRelief made = MeasureRelief(
      request.footage, request.lens, options,
      [&](const MeasuredRelief& so_far) {
        report.verdict = JudgeMotion(so_far.motion);
        if (report.verdict.is_measured() && options.use_pivot && !so_far.has_pivot)
          report.verdict = JudgePivot(so_far.shaft_miss, so_far.pivot.shaft_spread);
        // A part of the clip may still be measured; a camera that only turned measures nothing.
        constexpr std::size_t kLeastPoints = 100;
        return report.verdict.is_measured() ||
               ((report.verdict.kind == "pieces" || report.verdict.kind == "texture") &&
                so_far.motion.scene.points.size() >= kLeastPoints);
      },
      clock);

  SweptSurface& surface = made.surface;
  if (request.length && !surface.radius.empty()) {
    const double scale = ScaleFromLength(*request.length, surface);
    report.scale = scale;
    report.scale_source = "length";
    ChangeFrame(Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), scale, made.motion.scene);
    surface.radius *= scale;
    made.pivot.median_insertion *= scale;
    made.pivot.median_miss *= scale;
  }
  report.footage = request.footage.string();
  report.frames = FramesOf(made);
  report.points = static_cast<int>(made.motion.scene.points.size());
  report.rms_px = made.motion.rms_px;
  report.has_pivot = made.has_pivot;
  report.shaft_spread = made.pivot.shaft_spread;
  report.pivot_miss = made.pivot.median_miss;
  report.median_insertion = made.pivot.median_insertion;
  report.head_turn = made.pivot.head_turn;
  report.warnings = made.clip.warnings;
  if (!made.has_pivot)
    report.warnings.push_back(
        "the shafts do not meet in one point, so that the place of the portal is assumed");
  if (report.scale_source == "assumed")
    report.warnings.push_back(
        "no length was given: shapes and ratios are measured, millimetres are assumed");

  if (!surface.radius.empty()) {
    const cv::Mat confidence = ConfidenceOf(surface, options.least_parallax);
    Describe(confidence, surface, options.least_confidence, report);
    if (report.verdict.is_measured()) report.verdict = JudgeCoverage(report.coverage);
    const cv::Mat unknown = ~(confidence >= options.least_confidence);
    // The sphere just holds what is known.
    double largest = 0;
    for (int y = 0; y < unknown.rows; ++y)
      for (int x = 0; x < unknown.cols; ++x)
        if (!unknown.at<std::uint8_t>(y, x))
          largest = std::max<double>(largest, surface.radius.at<float>(y, x));
    report.radius = largest;
    cv::Mat relief = largest - surface.radius;
    relief.setTo(std::numeric_limits<float>::quiet_NaN(), unknown);
    result.relief = PlainMap(relief);
    result.confidence = PlainMap(confidence);
    report.projection = surface.projection;
    report.width = relief.cols;
    report.height = relief.rows;
  } else if (report.verdict.is_measured()) {
    report.verdict = JudgeCoverage(0);
  }
  report.stages = clock.costs();
  report.peak_memory_mb = PeakMemoryMb();
  report.options = OptionsText(options);
  return result;
}

}  // namespace arthro::authoring
