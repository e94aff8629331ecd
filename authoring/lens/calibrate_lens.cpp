#include "authoring/lens/calibrate_lens.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "simulation/core/error.h"
#include "simulation/core/option_fields.h"
#include "simulation/core/process_cost.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

constexpr double kClearlyBetter = 0.95;  // share of the residual; a better model must stay below it
constexpr double kPaysWell =
    0.5;                          // the same, when a model is judged by the points it was fitted to
constexpr double kAsGood = 1.05;  // ratio of residuals; up to it two models are indistinguishable
constexpr double kRimShare = 0.95;  // share of the rim's radius; the picture is cut beyond it
constexpr double kSigmas = 3;
constexpr double kHopeless = 0.10;  // rim error over rim radius; a lens beyond it is not written

struct Candidate {
  LensFit fit;
  ModelTrial trial;
};

// Residual of each view under a lens that was fitted without it.
double CrossValidated(const std::vector<TargetView>& views, const LensFit& fit,
                      const FitOptions& options) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t v = 0; v < views.size(); ++v) {
    std::vector<TargetView> others = views;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(v));
    LensFit start = fit;
    start.poses.erase(start.poses.begin() + static_cast<std::ptrdiff_t>(v));
    const LensFit part = FitLens(others, fit.lens.model, start, options);
    const double rms = HeldOutRms({views[v]}, part);
    sum += rms * rms * static_cast<double>(views[v].points.size());
    count += views[v].points.size();
  }
  return std::sqrt(sum / static_cast<double>(count));
}

std::vector<FitModel> ModelsFor(ModelChoice choice) {
  switch (choice) {
    case ModelChoice::kAuto:
      return {FitModel::kEquisolid, FitModel::kEquidistant, FitModel::kPinhole,
              FitModel::kDoubleSphere, FitModel::kKannalaBrandt};
    case ModelChoice::kEquisolid:
      return {FitModel::kEquisolid};
    case ModelChoice::kKannalaBrandt:
      return {FitModel::kEquidistant, FitModel::kKannalaBrandt};
    case ModelChoice::kDoubleSphere:
      return {FitModel::kDoubleSphere};
    case ModelChoice::kPinhole:
      return {FitModel::kPinhole};
  }
  return {};
}

// One calibration, in steps; `result_` grows with them.
class Calibration {
 public:
  Calibration(const std::vector<TargetView>& views, cv::Size picture, const LensCircle& circle,
              double spacing, const CalibrateOptions& options, const Progress& progress)
      : picture_(picture),
        circle_(circle),
        spacing_(spacing),
        options_(options),
        progress_(progress) {
    fit_options_.aspect = options.aspect;
    for (const TargetView& view : views) {
      ViewReport report;
      report.target = view;
      result_.views.push_back(report);
      if (view.kind == TargetKind::kNone) continue;
      used_.push_back(view);
      place_.push_back(result_.views.size() - 1);
    }
    // Without a round window the nearer edge of the picture replaces the rim.
    result_.rim_radius_px = circle.r > 0 ? circle.r : 0.5 * std::min(picture.width, picture.height);
  }

  LensCalibration Run() {
    if (used_.empty()) return Refuse("no picture shows a calibration target");
    const cv::Point2d centre =
        circle_.r > 0 ? cv::Point2d(circle_.cx, circle_.cy)
                      : cv::Point2d(0.5 * (picture_.width - 1), 0.5 * (picture_.height - 1));
    progress_.Step("fitting the lens", 0);
    const double before = ProcessCpuMs();
    auto start = StartFit(used_, picture_, centre, result_.rim_radius_px);
    const double start_ms = ProcessCpuMs() - before;
    if (!start) return Refuse("the points found fit a flat target under no lens");
    LeaveOutWrongPoints(*start);
    TryModels(*start);
    const Candidate* best = Choose();
    if (!best) return Refuse("no lens model could be fitted to the points found");
    result_.fit_ms = start_ms + TimeOf(best->trial.model, *start);
    Describe(*best);
    Judge(*best);
    return result_;
  }

