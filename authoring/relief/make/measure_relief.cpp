#include "authoring/relief/make/measure_relief.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "authoring/relief/median.h"
#include "authoring/relief/motion/frame_inliers.h"
#include "authoring/relief/motion/growth.h"
#include "authoring/relief/motion/self_calibration.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

constexpr double kMostMiss = 0.1;        // share of the insertion, for the shafts to pass one point
constexpr double kLeastSpread = 0.0349;  // rad (2°) of the shafts' directions
constexpr double kPivotSigma = 0.03;     // share of the insertion, by which the skin gives
constexpr double kMostRise = 1.05;       // factor by which the pivot may raise the pixel residual
constexpr std::size_t kLeastCalibrating = 100;  // points that a focal length rests on
// Insertion over the range to the tissue, where no portal was found.
constexpr double kUsualInsertion = 0.7;

// Adjusts everything with the portal as a soft constraint and keeps that if the pixels agree.
bool AdoptPivot(const std::vector<Track>& tracks, const LensProfile& lens,
                const ReliefOptions& options, const Progress& progress, Motion& motion,
                PivotFit& pivot) {
  pivot = FindPivot(motion.scene.poses, options.view_angle, !options.find_head_turn);
  const auto is_good = [&] {
    return pivot.median_insertion > 0 && pivot.shaft_spread > kLeastSpread &&
           pivot.median_miss < kMostMiss * pivot.median_insertion;
  };
  if (!is_good()) return false;
  Reconstruction scene = motion.scene;
  double rms = 0;
  PivotFit fit = pivot;
  for (int round = 0; round < 2; ++round) {
    PivotPrior prior;
    for (const PortalStretch& stretch : fit.stretches) prior.points.push_back(stretch.point);
    for (std::size_t f = 0; f < scene.poses.size(); ++f) {
      const auto later =
          std::count_if(fit.stretches.begin(), fit.stretches.end(),
                        [&](const PortalStretch& s) { return s.first <= static_cast<int>(f); });
      prior.point_of.push_back(std::max(0, static_cast<int>(later) - 1));
    }
    prior.head_turns = fit.head_turns;
    prior.head_wanders = fit.head == HeadMotion::kWandering;
    prior.view_angle = options.view_angle;
    prior.sigma = std::max(kPivotSigma * fit.median_insertion, fit.median_miss);
    progress.Step("finding the portal", 0.4 * round);
    rms = AdjustBundle(tracks, lens, {.iterations = 25, .stop = progress.stop}, scene, &prior);
    progress.Step("finding the portal", 0.4 * (round + 1));
    RefreshPoints(tracks, lens, scene);
    fit.head_turns = prior.head_turns;
    for (std::size_t i = 0; i < fit.stretches.size(); ++i) fit.stretches[i].point = prior.points[i];
    MeasurePivot(scene.poses, options.view_angle, fit);
  }
  if (rms > kMostRise * motion.rms_px) return false;
  pivot = fit;
  if (!is_good()) return false;
  motion.scene = std::move(scene);
  motion.rms_px = rms;
  return true;
}

// Checks the lens against the clip, and puts the clip's focal length in its place where the two
// disagree clearly. Without a given lens the poses are found anew with each focal length.
void CalibrateFocal(bool is_guessed, const Progress& progress, MeasuredRelief& made) {
  constexpr double kMoves = 0.02, kFalls = 0.10;  // focal length, residual
  constexpr int kRounds = 3;
  const int frames = static_cast<int>(made.clip.frames.size());
  for (int round = 0; round < (is_guessed ? kRounds : 1); ++round) {
    if (made.motion.scene.points.size() < kLeastCalibrating) return;
    progress.Step("checking the lens", 0.1 + 0.2 * round);
    FocalFit fit = FitFocal(made.tracks, made.clip.lens, made.motion, progress.stop);
    const bool is_far = std::abs(fit.factor - 1) > kMoves;
    made.focal_factor *= fit.factor;
    made.focal_sigma = fit.sigma;
    if (!is_guessed && !(is_far && fit.rms_px < (1 - kFalls) * fit.rms_before_px)) return;
    made.is_focal_changed = true;
    made.clip.raw_lens = WithFocal(made.clip.raw_lens, fit.factor);
    made.clip.lens = WithFocal(made.clip.lens, fit.factor);
    made.lens = LensProfile(made.clip.lens);
    ChangeLens(made.clip.lens, made.tracks);
    if (is_guessed && is_far) {
      made.motion = SolveMotion(made.tracks, frames, made.lens, progress);
      continue;
    }
    made.motion.scene = std::move(fit.scene);
    RefreshPoints(made.tracks, made.lens, made.motion.scene);
    made.motion.rms_px =
        AdjustBundle(made.tracks, made.lens, {.iterations = 15, .stop = progress.stop},
                     made.motion.scene, nullptr);
    CountInliers(made.tracks, made.lens, made.motion);
    return;
  }
}

