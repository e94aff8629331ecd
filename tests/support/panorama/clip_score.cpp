#include "tests/support/panorama/clip_score.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <opencv2/calib3d.hpp>

namespace arthro::test {
namespace {

using namespace authoring;

cv::Point2d Map(const cv::Matx33d& h, const cv::Point2d& p) {
  const cv::Vec3d q = h * cv::Vec3d(p.x, p.y, 1);
  return {q[0] / q[2], q[1] / q[2]};
}

struct Fit {
  cv::Matx33d h;
  std::vector<double> errors;
  double cost = std::numeric_limits<double>::infinity();
};

std::vector<double> ErrorsOf(const cv::Matx33d& h, const std::vector<cv::Point2d>& from,
                             const std::vector<cv::Point2d>& to) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < from.size(); ++i) errors.push_back(cv::norm(Map(h, from[i]) - to[i]));
  return errors;
}

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Homography that places most frames correctly: from several starts, refitted to the inliers.
Fit BestFit(const std::vector<cv::Point2d>& from, const std::vector<cv::Point2d>& to) {
  Fit best;
  const struct {
    int method;
    double threshold;
  } starts[] = {{cv::LMEDS, 3}, {cv::RANSAC, 4}, {cv::RANSAC, 20}, {0, 3}};
  for (const auto& [method, threshold] : starts) {
    cv::Mat h = cv::findHomography(from, to, method, threshold);
    if (h.empty()) continue;
    for (int round = 0; round < 3; ++round) {
      const auto errors = ErrorsOf(cv::Matx33d(h), from, to);
      const double limit = std::max(3 * Median(errors), 1.0);
      std::vector<cv::Point2d> close_from, close_to;
      for (std::size_t i = 0; i < errors.size(); ++i)
        if (errors[i] <= limit) {
          close_from.push_back(from[i]);
          close_to.push_back(to[i]);
        }
      if (close_from.size() < 8) break;
      const cv::Mat again = cv::findHomography(close_from, close_to, 0);
      if (!again.empty()) h = again;
    }
    Fit fit{cv::Matx33d(h), ErrorsOf(cv::Matx33d(h), from, to)};
    fit.cost = 0;
    for (std::size_t i = 0; i < fit.errors.size(); i += 9) {
      const double worst =
          *std::max_element(fit.errors.begin() + static_cast<std::ptrdiff_t>(i),
                            fit.errors.begin() + static_cast<std::ptrdiff_t>(i + 9));
      fit.cost += std::isfinite(worst) ? std::min(worst, 20.0) : 20.0;
    }
    if (fit.cost < best.cost) best = fit;
  }
  return best;
}

}  // namespace

std::string ClipScore::Text() const {
  return fmt::format(
      "{} frames, {} placed, {} right, mean {:.3f} max {:.3f} px, wrong as good {}, "
      "expected error covers {:.0f} %",
      frames, placed, right, mean_px, max_px, wrong_as_good, 100 * covered);
}

std::vector<cv::Point2d> NinePoints(const Clip& clip, const RectifiedView& view) {
  const Lens& lens = clip.lens();
  // Angle at 85 % of the window's radius, by the equisolid formula of lens.h.
  const double theta = 2 * std::asin(0.85 * lens.circle.r / (2 * lens.focal_px));
  std::vector<cv::Point2d> points{{view.cx, view.cy}};
  for (int i = 0; i < 8; ++i) {
    const double a = CV_PI / 4 * i, r = view.focal_px * std::tan(theta);
    points.emplace_back(view.cx + r * std::cos(a), view.cy + r * std::sin(a));
  }
  return points;
}

ClipScore ScoreClip(const Clip& clip, const RectifiedView& view,
                    std::span<const FrameResult> results, int component) {
  std::vector<cv::Matx33d> truth;
  std::vector<bool> is_blank;
  for (const FrameResult& result : results) {
    truth.push_back(clip.PanoramaFromRectified(result.index, view));
    is_blank.push_back(clip.IsBlank(result.index));
  }
  ClipScore score = ScorePlaces(NinePoints(clip, view), truth, is_blank, results, component);
  score.frames = clip.frames();
  return score;
}

ClipScore ScorePlaces(std::span<const cv::Point2d> nine, std::span<const cv::Matx33d> truths,
                      const std::vector<bool>& is_blank, std::span<const FrameResult> results,
                      int component) {
  ClipScore score;
  score.frames = static_cast<int>(results.size());
  score.worst_px.assign(results.size(), std::numeric_limits<double>::quiet_NaN());
  std::vector<cv::Point2d> placed, truth;
  std::vector<std::size_t> which;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!results[i].is_placed || results[i].component != component) continue;
    which.push_back(i);
    for (const cv::Point2d& p : nine) {
      placed.push_back(Map(results[i].panorama_from_rectified, p));
      truth.push_back(Map(truths[i], p));
    }
  }
  score.placed = static_cast<int>(which.size());
  if (which.empty()) return score;
  // findHomography's tolerances are in pixels of the truth, so the other pixels may have any size.
  // The fit avoids the limits of double.
  const Fit fit = BestFit(placed, truth);
  if (!std::isfinite(fit.cost)) {
    score.wrong_as_good = score.placed;
    score.covered = 0;
    return score;
  }
  score.truth_from_panorama = fit.h;
  int points = 0, covered = 0;
  for (std::size_t k = 0; k < which.size(); ++k) {
    const auto first = fit.errors.begin() + static_cast<std::ptrdiff_t>(9 * k);
    const FrameResult& result = results[which[k]];
    double worst = *std::max_element(first, first + 9);
    if (!std::isfinite(worst) || (!is_blank.empty() && is_blank[which[k]]))
      worst = std::numeric_limits<double>::infinity();
    score.worst_px[which[k]] = worst;
    // Expected errors are in panorama pixels of the result. Its scale against the truth's is that
    // of the fit, near 1 for a panorama at its natural scale.
    if (worst <= result.expected_error_px) ++covered;
    if (worst >= kRightPx) {
      if (result.expected_error_px < kRightPx) ++score.wrong_as_good;
      continue;
    }
    ++score.right;
    for (int j = 0; j < 9; ++j, ++points) {
      score.mean_px += first[j];
      score.max_px = std::max(score.max_px, first[j]);
    }
  }
  if (points) score.mean_px /= points;
  score.covered = static_cast<double>(covered) / static_cast<double>(which.size());
  return score;
}

}  // namespace arthro::test