 private:
  LensCalibration Refuse(const std::string& sentence) {
    result_.verdict = LensVerdict::kRefused;
    result_.sentences.insert(result_.sentences.begin(), sentence);
    return result_;
  }

  // Removes points that even the better of two unlike models cannot explain: they are counted
  // wrongly or lie on a highlight. This happens before models are compared, so that all models see
  // the same points.
  void LeaveOutWrongPoints(LensFit& start) {
    constexpr double kFarOff = 8;  // times the fit's residual; a poor model must not cost points
    std::optional<LensFit> better;
    for (const FitModel model : {FitModel::kEquisolid, FitModel::kKannalaBrandt}) {
      LensFit fit = FitLens(used_, model, start, fit_options_);
      if (!fit.converged || fit.points_used < 9) continue;
      if (!better || fit.rms_px * fit.points_left_out + fit.rms_px <
                         better->rms_px * better->points_left_out + better->rms_px)
        better = fit;
    }
    if (!better) return;
    const double limit = std::max(1.0, kFarOff * better->rms_px);
    for (std::size_t v = 0; v < used_.size(); ++v) {
      const std::vector<double> sizes = ResidualsOf(used_[v], *better, v);
      std::vector<LatticePoint> kept;
      for (std::size_t n = 0; n < sizes.size(); ++n)
        if (sizes[n] <= limit) kept.push_back(used_[v].points[n]);
      result_.views[place_[v]].points_left_out =
          static_cast<int>(used_[v].points.size() - kept.size());
      result_.points_left_out += result_.views[place_[v]].points_left_out;
      used_[v].points = kept;
    }
    for (std::size_t v = used_.size(); v-- > 0;) {
      if (used_[v].points.size() >= 9) continue;
      ViewReport& report = result_.views[place_[v]];
      report.target.kind = TargetKind::kNone;
      report.target.reason = "its points do not agree with those of the other pictures";
      used_.erase(used_.begin() + static_cast<std::ptrdiff_t>(v));
      place_.erase(place_.begin() + static_cast<std::ptrdiff_t>(v));
      start.poses.erase(start.poses.begin() + static_cast<std::ptrdiff_t>(v));
      better->poses.erase(better->poses.begin() + static_cast<std::ptrdiff_t>(v));
    }
    start.poses = better->poses;
  }

  std::vector<double> ResidualsOf(const TargetView& view, const LensFit& fit, std::size_t v) const {
    std::vector<double> sizes;
    for (const LatticePoint& point : view.points) sizes.push_back(ResidualOf(fit, v, point));
    return sizes;
  }

  void TryModels(const LensFit& start) {
    const std::vector<FitModel> all = {FitModel::kEquisolid,     FitModel::kEquidistant,
                                       FitModel::kStereographic, FitModel::kPinhole,
                                       FitModel::kDoubleSphere,  FitModel::kKannalaBrandt};
    for (std::size_t n = 0; n < all.size(); ++n) {
      progress_.Step("fitting the lens", static_cast<double>(n) / static_cast<double>(all.size()));
      Candidate candidate;
      candidate.fit = FitLens(used_, all[n], start, fit_options_);
      ModelTrial& trial = candidate.trial;
      trial.model = all[n];
      trial.parameters = candidate.fit.parameters;
      trial.fitted = candidate.fit.converged && std::isfinite(candidate.fit.rms_px) &&
                     candidate.fit.points_used * 2 > candidate.fit.parameters;
      // All points count here, including outliers of this model.
      trial.rms_px = trial.fitted ? WholeRms(candidate.fit) : 0;
      trial.held_out_px = trial.rms_px;
      if (trial.fitted && used_.size() >= 3)
        trial.held_out_px = CrossValidated(used_, candidate.fit, fit_options_);
      trial.fitted = trial.fitted && std::isfinite(trial.held_out_px);
      candidates_.push_back(candidate);
      result_.trials.push_back(trial);
    }
  }