// The portal of most posed frames.
Eigen::Vector3d LongestStretch(const std::vector<std::optional<CameraPose>>& poses,
                               const PivotFit& pivot) {
  std::size_t best = 0;
  int most = -1;
  for (std::size_t s = 0; s < pivot.stretches.size(); ++s) {
    const int last = s + 1 < pivot.stretches.size() ? pivot.stretches[s + 1].first
                                                    : static_cast<int>(poses.size());
    int count = 0;
    for (int f = pivot.stretches[s].first; f < last; ++f)
      count += poses[static_cast<std::size_t>(f)].has_value();
    if (count > most) most = count, best = s;
  }
  return pivot.stretches[best].point;
}

// To the portal frame, with the median insertion as assumed.
void GoToPortal(const ReliefOptions& options, MeasuredRelief& made) {
  Reconstruction& scene = made.motion.scene;
  const Eigen::Matrix3d axes =
      PortalAxes(scene.poses, options.view_angle,
                 made.has_pivot ? made.pivot.head_turns : std::vector<double>());
  Eigen::Vector3d origin = LongestStretch(scene.poses, made.pivot);
  double insertion = made.pivot.median_insertion;
  if (!made.has_pivot) {
    // Behind the middle of the tips, as far as is usual for the range that they see.
    std::vector<double> ranges;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    int count = 0;
    for (std::size_t f = 0; f < scene.poses.size(); ++f)
      if (scene.poses[f]) middle += scene.poses[f]->centre, ++count;
    for (const TrackPoint& point : scene.points) {
      const Track& track = made.tracks[static_cast<std::size_t>(point.track)];
      for (std::size_t k = 0; k < track.seen.size(); ++k)
        if (const auto& pose = scene.poses[static_cast<std::size_t>(track.seen[k].frame)];
            pose && point.uses[k])
          ranges.push_back((point.position - pose->centre).norm());
    }
    insertion = kUsualInsertion * Median(ranges);
    origin = middle / std::max(1, count) - axes.row(2).transpose() * insertion;
  }
  const double scale = insertion > 0 ? options.insertion / insertion : 1;
  ChangeFrame(axes, origin, scale, scene);
  made.pivot.median_insertion = scale * insertion;
  made.pivot.median_miss *= scale;
  for (PortalStretch& stretch : made.pivot.stretches)
    stretch.point = scale * (axes * (stretch.point - origin));
}

}  // namespace

MeasuredRelief MeasureRelief(const std::filesystem::path& footage, const std::optional<Lens>& lens,
                             const ReliefOptions& options, const std::set<int>& excluded,
                             const AfterMotion& after_motion, StageClock& clock,
                             const MotionObserver& observer) {
  MeasuredRelief made;
  made.clip = ReadReliefClip(footage, lens, options, excluded, clock);
  made.lens = LensProfile(made.clip.lens);
  const int frames = static_cast<int>(made.clip.frames.size());
  made.tracks = FollowPoints(made.clip.frames, made.clip.lens, options, clock.Begin("tracks"));
  made.motion = SolveMotion(made.tracks, frames, made.lens, clock.Begin("poses"), observer);
  const Progress adjusting = clock.Begin("portal");
  CalibrateFocal(!lens, adjusting, made);
  if (made.motion.scene.points.size() >= 3) {
    if (options.use_pivot)
      made.has_pivot =
          AdoptPivot(made.tracks, made.lens, options, adjusting, made.motion, made.pivot);
    made.shaft_miss = made.pivot.median_insertion > 0
                          ? std::min(1.0, made.pivot.median_miss / made.pivot.median_insertion)
                          : 1;
    CountInliers(made.tracks, made.lens, made.motion);
    adjusting.Step("placing the portal", 0.9);
    GoToPortal(options, made);
  }
  if (after_motion && !after_motion(made)) {
    clock.End();
    return made;
  }
  made.surface =
      SweepSurface(made.clip.frames, made.lens, made.motion.scene, options, clock.Begin("sweep"));
  clock.End();
  return made;
}

