#include "authoring/relief/make/make_relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Core>
#include <fmt/format.h>

#include "authoring/panorama/plain_picture.h"
#include "authoring/relief/make/finish_surface.h"
#include "authoring/relief/make/known_scale.h"
#include "authoring/relief/make/measure_relief.h"
#include "authoring/relief/make/relief_picture.h"
#include "authoring/relief/make/verdict.h"
#include "authoring/relief/motion/bundle/pose_covariance.h"
#include "simulation/core/error.h"
#include "simulation/core/option_fields.h"
#include "simulation/core/process_cost.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

std::vector<PosedFrame> FramesOf(const MeasuredRelief& made) {
  std::vector<PosedFrame> frames;
  const PoseSigmas sigmas = SigmasOf(made.tracks, made.lens, made.motion.scene);
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
            frame.rotation[3 * static_cast<std::size_t>(r) + static_cast<std::size_t>(c)] =
                pose->world_from_camera(r, c);
          frame.centre[static_cast<std::size_t>(r)] = pose->centre[r];
        }
        const PoseSigma sigma = sigmas.frames[used].value_or(PoseSigma{});
        if (made.has_pivot) frame.head_turn = made.pivot.head_turns[used];
        frame.sigma_m = kSharedErrors * sigma.centre;
        frame.sigma_rad = kSharedErrors * sigma.rotation;
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

// The closed surface where a frame sees it.
SweptSurface SeenSurface(const FinishedSurface& finished) {
  SweptSurface seen;
  seen.projection = finished.cells.projection;
  seen.radius = finished.closed.radius.clone();
  seen.radius.setTo(std::numeric_limits<float>::quiet_NaN(), ~finished.is_seen);
  return seen;
}

// The scale that makes the given lengths true; nothing where none is given.
std::optional<JoinedScale> ScaleFromLengths(const ReliefRequest& request,
                                            const MeasuredRelief& made,
                                            const FinishedSurface& finished,
                                            std::vector<ScalePart>& parts) {
  const SweptSurface seen = SeenSurface(finished);
  for (const KnownLength& length : request.lengths) parts.push_back(ScaleOf(length, seen));
  for (const KnownInstrument& instrument : request.instruments) {
    std::size_t used = 0;
    const CameraPose* pose = nullptr;
    for (const ClipRow& row : made.clip.rows) {
      if (!row.reason.empty()) continue;
      if (row.index == instrument.frame && made.motion.scene.poses[used])
        pose = &*made.motion.scene.poses[used];
      ++used;
    }
    if (!pose)
      throw Error(Code::kBadArgument,
                  fmt::format("frame {} has no pose, so that its instrument gives no scale; name a "
                              "frame that the report calls posed",
                              instrument.frame));
    parts.push_back(ScaleOf(instrument, made.clip.raw_lens, *pose, seen));
  }
  if (parts.empty()) return std::nullopt;
  return JoinScales(parts);
}

// Applies a scale to everything measured.
void ScaleBy(double scale, double least_parallax, MeasuredRelief& made, FinishedSurface& finished) {
  ChangeFrame(Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), scale, made.motion.scene);
  made.pivot.median_insertion *= scale;
  made.pivot.median_miss *= scale;
  made.surface.radius *= scale;
  made.surface.range *= scale;
  finished.confidence = ConfidenceOf(made.surface, made.lens.focal_px(), least_parallax);
  finished.closed.radius *= scale;
  finished.closed.sigma *= scale;
  for (SurfaceView& view : finished.views) view.centre *= static_cast<float>(scale);
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

ReliefSoFar SoFar(const Reconstruction& scene, bool is_in_portal_frame) {
  constexpr std::size_t kMostPoints = 1500;
  ReliefSoFar shown;
  shown.is_in_portal_frame = is_in_portal_frame;
  const auto plain = [](const Eigen::Vector3d& v) { return glm::dvec3(v.x(), v.y(), v.z()); };
  for (const auto& pose : scene.poses)
    if (pose) shown.cameras.push_back({plain(pose->centre), plain(pose->world_from_camera.col(2))});
  const std::size_t stride = scene.points.size() / kMostPoints + 1;
  for (std::size_t i = 0; i < scene.points.size(); i += stride)
    shown.points.push_back(plain(scene.points[i].position));
  return shown;
}

std::vector<PortalSlide> SlidesOf(const MeasuredRelief& made) {
  std::vector<PortalSlide> slides;
  if (!made.has_pivot) return slides;
  for (std::size_t i = 1; i < made.pivot.stretches.size(); ++i) {
    const PortalStretch& stretch = made.pivot.stretches[i];
    const Eigen::Vector3d shift = stretch.point - made.pivot.stretches[i - 1].point;
    slides.push_back({made.clip.frames[static_cast<std::size_t>(stretch.first)].index,
                      {shift.x(), shift.y(), shift.z()}});
  }
  return slides;
}