  double WholeRms(const LensFit& fit) const {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t v = 0; v < used_.size(); ++v)
      for (const LatticePoint& point : used_[v].points) {
        sum += std::pow(std::min(ResidualOf(fit, v, point), 100.0), 2);
        ++count;
      }
    return std::sqrt(sum / static_cast<double>(count));
  }

  const Candidate* Find(FitModel model) const {
    for (const Candidate& candidate : candidates_)
      if (candidate.trial.model == model && candidate.trial.fitted) return &candidate;
    return nullptr;
  }

  // Models come in the order of ModelsFor, by growing freedom, the paper's model first. A later
  // model is taken when it is clearly better than the one before.
  const Candidate* Choose() {
    const Candidate* best = nullptr;
    for (const FitModel model : ModelsFor(options_.model)) {
      const Candidate* other = Find(model);
      if (!other) continue;
      // Without held-out pictures more freedom always fits better, so the gain must be large.
      const bool is_richer = best && other->trial.parameters > best->trial.parameters;
      const double needed = is_richer && used_.size() < 3 ? kPaysWell : kClearlyBetter;
      if (!best || other->trial.held_out_px < needed * best->trial.held_out_px) best = other;
    }
    const Candidate* paper = Find(FitModel::kEquisolid);
    const double noise = 0.05;  // px; corners are not known more exactly
    for (const Candidate& other : candidates_)
      if (paper && other.trial.fitted &&
          other.trial.held_out_px + noise < kClearlyBetter * paper->trial.held_out_px)
        result_.is_paper_model_refuted = true;
    return best;
  }

  double TimeOf(FitModel model, const LensFit& start) const {
    const double before = ProcessCpuMs();
    FitLens(used_, model, start, fit_options_);
    return ProcessCpuMs() - before;
  }

  void Describe(const Candidate& best) {
    const LensFit& fit = best.fit;
    result_.model = best.trial.model;
    result_.lens = fit.lens.AsLens(picture_);
    result_.lens.circle = circle_;
    result_.lens.rms_px = fit.rms_px;
    result_.points = fit.points_used;
    if (fit.covariance.rows() > 2) {
      result_.focal_sigma_px = std::sqrt(std::max(0.0, fit.covariance(0, 0)));
      result_.centre_sigma_px =
          std::sqrt(std::max({0.0, fit.covariance(1, 1), fit.covariance(2, 2)}));
    }
    for (std::size_t v = 0; v < used_.size(); ++v) {
      double sum = 0;
      cv::Point2d middle(0, 0);
      for (const LatticePoint& point : used_[v].points) {
        sum += std::pow(ResidualOf(fit, v, point), 2);
        middle += cv::Point2d(point.i, point.j);
        result_.covered_radius_px =
            std::max(result_.covered_radius_px,
                     std::hypot(point.pixel.x - fit.lens.cx, point.pixel.y - fit.lens.cy));
      }
      const double count = static_cast<double>(used_[v].points.size());
      ViewReport& report = result_.views[place_[v]];
      report.rms_px = std::sqrt(sum / count);
      const glm::dvec3 w(fit.poses[v][0], fit.poses[v][1], fit.poses[v][2]);
      const glm::dvec3 across = TurnedBy(w, {middle.x / count, middle.y / count, 0});
      const glm::dvec3 at = across + glm::dvec3(fit.poses[v][3], fit.poses[v][4], fit.poses[v][5]);
      report.distance = glm::length(at) * spacing_;
      report.tilt = std::acos(std::clamp(std::abs(TurnedBy(w, {0, 0, 1}).z), 0.0, 1.0));
    }
    const auto whole = FieldOfViewOf(result_.lens);
    result_.lens.field_of_view =
        whole ? *whole : 2 * AngleFromRadius(result_.lens, result_.covered_radius_px).value_or(0);
    result_.rim_error_px = RimError(best);
  }

  // Largest of three uncertainties up to the rim: the noise of the fit, a systematic error of the
  // corners, and the difference from an equally good model.
  double RimError(const Candidate& best) const {
    const Lens& lens = result_.lens;
    const auto rim = AngleFromRadius(lens, kRimShare * result_.rim_radius_px);
    const double reach = rim ? *rim : 0.5 * lens.field_of_view;
    double worst = 0;
    constexpr int kSteps = 40;
    for (int n = 1; n <= kSteps; ++n) {
      const double theta = reach * n / kSteps;
      worst = std::max(worst, kSigmas * RadiusSigma(best.fit, theta));
      RadialValue here, there;
      if (!EvaluateRadius(best.trial.model, best.fit.lens.focal, best.fit.lens.own, theta, here))
        continue;
      for (const Candidate& other : candidates_) {
        const bool is_rich = other.trial.model == FitModel::kKannalaBrandt;
        if (!other.trial.fitted || is_rich ||
            other.trial.held_out_px > kAsGood * best.trial.held_out_px ||
            !EvaluateRadius(other.trial.model, other.fit.lens.focal, other.fit.lens.own, theta,
                            there))
          continue;
        worst = std::max(worst, std::abs(there.r - here.r));
      }
    }
    // Corners share an error of position, since lines curve within their window. Tilts to all sides
    // partly balance it; a single picture does not.
    const double shared = used_.size() == 1 ? 4 : 2;  // times the residual
    return std::hypot(worst, shared * best.fit.rms_px);
  }

  void Judge(const Candidate& best) {
    auto& sentences = result_.sentences;
    bool doubtful = false;
    const double cover = result_.covered_radius_px / result_.rim_radius_px;
    if (best.trial.rms_px > options_.largest_rms && result_.is_paper_model_refuted &&
        result_.model == FitModel::kEquisolid) {
      Refuse(
          fmt::format("wrong model: equisolid leaves {:.2f} px where another leaves {:.2f}; let "
                      "the model be chosen",
                      best.trial.held_out_px, LowestResidual()));
      return;
    }
    if (best.trial.rms_px > options_.largest_rms) {
      Refuse(
          fmt::format("no model explains the points: the best leaves {:.2f} px, more than {:g}; "
                      "was the target flat, and the focus and zoom left alone?",
                      best.trial.rms_px, options_.largest_rms));
      return;
    }
    if (circle_.r > 0 && cover < options_.least_cover) {
      Refuse(
          fmt::format("the targets reach only {:.0f} % of the round window's radius, of {:.0f} "
                      "needed; go nearer or use a larger target",
                      100 * cover, 100 * options_.least_cover));
      return;
    }
    if (!(result_.rim_error_px < kHopeless * result_.rim_radius_px)) {
      Refuse(fmt::format(
          "the pictures do not determine the lens: {}. Take pictures with the target tilted by 20 "
          "degrees and more, and filling the window",
          RimErrorInWords(result_.rim_error_px, result_.rim_radius_px)));
      return;
    }
    const bool single = used_.size() == 1;
    const auto chosen_paper = result_.model == FitModel::kEquisolid;
    if (result_.is_paper_model_refuted) {
      doubtful = doubtful || chosen_paper || options_.model != ModelChoice::kAuto;
      const Candidate* paper = Find(FitModel::kEquisolid);
      sentences.push_back(
          fmt::format("wrong model: equisolid leaves {:.2f} px where another leaves {:.2f}{}",
                      paper->trial.held_out_px, LowestResidual(),
                      chosen_paper ? "; let the model be chosen, or the rim will be wrong"
                                   : fmt::format("; {} was taken", ToString(result_.model))));
    }
    if (single) {
      doubtful = true;
      sentences.push_back(
          "one picture only: it cannot separate focal length from distance, and the choice of the "
          "model rests on it alone; take six, tilted to all sides");
      const ViewReport& view = result_.views[place_[0]];
      if (view.tilt < RadiansFromDegrees(8))
        sentences.push_back(
            fmt::format("its target faces the lens (tilt {:.0f} degrees), so the focal length "
                        "follows from the distortion alone and depends on the model",
                        DegreesFromRadians(view.tilt)));
    } else if (used_.size() == 2) {
      doubtful = true;
      sentences.push_back("two pictures only: no picture is left to test the model on; take six");
    }
    if (cover < 0.85)
      sentences.push_back(fmt::format(
          "the targets reach {:.0f} % of the {}; beyond that the model is extrapolated",
          100 * cover, circle_.r > 0 ? "round window's radius" : "way to the picture's edge"));
    if (result_.rim_error_px > 1.0) {
      doubtful = true;
      sentences.push_back(
          fmt::format("at the rim the lens may be off by {:.1f} px", result_.rim_error_px));
    }
    if (result_.points_left_out * 5 > result_.points) {
      doubtful = true;
      sentences.push_back(fmt::format("{} of {} points were left out as wrong",
                                      result_.points_left_out,
                                      result_.points_left_out + result_.points));
    }
    result_.verdict = doubtful ? LensVerdict::kDoubtful : LensVerdict::kGood;
    if (!doubtful)
      sentences.insert(
          sentences.begin(),
          fmt::format("{} views of {} points agree with the {} model to {:.2f} px", used_.size(),
                      result_.points, ToString(result_.model), best.fit.rms_px));
  }

  double LowestResidual() const {
    double lowest = std::numeric_limits<double>::infinity();
    for (const Candidate& other : candidates_)
      if (other.trial.fitted) lowest = std::min(lowest, other.trial.held_out_px);
    return lowest;
  }

  static glm::dvec3 TurnedBy(const glm::dvec3& w, const glm::dvec3& v) {
    const double angle = glm::length(w);
    if (angle < 1e-12) return v;
    const glm::dvec3 axis = w / angle;
    return v * std::cos(angle) + glm::cross(axis, v) * std::sin(angle) +
           axis * glm::dot(axis, v) * (1 - std::cos(angle));
  }

  // Difference between the point by the fit and the measured point.
  double ResidualOf(const LensFit& fit, std::size_t v, const LatticePoint& point) const {
    const BoardPose& pose = fit.poses[v];
    const glm::dvec3 at = TurnedBy({pose[0], pose[1], pose[2]}, {static_cast<double>(point.i),
                                                                 static_cast<double>(point.j), 0}) +
                          glm::dvec3(pose[3], pose[4], pose[5]);
    const double across = std::hypot(at.x, at.y);
    RadialValue value;
    if (!EvaluateRadius(fit.lens.model, fit.lens.focal, fit.lens.own, std::atan2(across, at.z),
                        value))
      return std::numeric_limits<double>::infinity();
    const double scale = across > 0 ? value.r / across : 0;
    return std::hypot(fit.lens.cx + at.x * scale - point.pixel.x,
                      fit.lens.cy + at.y * scale / fit.lens.aspect - point.pixel.y);
  }

  cv::Size picture_;
  LensCircle circle_;
  double spacing_;
  const CalibrateOptions& options_;
  const Progress& progress_;
  FitOptions fit_options_;
  std::vector<TargetView> used_;
  std::vector<std::size_t> place_;  // index of each used view among the pictures
  std::vector<Candidate> candidates_;
  LensCalibration result_;
};

}  // namespace

const char* ToString(LensVerdict verdict) {
  return verdict == LensVerdict::kGood       ? "good"
         : verdict == LensVerdict::kDoubtful ? "doubtful"
                                             : "refused";
}

std::string RimErrorInWords(double rim_error_px, double rim_radius_px) {
  return rim_error_px <= rim_radius_px
             ? fmt::format("its error at the rim may be {:.0f} px", rim_error_px)
             : "its error at the rim may be larger than the window itself";
}

LensCalibration CalibrateLens(const std::vector<TargetView>& views, cv::Size picture,
                              const LensCircle& circle, double spacing,
                              const CalibrateOptions& options, const Progress& progress) {
  CheckOptions(options);
  if (!(spacing > 0 && std::isfinite(spacing)))
    throw Error(Code::kBadArgument, "the spacing of the target must be more than 0 mm");
  return Calibration(views, picture, circle, spacing, options, progress).Run();
}

}  // namespace arthro::authoring