namespace {

// Change of the radius that moves a match by a pixel across the widest pair of rays.
double MatchErrorOf(const SweptSurface& surface, double focal_px, int y, int x) {
  constexpr double kLeastAngle = 1e-3;  // rad
  const double angle = std::max<double>(surface.parallax.at<float>(y, x), kLeastAngle);
  return surface.range.at<float>(y, x) / (focal_px * angle);
}

}  // namespace

cv::Mat ConfidenceOf(const SweptSurface& surface, double focal_px, double least_parallax) {
  // Logistic regression of "within 1 mm" on cells of six cavity clips with known truth: easy,
  // medium and hard, seeds 11 to 16. Judged on clips of seeds from 300 up.
  constexpr double kConstant = -5.79, kAgreement = 5.32, kPeak = 3.16, kMargin = -7.85,
                   kMatchError = -0.85, kSteadiness = 2.10, kSeenBy = 0.61, kRange = -1.22;
  cv::Mat confidence = cv::Mat::zeros(surface.radius.size(), CV_32F);
  for (int y = 0; y < confidence.rows; ++y)
    for (int x = 0; x < confidence.cols; ++x) {
      if (!(surface.radius.at<float>(y, x) > 0) || !(surface.agreement.at<float>(y, x) > 0) ||
          surface.parallax.at<float>(y, x) < least_parallax)
        continue;
      const double sum =
          kConstant + kAgreement * surface.agreement.at<float>(y, x) +
          kPeak * surface.peak.at<float>(y, x) +
          kMargin * std::clamp<double>(surface.margin.at<float>(y, x), -0.1, 0.2) +
          kMatchError *
              std::log(std::max(0.05, MmFromMetres(MatchErrorOf(surface, focal_px, y, x)))) +
          kSteadiness * surface.steadiness.at<float>(y, x) +
          kSeenBy * std::log(std::max<double>(1, surface.seen_by.at<float>(y, x))) +
          kRange * std::log(std::max(1.0, MmFromMetres(surface.range.at<float>(y, x))));
      confidence.at<float>(y, x) = static_cast<float>(1 / (1 + std::exp(-sum)));
    }
  return confidence;
}

cv::Mat SigmaOfMeasured(const SweptSurface& surface, double focal_px) {
  // Regression of the logarithm of the error, in mm, on the cells of the same clips whose
  // confidence is above one half; the constant makes 68 % of the errors smaller.
  constexpr double kConstant = 6.13, kAgreement = -3.43, kPeak = -3.04, kMatchError = 0.77;
  constexpr double kMost = 5;  // mm
  cv::Mat sigma(surface.radius.size(), CV_32F, cv::Scalar(std::numeric_limits<float>::quiet_NaN()));
  for (int y = 0; y < sigma.rows; ++y)
    for (int x = 0; x < sigma.cols; ++x) {
      if (!(surface.radius.at<float>(y, x) > 0)) continue;
      const double error = MmFromMetres(MatchErrorOf(surface, focal_px, y, x));
      const double logarithm = kConstant + kAgreement * surface.agreement.at<float>(y, x) +
                               kPeak * surface.peak.at<float>(y, x) +
                               kMatchError * std::log(std::max(error, 0.01));
      sigma.at<float>(y, x) =
          static_cast<float>(MetresFromMm(std::min(kMost, std::exp(logarithm))));
    }
  return sigma;
}

}  // namespace arthro::authoring