// Rings of one degree about the mean shaft, until half of the cells of a ring are confident.
double HoleAboutTheShaft(const SweptSurface& surface, const cv::Mat& confidence, double least) {
  constexpr int kMostRings = 60;
  std::array<int, kMostRings> seen{}, confident{};
  for (int y = 0; y < confidence.rows; ++y)
    for (int x = 0; x < confidence.cols; ++x) {
      if (!(surface.radius.at<float>(y, x) > 0)) continue;
      const double cosine = DirectionFromPixel(surface.projection, {x, y}).z;
      const double off = DegreesFromRadians(std::acos(std::clamp(cosine, -1.0, 1.0)));
      const auto ring = static_cast<std::size_t>(off);
      if (ring >= seen.size()) continue;
      ++seen[ring];
      confident[ring] += confidence.at<float>(y, x) >= least;
    }
  for (std::size_t ring = 0; ring < seen.size(); ++ring)
    if (seen[ring] > 0 && 2 * confident[ring] >= seen[ring])
      return RadiansFromDegrees(static_cast<double>(ring));
  return RadiansFromDegrees(kMostRings);
}

void DescribeLens(bool is_given, const MeasuredRelief& made, ReliefReport& report) {
  report.focal_factor = made.focal_factor;
  report.focal_sigma = made.focal_sigma;
  report.is_focal_changed = made.is_focal_changed;
  // A clip that is explained in part only is no judge of the lens.
  constexpr double kMostPosed = 0.9, kDoubtful = 0.02, kSure = 4;  // shares, standard errors
  const double focal = made.clip.raw_lens.focal_px, off = std::abs(made.focal_factor - 1);
  const auto posed =
      static_cast<double>(std::count_if(report.frames.begin(), report.frames.end(),
                                        [](const PosedFrame& frame) { return frame.is_posed; }));
  constexpr double kFound = 0.1;  // standard error, share of the focal length
  if (!is_given && !(made.focal_sigma > 0 && made.focal_sigma < kFound))
    report.warnings.push_back(
        fmt::format("no lens was given and the motion does not tell the focal length: {:.0f} px is "
                    "a guess; calibrate the scope with `arthroscene lens` and give --lens",
                    focal));
  else if (!is_given)
    report.warnings.push_back(fmt::format(
        "no lens was given: the focal length of {:.0f} px ± {:.1f} % was found from the clip; "
        "calibrate the scope with `arthroscene lens` and give --lens for exact shapes",
        focal, 100 * made.focal_sigma));
  else if (made.is_focal_changed)
    report.warnings.push_back(fmt::format(
        "the lens file does not suit the clip: its focal length was changed by {:+.1f} % to {:.1f} "
        "px ± {:.1f} %, which fits the motion; calibrate this scope again",
        100 * (made.focal_factor - 1), focal, 100 * made.focal_sigma));
  else if (posed >= kMostPosed * static_cast<double>(report.frames.size()) && off > kDoubtful &&
           off > kSure * made.focal_sigma)
    report.warnings.push_back(
        fmt::format("the motion suggests a focal length that differs by {:+.1f} ± {:.1f} % from "
                    "the lens file, and ranges may be off by as much; check the lens",
                    100 * (made.focal_factor - 1), 100 * made.focal_sigma));
}

// The closed surface as maps of relief over the sphere that just holds it.
void TakeMaps(const FinishedSurface& finished, bool keeps_closed, ReliefResult& result) {
  ReliefReport& report = result.report;
  const cv::Mat is_measured = finished.closed.origin == static_cast<int>(ReliefOrigin::kMeasured);
  const cv::Mat unknown = ~(keeps_closed ? finished.is_seen : finished.is_seen & is_measured);
  double largest = 0;
  cv::minMaxLoc(finished.closed.radius, nullptr, &largest, nullptr, nullptr, ~unknown);
  cv::Mat relief = largest - finished.closed.radius, sigma = finished.closed.sigma.clone(),
          origin = finished.closed.origin.clone();
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  relief.setTo(kUnknown, unknown);
  sigma.setTo(kUnknown, unknown);
  origin.setTo(0, unknown);
  result.relief = PlainMap(relief);
  result.sigma = PlainMap(sigma);
  result.confidence = PlainMap(finished.confidence);
  result.origin = OriginMap(origin.cols, origin.rows);
  std::array<int, 4> counts{};
  for (int y = 0; y < origin.rows; ++y)
    for (int x = 0; x < origin.cols; ++x) {
      const std::uint8_t number = origin.at<std::uint8_t>(y, x);
      result.origin.at(x, y) = static_cast<ReliefOrigin>(number);
      ++counts[number];
    }
  const double seen = std::max(1, counts[1] + counts[2] + counts[3]);
  report.measured_share = counts[1] / seen;
  report.brightness_share = counts[2] / seen;
  report.interpolated_share = counts[3] / seen;
  report.radius = largest;
  report.projection = finished.cells.projection;
  report.width = relief.cols;
  report.height = relief.rows;
}

}  // namespace

Projection EnlargedProjection(const Projection& projection, int factor) {
  Projection large = projection;
  large.px_per_deg *= factor;
  large.focal_px *= factor;
  large.centre_px = (projection.centre_px + 0.5) * static_cast<double>(factor) - 0.5;
  return large;
}

ReliefResult MakeRelief(const ReliefRequest& request, const Progress& progress,
                        const ReliefObserver& observer) {
  CheckOptions(request.options);
  const ReliefOptions& options = request.options;
  StageClock clock(progress, {{"read", 20},
                              {"prepare", 10},
                              {"tracks", 190},
                              {"poses", 110},
                              {"portal", 30},
                              {"sweep", 170},
                              {"close", 30},
                              {"panorama", request.draws_panorama ? 60 : 0}});
  ReliefResult result;
  ReliefReport& report = result.report;
  MeasuredRelief made = MeasureRelief(
      request.footage, request.lens, options, request.excluded,
      [&](const MeasuredRelief& so_far) {
        if (observer) observer(SoFar(so_far.motion.scene, true));
        report.verdict = JudgeMotion(so_far.motion);
        if (report.verdict.is_measured() && options.use_pivot && !so_far.has_pivot)
          report.verdict = JudgePivot(so_far.shaft_miss, so_far.pivot.shaft_spread);
        // A part of the clip may still be measured; a camera that only turned measures nothing.
        constexpr std::size_t kLeastToShow = 100;
        return report.verdict.is_measured() ||
               ((report.verdict.kind == "pieces" || report.verdict.kind == "texture" ||
                 report.verdict.kind == "ambiguous") &&
                so_far.motion.scene.points.size() >= kLeastToShow);
      },
      clock,
      [&](const Reconstruction& scene) {
        if (observer) observer(SoFar(scene, false));
      });

  FinishedSurface finished;
  if (!made.surface.radius.empty()) finished = FinishSurface(made, options, clock.Begin("close"));
  if (!finished.closed.radius.empty()) {
    if (const auto scale = ScaleFromLengths(request, made, finished, report.scale_parts)) {
      report.scale = scale->factor;
      report.scale_sigma = scale->sigma;
      report.scale_source =
          report.scale_parts.size() == 1 ? report.scale_parts.front().source : "joined";
      ScaleBy(scale->factor, options.least_parallax, made, finished);
    }
  }
  report.footage = request.footage.string();
  report.frames = FramesOf(made);
  report.points = static_cast<int>(made.motion.scene.points.size());
  report.rms_px = made.motion.rms_px;
  report.has_pivot = made.has_pivot;
  report.shaft_spread = made.pivot.shaft_spread;
  report.pivot_miss = made.pivot.median_miss;
  report.median_insertion = made.pivot.median_insertion;
  if (made.has_pivot) {
    report.head_turn = made.pivot.MedianHeadTurn(made.motion.scene.poses);
    report.head_wanders = made.pivot.head == HeadMotion::kWandering;
  }
  report.slides = SlidesOf(made);
  report.warnings = made.clip.warnings;
  DescribeLens(request.lens.has_value(), made, report);
  for (const PortalSlide& slide : report.slides)
    report.warnings.push_back(fmt::format(
        "the portal slid before frame {}; the poses before and after have a portal each",
        slide.frame));
  if (!made.has_pivot)
    report.warnings.push_back(
        "the shafts do not meet in one point, so that the place of the portal is assumed");
  if (report.scale_source == "assumed")
    report.warnings.push_back(
        "no length was given: shapes and ratios are measured, millimetres are assumed");

  if (!made.surface.radius.empty()) {
    Describe(finished.confidence, made.surface, options.least_confidence, report);
    report.hole = HoleAboutTheShaft(made.surface, finished.confidence, options.least_confidence);
    if (report.verdict.is_measured()) report.verdict = JudgeCoverage(report.coverage);
    if (!finished.closed.radius.empty()) {
      TakeMaps(finished, options.close, result);
      if (request.draws_panorama) {
        const ReliefPicture drawn =
            DrawOverRelief(request.footage, made, finished, options, clock.Begin("panorama"));
        result.picture = PlainPicture(drawn.rgba);
        result.picture_scale = drawn.scale;
        for (PosedFrame& frame : report.frames)
          if (const auto found = drawn.error_px.find(frame.index); found != drawn.error_px.end())
            frame.expected_error_px = found->second;
      }
    }
    clock.End();
  } else if (report.verdict.is_measured()) {
    report.verdict = JudgeCoverage(0);
  }
  report.verdict = JudgeTool(report.verdict, made.clip.tool_shares);
  report.stages = clock.costs();
  report.peak_memory_mb = PeakMemoryMb();
  report.options = OptionsText(options);
  return result;
}

}  // namespace arthro::authoring
